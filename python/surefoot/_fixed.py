"""Objects whose attributes are not set: what would do nothing is refused, with the call that does it."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

from surefoot._core import Error


class FixedError(Error, AttributeError):
    """An attribute that can't be set."""


def is_librarys(kind: type) -> bool:
    return kind.__module__.partition(".")[0] == "surefoot"


def refuse_to_set(kind: type, advice: Callable[[Any, str], str], fixed: Collection[str] = ()) -> None:
    """Of a class; advice: what would do it, for an object and a name. Open are private names, functions in place of a method, and in classes that
    users derive all but the `fixed`."""

    def assign(self: object, name: str, value: object) -> None:
        is_method = callable(value) and callable(getattr(type(self), name, None))
        if name in fixed or (is_librarys(type(self)) and name[0] != "_" and not is_method):
            raise FixedError(advice(self, name))
        object.__setattr__(self, name, value)

    def delete(self: object, name: str) -> None:
        if name in fixed or (is_librarys(type(self)) and name[0] != "_"):
            raise FixedError(advice(self, name))
        object.__delattr__(self, name)

    setattr(kind, "__setattr__", assign)
    setattr(kind, "__delattr__", delete)
