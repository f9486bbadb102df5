"""What the commands in Python have in common."""

import argparse
import pathlib
import signal
import sys

from surefoot_campaign.errors import InputError, valid_names

WRONG_INPUT = 2


class Parser(argparse.ArgumentParser):
    """Tells what is wrong as one InputError, with the options that there are."""

    def error(self, message):
        name = self.prog.split()[-1]
        if message.startswith("unrecognized arguments: "):
            given = message.split()[2]
            options = [option for action in self._actions for option in action.option_strings if option.startswith("--")]
            message = f'unknown argument "{given}" of {name}; {valid_names(given, options)}'
        raise InputError(f"{message}; see surefoot {name} --help")


def whole_number(text, most=None):
    if not text.isdecimal() or int(text) < 1 or (most and int(text) > most):
        raise argparse.ArgumentTypeError(f'"{text}" is not a whole number {f"from 1 to {most}" if most else "of at least 1"}')
    return int(text)


def folder_name(text):
    if not text:
        raise argparse.ArgumentTypeError("the name is empty; the name of a folder to write into is valid")
    return pathlib.Path(text)


def interrupt(*_):
    """For signals that end the command as ^C does."""
    raise KeyboardInterrupt


def tell(message):
    print(f"surefoot: {message}", file=sys.stderr)
    return WRONG_INPUT


def run_command(command, typed):
    """Its exit code; what is wrong with the input is one line on stderr."""
    ending = (signal.SIGINT, signal.SIGTERM)
    for number in ending:
        signal.signal(number, interrupt)
    try:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, ending)  # the program keeps them back until here
        return command(typed)
    except InputError as error:
        return tell(error)
    except KeyboardInterrupt:
        return tell("interrupted: no results")
    except OSError as error:
        return tell(f"{error.filename}: {error.strerror}" if error.filename else error)
