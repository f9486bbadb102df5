"""What the commands in Python have in common."""

import argparse
import pathlib

from surefoot_campaign.errors import InputError, valid_names


class Parser(argparse.ArgumentParser):
    """Tells what is wrong as one InputError, with the options that there are."""

    def error(self, message):
        name = self.prog.split()[-1]
        if message.startswith("unrecognized arguments: "):
            given = message.split()[2]
            options = [option for action in self._actions for option in action.option_strings if option.startswith("--")]
            message = f'unknown argument "{given}" of {name}; {valid_names(given, options)}'
        raise InputError(f"{message}; see surefoot {name} --help")


def whole_number(text):
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f'"{text}" is not a whole number of at least 1')
    return int(text)


def folder_name(text):
    if not text:
        raise argparse.ArgumentTypeError("the name is empty; the name of a folder to write into is valid")
    return pathlib.Path(text)


def interrupt(*_):
    """For signals that end the command as ^C does."""
    raise KeyboardInterrupt
