"""What the commands in Python have in common."""

import argparse
import pathlib
import signal
import sys

from surefoot_campaign.errors import InputError, valid_names

WRONG_INPUT = 2


class Parser(argparse.ArgumentParser):
    """Throws what is wrong as an InputError that names the valid options."""

    def __init__(self, name, description, epilog=""):
        super().__init__(f"surefoot {name}", description=description, epilog=epilog, allow_abbrev=False,
                         formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip

    def error(self, message):
        name = self.prog.split()[-1]
        if message.startswith("unrecognized arguments: "):
            given = message.split()[2]
            options = [option for action in self._actions for option in action.option_strings if option.startswith("--")]
            message = f'unknown argument "{given}" of {name}; {valid_names(given, options)}'
        raise InputError(f"{message}; see surefoot {name} --help")


def whole_number(most=None):
    """Reads a whole number of at least 1."""

    def read(text):
        if not text.isdecimal() or int(text) < 1 or (most and int(text) > most):
            raise argparse.ArgumentTypeError(f'"{text}" is not a whole number {f"from 1 to {most}" if most else "of at least 1"}')
        return int(text)

    return read


def folder_name(text):
    if not text:
        raise argparse.ArgumentTypeError("the name is empty; the name of a folder to write into is valid")
    return pathlib.Path(text)


def interrupt(*_):
    """Handles signals that end the command as ^C does."""
    raise KeyboardInterrupt


def tell(message):
    print(f"surefoot: {message}", file=sys.stderr)
    return WRONG_INPUT


def run_command(command, typed, interrupted="interrupted: no results"):
    """Returns the exit code. What is wrong is one line on stderr."""
    ending = (signal.SIGINT, signal.SIGTERM)
    for number in ending:
        signal.signal(number, interrupt)
    try:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, ending)  # the program keeps them back until here
        return command(typed) or 0
    except InputError as error:
        return tell(error)
    except KeyboardInterrupt:
        return tell(interrupted)
    except (ImportError, OSError) as error:
        file = getattr(error, "filename", None)
        return tell(f"{file}: {error.strerror}" if file else " ".join(str(error).split()))
