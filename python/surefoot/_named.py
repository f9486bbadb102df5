"""Dicts whose KeyError has the names that are there."""

from __future__ import annotations

import contextlib
import functools
import importlib
from typing import Any

from surefoot import _core

SHORT = 20  # names that are all told
OF_FUNCTIONS = ["catalog", "scenarios", "stacks"]
BY_LEG = {"slips", "contacts", "feet", "hips"}
OF_OBJECTS = {
    "RobotState": ["slips"], "TickContext": ["contacts"], "MotionPlan": ["feet"], "GroundTruth": ["feet"], "Dynamics": ["hips", "feet", "contacts"],
    "Scenario": ["drawn"], "ControllerBase": ["problem"], "Evaluator": ["metrics"], "Result": ["metrics"],
}  # fmt: skip


class Named(dict[str, Any]):
    """Copied, pickled and written as YAML as a plain dict."""

    def __missing__(self, name: object) -> Any:
        from surefoot_campaign.errors import near_names, valid_names

        told = (valid_names if len(self) <= SHORT else near_names)(name, [*self]) if self else "it is empty"
        raise KeyError(f'there is no "{name}"; {told}')

    def __reduce__(self) -> tuple[Any, ...]:
        return dict, (dict(self),)


class Fixed(Named):
    """What is put into it would be lost."""

    advice = ""

    def _refuse(self, *_: object, **__: object) -> Any:
        raise _core.Error(self.advice)

    __setitem__ = __delitem__ = __ior__ = update = setdefault = pop = popitem = clear = _refuse  # type: ignore[assignment]


class ByLeg(Fixed):
    """The object that it is of has the items themselves."""

    advice = "what is of a leg can't be replaced: write into the item, as plan.feet['LF'].p_WF = …; slips the controller finds itself"


class Parameters(Fixed):
    """Of a task."""

    advice = "parameters of a task can't be changed: stack.tune(task.task, kp=…) gives a stack with others, or make a new task with them"


with contextlib.suppress(ImportError):
    _yaml = importlib.import_module("yaml.representer")
    for _kind in (_yaml.SafeRepresenter, _yaml.Representer):
        for _dict in (Named, ByLeg, Parameters):
            _kind.add_representer(_dict, _kind.represent_dict)


def named(value: Any) -> Any:
    """Every dict in it by names."""
    if isinstance(value, dict):
        return Named((name, named(each)) for name, each in value.items())
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return [named(each) for each in value]
    return value


def giving_named(function: Any) -> Any:
    return lambda *args, **kwargs: named(function(*args, **kwargs))


def giving_by_leg(function: Any) -> Any:
    return lambda *args, **kwargs: ByLeg(function(*args, **kwargs))


def tell() -> None:
    for name in OF_FUNCTIONS:
        function = getattr(_core, name)
        setattr(_core, name, functools.wraps(function)(giving_named(function)))
    for name, members in OF_OBJECTS.items():
        kind = getattr(_core, name)
        for member in members:
            inner = vars(kind)[member]
            giving = giving_by_leg if member in BY_LEG else giving_named
            setattr(kind, member, property(giving(inner.fget), inner.fset, doc=inner.__doc__))
