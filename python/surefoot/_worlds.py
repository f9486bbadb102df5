"""Arrays of the controller's state and plan are in its world W, those of the truth in the simulator's S: they say so, as those of a log do."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np

from surefoot import _core
from surefoot_log import worlds
from surefoot_log.worlds import ADVICE, in_world, the_world, world_of

OF_BOTH = {"WorldPose", "Alignment"}  # what takes one to the other
OF_DYNAMICS = {"Point", "Rotation"}  # objects of a world each, all of whose arrays are in it


class WorldError(_core.Error, worlds.WorldError):  # type: ignore[misc]
    """An expression mixes numbers in the controller's world W with numbers in the simulator's S."""


WorldError.__module__ = "surefoot"


def marked(inner: property, world: str) -> property:
    """world: empty if the object knows its own."""

    def get(self: Any) -> Any:
        value = inner.fget(self)  # type: ignore[misc]
        return in_world(value, world or self.world) if isinstance(value, np.ndarray) else value

    return property(get, inner.fset, doc=inner.__doc__)


def in_world_of_arguments(dynamics: Any) -> Any:
    """Robot.dynamics(), which is in the world of the arrays that it is given."""

    @functools.wraps(dynamics)
    def call(*args: Any, **kwargs: Any) -> Any:
        found = the_world("Robot.dynamics", [*args, *kwargs.values()])
        if found and kwargs.setdefault("world", found) != found:
            raise WorldError(f"world is {kwargs['world']!r}, and an array is in {found}; {ADVICE}")
        return dynamics(*args, **kwargs)

    setattr(call, "__wrapped__", dynamics.__wrapped__)  # the compiled one, as of all functions
    return call


def tell() -> None:
    worlds.WorldError = WorldError  # what reads logs does so without this package, too
    for name, kind in vars(_core).items():
        if not isinstance(kind, type) or name in OF_BOTH:
            continue
        for member, inner in list(vars(kind).items()):
            if not isinstance(inner, property):
                continue
            world = world_of(inner.__doc__ or "")
            if world or name in OF_DYNAMICS:
                setattr(kind, member, marked(inner, world))


def tell_of_arguments() -> None:
    """Once these are checked."""
    setattr(_core.Robot, "dynamics", in_world_of_arguments(_core.Robot.dynamics))
