"""Tasks: those of the library, and the user's own."""

from __future__ import annotations

import contextlib
import json
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy.typing as npt

from surefoot import _core
from surefoot._arguments import ArgumentError, checked, is_list, shown
from surefoot._core import Error, Robot, TaskTick
from surefoot._fixed import refuse_to_set
from surefoot._named import Parameters, named


FIELDS = ("task", "name", "weight", "parameters")  # of a Task
_registered: dict[str, OwnTask] = {}

Rows = tuple[npt.ArrayLike, npt.ArrayLike] | tuple[npt.ArrayLike, npt.ArrayLike, npt.ArrayLike]


@checked
class Task:
    """One objective or limit of a stack. Those of the library are in `surefoot.tasks`; derive OwnTask for one of your own.

    task: its name in the catalog. name: of its level. weight: of its rows, within a level of several tasks. Parameters that are None
    keep their defaults, which go with the robot's size. A task is not changed once it is made; one of your own has further attributes as you like."""

    task: str
    name: str
    weight: float
    parameters: Parameters
    _own: OwnTask | None  # whose weight and parameters these are

    def __init__(self, task: str, name: str | None = None, *, weight: float = 1.0, **parameters: float | str | Sequence[str] | None) -> None:
        given = Parameters((key, value) for key, value in parameters.items() if value is not None)
        vars(self).update(task=task, name=task if name is None else name, weight=weight, parameters=given, _own=None)
        check_name(self.name)
        if not isinstance(self, OwnTask):
            parse_alone(self, registered_tasks())

    @classmethod
    def _read(cls, task: str, name: str, weight: float, parameters: Mapping[str, Any], own: OwnTask | None = None) -> Task:
        """From a stack, which has checked it."""
        made = Task.__new__(Task)
        vars(made).update(task=task, name=name, weight=weight, parameters=Parameters(parameters), _own=own)
        return made

    def _with(self, weight: float, parameters: Mapping[str, Any]) -> Task:
        """One of the user's own stays the object that it is."""
        return Task._read(self.task, self.name, weight, parameters, self if isinstance(self, OwnTask) else self._own)

    def __setstate__(self, state: Any) -> None:
        """Of copies and pickles, whose dicts are plain ones."""
        for each in state if isinstance(state, tuple) else (state,):
            for name, value in (each or {}).items():
                object.__setattr__(self, name, Parameters(value) if name == "parameters" else value)

    def __eq__(self, other: object) -> bool:
        if isinstance(self, OwnTask) or not isinstance(other, Task) or isinstance(other, OwnTask):
            return self is other
        return (self.task, self.name, self.weight, self.parameters, self._own) == (other.task, other.name, other.weight, other.parameters, other._own)

    def __hash__(self) -> int:
        return hash((self.task, self.name))

    def __getattr__(self, name: str) -> Any:
        if name in FIELDS:
            raise Error(f"{type(self).__name__}.__init__ must call super().__init__(name) first")
        return object.__getattribute__(self, name)  # raises again what a property raised

    def __repr__(self) -> str:
        words = [repr(self.task)] + [repr(self.name)] * (self.name != self.task)
        words += [f"weight={self.weight:g}"] * (self.weight != 1.0)
        return f"Task({', '.join(words + [f'{key}={value!r}' for key, value in self.parameters.items()])})"


def advice_of_task(task: Task, name: str) -> str:
    if name in ("task", "name"):
        return f"{name} of a task can't be set; a new task with another one would be valid"
    if name == "parameters":
        return Parameters.advice
    known = ["weight", *(each["name"] for info in catalog() if info["name"] == task.task for each in info["numbers"] + info["choices"])]
    if name in known:
        return f"{name} of a task can't be set; stack.tune({task.task!r}, {name}=…) gives a stack with another one, or make a new task with it"
    from surefoot_campaign.errors import hint

    return f"the task {task.task} has no {name} to set; {hint(name, known)}stack.tune({task.task!r}, …) takes {', '.join(known)}"


refuse_to_set(Task, advice_of_task, FIELDS)


@checked
class OwnTask(Task):
    """A task of your own, written in Python; the same semantics as those of the library, and slower by some tens of microseconds.

    >>> class Still(surefoot.OwnTask):
    ...     max_rows, unit = 3, "m/s²"
    ...     def rows(self, tick):
    ...         base = tick.dynamics.base
    ...         return base.J, -20 * base.v - base.Jdot_u   # A u̇ = b

    max_rows: the largest number of rows that rows() gives. unit: of them. row_names: what they are called. What rows() raises, or gives of a
    wrong size or as NaN, makes the controller hold its posture, then sit down, and say so."""

    max_rows: int = 0
    unit: str = "–"
    row_names: Sequence[str] = ()

    def __init__(self, name: str, *, weight: float = 1.0) -> None:
        super().__init__(name, name, weight=weight)
        if type(self).rows is OwnTask.rows:
            raise Error(f"{type(self).__name__} has no rows(self, tick); a method that returns (A, b), (A, lower, upper) or None would be valid")

    def rows(self, tick: TaskTick) -> Rows | None:
        """The rows of a tick, lower ≤ A x ≤ upper over x = (u̇, τ): (A, lower, upper), (A, b) for A x = b, or None for
        none. A has a column for each acceleration, or for each of tick.unknowns with the torques."""
        raise NotImplementedError


@checked
def register_task(task: OwnTask) -> None:
    """From now on stack files, and stacks by their names, may name a task of your own: `{task: still}`; catalog() has it, too. A task of
    the same name that was registered before is replaced."""
    if task.task in [info["name"] for info in _core.catalog()]:
        raise Error(f"there is a task {task.task!r} already; give yours another name")
    parse_alone(task, [task])
    _registered[task.task] = task


@checked
def check_task(task: OwnTask, robot: Robot | str | os.PathLike[str]) -> list[str]:
    """Tries a task of your own in 64 states of a robot, with all sets of feet down: what is wrong, in sentences. Call it in your tests:

        assert surefoot.check_task(MyTask("mine"), "anymal_b") == []

    It finds what raises, what the solver can't solve, and rows that differ for the same input."""
    return _core.try_task(task, robot if isinstance(robot, Robot) else Robot(os.fspath(robot)))


def registered_task(name: str) -> OwnTask | None:
    return _registered.get(name)


def registered_tasks() -> list[OwnTask]:
    return list(_registered.values())


def with_registered(given: Sequence[OwnTask]) -> list[OwnTask]:
    """And registered ones of other names."""
    if not is_list(given):
        raise ArgumentError(f"own_tasks is {shown(given)}; a list of OwnTasks would be valid")
    names = [getattr(each, "task", None) for each in given]
    return [*given, *(task for name, task in _registered.items() if name not in names)]


@contextlib.contextmanager
def own_tasks_told() -> Iterator[None]:
    """What is read may name a task that is the user's own."""
    try:
        yield
    except Error as error:
        if ": unknown task " not in str(error):
            raise
        raise type(error)(f"{error}; one of your own is known after register_task()") from None


@checked
def catalog() -> list[dict[str, Any]]:
    """All tasks that a stack may have, with their parameters: the library's, then those of register_task()."""
    own = [{"name": name, "summary": (task.__doc__ or "").split("\n")[0], "equation": "–", "unit": task.unit, "numbers": [], "choices": []}
           for name, task in _registered.items()]  # fmt: skip
    return [*_core.catalog(), *named(own)]


def name_of(task: str, frame: str | None) -> str:
    """Of the level of a task that follows a frame: "gripper_position"."""
    return task if frame is None else re.sub(r"[\n\"'{}\[\]:#,]", "_", frame) + task.removeprefix("frame")


def check_name(name: str) -> None:
    if not isinstance(name, str) or not name or any(letter in name for letter in "\n\"'{}[]:#,"):
        raise Error(f"{name!r} is no name of a level; a text without quotes, brackets, colons and commas is valid")


def entries_of(task: Task) -> list[str]:
    """Of a level in a stack file."""
    weight = [f"weight: {task.weight!r}"] * (task.weight != 1.0)
    return [f"task: {task.task}", *weight, *(f"{key}: {json.dumps(value)}" for key, value in task.parameters.items())]


def parse_alone(task: Task, own: list[OwnTask]) -> None:
    """Raises Error on what no stack would take."""
    level = ", ".join([f"name: {task.name}", *entries_of(task)])
    try:
        with own_tasks_told():
            _core.parse_stack(f"name: own\nlevels:\n  - {{{level}}}\n", "stack", own=own)
    except Error as error:
        raise type(error)(re.sub(rf"^stack:\d+: levels\.0\.(task: |[\w.]+: {re.escape(task.task)}: )?", f"task {task.task}: ", str(error))) from None
