"""A command can be pickled with the name of its gait, which no log has."""

from __future__ import annotations

import copyreg
from typing import Any

import numpy as np

from surefoot._core import UserCommand


def fields() -> list[str]:
    """All that can be set."""
    return [name for name, member in vars(UserCommand).items() if isinstance(member, property) and member.fset is not None]


def remade(values: dict[str, Any]) -> UserCommand:
    one = UserCommand()
    for name, value in values.items():
        setattr(one, name, value)
    return one


def user(one: UserCommand) -> tuple[Any, ...]:
    values = {name: getattr(one, name) for name in fields()}
    return remade, ({name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in values.items()},)


def tell() -> None:
    copyreg.pickle(UserCommand, user)
