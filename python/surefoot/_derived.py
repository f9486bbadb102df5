"""Classes that users derive their own from: Gait, Planner and Estimator."""

from __future__ import annotations

import difflib
import warnings
from typing import Any

from surefoot import _core
from surefoot._arguments import checked

NEAR = 0.85  # of difflib: a slip, no other word


def tell_slips(kind: Any) -> None:
    """A method that is called nearly as one that the library calls, and that isn't there, is told where the class is written."""
    called = [name for name in vars(kind) if name[0] != "_"]

    def check(derived: type, /, **options: Any) -> None:
        super(kind, derived).__init_subclass__(**options)
        for name, member in vars(derived).items():
            near = difflib.get_close_matches(name, called, n=1, cutoff=NEAR)
            if name[0] != "_" and callable(member) and near and name not in called and getattr(derived, near[0]) is getattr(kind, near[0]):
                hint = f"did you mean {near[0]}? one of your own could be called _{name}"
                warnings.warn(f"{derived.__name__}.{name}: {kind.__name__} calls no {name}; {hint}", stacklevel=2)

    setattr(kind, "__init_subclass__", classmethod(check))


def begun_at_once(kind: Any) -> type:
    """Of a class whose objects have nothing in them the same one: those of a derived class are whole without super().__init__()."""

    def made(derived: type, /, *args: object, **kwargs: object) -> Any:
        one = kind.__new__(derived)
        kind.__init__(one)
        return one

    def nothing(self: object) -> None:
        """Nothing is left to do."""

    nothing.__qualname__ = f"{kind.__name__}.__init__"
    shown = {name: member for name, member in vars(kind).items() if name[0] != "_" or name in ("__doc__", "__module__")}
    return type(kind.__name__, (kind,), shown | {"__new__": made, "__init__": checked(nothing)})


def tell() -> None:
    setattr(_core, "Gait", begun_at_once(_core.Gait))
    for kind in (_core.Gait, _core.Planner, _core.Estimator):
        tell_slips(kind)
