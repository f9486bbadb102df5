"""Commands can be copied and pickled, for sweeps in several processes."""

from __future__ import annotations

import copyreg
from typing import Any

from surefoot._core import ReachCommand, UserCommand


def user(one: UserCommand) -> tuple[Any, ...]:
    return UserCommand, (one.walk, list(one.velocity), one.yaw_rate, one.height, one.calibrate, one.reach, list(one.shift), one.gait)


def reach(one: ReachCommand) -> tuple[Any, ...]:
    return ReachCommand, (one.arm, list(one.position), one.in_world, list(one.orientation), one.frame)


def tell() -> None:
    copyreg.pickle(UserCommand, user)
    copyreg.pickle(ReachCommand, reach)
