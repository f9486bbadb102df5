"""Complaints of the package's other parts as surefoot.Error, and what each kind of them is."""

from collections.abc import Iterator
from contextlib import contextmanager

from surefoot._core import Error, FileError, UnknownNameError

TEXTS = {
    Error: "What was given is not valid, with what would be.",
    FileError: "A file can't be read or written.",
    UnknownNameError: "A name is not known, with those that are.",
}


@contextmanager
def told_as_error() -> Iterator[None]:
    from surefoot_campaign.errors import InputError

    try:
        yield
    except InputError as error:
        raise Error(str(error)) from None


def tell() -> None:
    for kind, text in TEXTS.items():
        kind.__doc__ = text
