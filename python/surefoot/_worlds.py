"""Arrays of the controller's state and plan are in its world W, those of the truth in the simulator's S: they say so, as those of a log do."""

from __future__ import annotations

from typing import Any

import numpy as np

from surefoot import _core
from surefoot_log import worlds
from surefoot_log.worlds import in_world, world_of

OF_BOTH = {"WorldPose", "Alignment"}  # what takes one to the other


class WorldError(_core.Error, worlds.WorldError):  # type: ignore[misc]
    """An expression mixes numbers in the controller's world W with numbers in the simulator's S."""


WorldError.__module__ = "surefoot"


def marked(inner: property, world: str) -> property:
    def get(self: object) -> Any:
        value = inner.fget(self)  # type: ignore[misc]
        return in_world(value, world) if isinstance(value, np.ndarray) else value

    return property(get, inner.fset, doc=inner.__doc__)


def tell() -> None:
    worlds.WorldError = WorldError  # what reads logs does so without this package, too
    for name, kind in vars(_core).items():
        if not isinstance(kind, type) or name in OF_BOTH:
            continue
        for member, inner in list(vars(kind).items()):
            if isinstance(inner, property) and (world := world_of(inner.__doc__ or "")):
                setattr(kind, member, marked(inner, world))
