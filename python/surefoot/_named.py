"""What the package gives by names is a dict that tells of a name it has not."""

from __future__ import annotations

import functools
from typing import Any

from surefoot import _core

SHORT = 20  # names that are all told


class Named(dict[str, Any]):
    def __missing__(self, name: object) -> Any:
        from surefoot_campaign.errors import near_names, valid_names

        told = (valid_names if len(self) <= SHORT else near_names)(name, [*self])
        raise KeyError(f'there is no "{name}"; {told}' if self else f'there is no "{name}"; there is nothing here')


def named(value: Any) -> Any:
    """Every dict in it by names."""
    if isinstance(value, dict):
        return Named((name, named(each)) for name, each in value.items())
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return [named(each) for each in value]
    return value


def gives_names(function: Any) -> bool:
    return any("dict[str" in text.rpartition("->")[2] for text, *_ in getattr(function, "__nb_signature__", ()))


def giving_named(function: Any) -> Any:
    return lambda *args, **kwargs: named(function(*args, **kwargs))


def tell() -> None:
    for name, thing in list(vars(_core).items()):
        if gives_names(getattr(thing, "__wrapped__", None)):
            setattr(_core, name, functools.wraps(thing)(giving_named(thing)))
        elif isinstance(thing, type):
            for member, inner in list(vars(thing).items()):
                if isinstance(inner, property) and gives_names(inner.fget):
                    setattr(thing, member, property(giving_named(inner.fget), inner.fset, doc=inner.__doc__))
