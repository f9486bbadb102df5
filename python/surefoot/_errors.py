"""Complaints of the package's other parts as surefoot.Error."""

from collections.abc import Iterator
from contextlib import contextmanager

from surefoot._core import Error


@contextmanager
def told_as_error() -> Iterator[None]:
    from surefoot_campaign.errors import InputError

    try:
        yield
    except InputError as error:
        raise Error(str(error)) from None
