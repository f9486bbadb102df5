"""What is wrong with the input, in words for the one who gave it."""

import difflib


class InputError(Exception):
    """Ends the command with exit code 2; its text says what was given and what would be valid."""


def valid_names(given, names):
    return f"{hint(given, names)}valid are: {', '.join(names)}"


def near_names(given, names):
    """The same where there are many: the closest alone."""
    return f"{hint(given, names)}closest: {', '.join(difflib.get_close_matches(str(given), names, n=6, cutoff=0.0))}"


def hint(given, names):
    near = difflib.get_close_matches(str(given), names, n=1, cutoff=0.6)
    return f'did you mean "{near[0]}"? ' if near else ""
