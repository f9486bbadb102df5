"""Numbers of a log, or of a running controller and plant, that know their world: W, the controller's, or S, the simulator's. They don't mix."""

import re
import sys

import numpy as np

WORLD = re.compile(r"\b(?:in|to) ([WS])\b")
ADVICE = "of a log aligned_error() has their difference and in_W() takes truth to W, in a loop Aligner; numpy.asarray() forgets the world"


class WorldError(ValueError):
    """An expression mixes the two worlds."""


class InWorld(np.ndarray):
    """An array of coordinates, with its `world`."""

    world = ""

    def __array_finalize__(self, other):
        self.world = getattr(other, "world", "")
        if "matplotlib.units" in sys.modules and "surefoot_log.world_axes" not in sys.modules:
            import surefoot_log.world_axes  # noqa: F401  plots by matplotlib alone refuse both worlds too

    def __array_function__(self, function, types, args, kwargs):
        world = the_world(function.__name__, [*args, *kwargs.values()])
        found = super().__array_function__(function, types, args, kwargs)
        return in_world(found, world) if isinstance(found, np.ndarray) and found.dtype.kind == "f" else found

    def __array_ufunc__(self, ufunc, method, *inputs, out=(), **options):
        world = the_world(ufunc.__name__, inputs)
        plain = [np.asarray(one) if isinstance(one, InWorld) else one for one in inputs]
        outs = {"out": tuple(np.asarray(one) if isinstance(one, InWorld) else one for one in out)} if out else {}
        found = getattr(ufunc, method)(*plain, **outs, **options)
        return in_world(found, world) if isinstance(found, np.ndarray) and found.dtype.kind == "f" else found


def the_world(called, given):
    """Of all arrays among these arguments."""
    worlds = set(worlds_in(given)) - {""}
    if len(worlds) > 1:
        raise WorldError(f"one of these is in W, the controller's world, the other in S, the simulator's: {called} of both means nothing; {ADVICE}")
    return worlds.pop() if worlds else ""


def worlds_in(given):
    for one in given:
        if isinstance(one, InWorld):
            yield one.world
        elif isinstance(one, (list, tuple)):
            yield from worlds_in(one)


def in_world(values, world):
    """The values with their world; plain ones where there is none."""
    if not world:
        return values
    found = np.asarray(values).view(InWorld)
    found.world = world
    return found


def world_of(about):
    """Of a channel, from what the log says of it: "base position in W"."""
    found = WORLD.search(about)
    return found[1] if found else ""


def rotated(q, vectors):
    """R v of quaternions w, x, y, z."""
    w, xyz = q[..., :1], q[..., 1:]
    twice = 2.0 * np.cross(xyz, vectors)
    return vectors + w * twice + np.cross(xyz, twice)


def transforms(p, q):
    """Of positions and quaternions the 4×4 matrices that take coordinates."""
    X = np.broadcast_to(np.eye(4), (len(p), 4, 4)).copy()
    X[:, :3, :3] = np.stack([rotated(q, np.broadcast_to(axis, p.shape)) for axis in np.eye(3)], axis=-1)
    X[:, :3, 3] = p
    return X
