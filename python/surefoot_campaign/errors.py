"""What is wrong with the input, in words for the one who gave it."""

import difflib


class InputError(Exception):
    """Ends the command with exit code 2; its text says what was given and what would be valid."""


def valid_names(given, names):
    near = difflib.get_close_matches(str(given), names, n=1, cutoff=0.6)
    hint = f'did you mean "{near[0]}"? ' if near else ""
    return f"{hint}valid are: {', '.join(names)}"
