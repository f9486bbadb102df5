"""What compiled objects print as that have no text of their own: their class and fields, long ones by their size."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from surefoot import _core

LONGEST = 60  # letters of a field that is shown whole
SHORT = 6  # numbers


def shown(value: Any) -> str:
    shape = getattr(value, "shape", None)
    if shape is not None:
        return str(value) if len(shape) < 2 and value.size <= SHORT else "×".join(map(str, shape))
    if isinstance(value, Mapping):
        return f"dict of {', '.join(map(str, value))}" if len(value) <= SHORT else f"dict of {len(value)}"
    if isinstance(value, Sequence) and not isinstance(value, str):
        return f"{len(value)} of {type(value[0]).__name__}" if value else "[]"
    text = repr(value)
    return text if len(text) <= LONGEST else type(value).__name__


def described(self: object, kind: type) -> str:
    name = type(self).__name__
    fields = [each for each, member in vars(kind).items() if isinstance(member, property) and each[0] != "_"]
    if not fields and type(self) is not kind:
        return f"<{name}, an own {kind.__name__}>"
    return f"{name}({', '.join(f'{each}={shown(getattr(self, each))}' for each in fields)})"


def tell() -> None:
    plain: Any = object.__repr__
    for kind in list(vars(_core).values()):
        if isinstance(kind, type) and kind.__repr__ is plain:
            setattr(kind, "__repr__", lambda self, kind=kind: described(self, kind))
    explanation: Any = _core.Explanation
    explanation.__repr__ = lambda self: f"<explanation: {str(self.text).strip().splitlines()[0]}>"
