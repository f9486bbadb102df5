"""A command can be pickled with the name of its gait, which no log has."""

from __future__ import annotations

import copyreg
from typing import Any

from surefoot._core import UserCommand


def user(one: UserCommand) -> tuple[Any, ...]:
    return UserCommand, (one.walk, list(one.velocity), one.yaw_rate, one.height, one.calibrate, one.reach, list(one.shift), one.gait)


def tell() -> None:
    copyreg.pickle(UserCommand, user)
