"""A hierarchy of tasks, put together line by line."""

from __future__ import annotations

import operator
import os
import pathlib
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from surefoot import _core
from surefoot._arguments import checked, is_list, is_whole
from surefoot._core import Error, FileError, Robot, UnknownNameError
from surefoot._fixed import refuse_to_set
from surefoot._paths import absolute_path
from surefoot.task import OwnTask, Task, check_name, entries_of, own_tasks_told, registered_task, registered_tasks


STACK_NAME = re.compile(r"\w[^\n\"'{}\[\]:#,/\\\0]{0,199}")  # files are called so


def check_stack_name(name: str) -> None:
    if not STACK_NAME.fullmatch(name):
        raise Error(f"{name!r} is no name of a stack; one that begins with a letter, a digit or _, of at most 200, without slashes, quotes, brackets, "
                    "colons, commas and #, would be valid: Stack(…, name=…)")  # fmt: skip


@checked
@dataclass(frozen=True)
class StackLevel:
    """A level of a stack: its name and its tasks, which share it by their weights. damping d adds the rows d x = 0 for singularities."""

    name: str
    tasks: tuple[Task, ...]
    damping: float = 0.0

    def __post_init__(self) -> None:
        check_name(self.name)
        object.__setattr__(self, "tasks", tuple(self.tasks) if is_list(self.tasks) else (self.tasks,))
        wrong = [task for task in self.tasks if not isinstance(task, Task)]
        if wrong or not self.tasks:
            raise Error(f"level {self.name}: {f'{wrong[0]!r} is no task' if wrong else 'has no task'}; one of surefoot.tasks or an OwnTask is valid")

    def __str__(self) -> str:
        shown = [words_of(task) for task in self.tasks]
        line = f"{self.name}: " if len(shown) > 1 or self.name != self.tasks[0].task else ""
        return line + " + ".join(shown) + (f", damping {self.damping:g}" if self.damping else "")


def content_of(level: StackLevel) -> tuple[Any, ...]:
    """All that it does: the name of a task is that of the level, if it is alone there."""
    tasks = [(task.task, task.weight, task.parameters, task if isinstance(task, OwnTask) else task._own) for task in level.tasks]
    return level.name, level.damping, tasks


def words_of(task: Task) -> str:
    weight = f" × {task.weight:g}" if task.weight != 1.0 else ""
    return " ".join([task.task + weight, *(f"{key}={value:g}" if isinstance(value, float | int) else f"{key}={value}" for key, value in task.parameters.items())])


def advice_of_level(level: StackLevel, name: str) -> str:
    return f"{name} of a level can't be set; stack.replace({level.name!r}, StackLevel(…)) gives a stack with another one"


refuse_to_set(StackLevel, advice_of_level)

Step = Callable[[list[StackLevel]], list[StackLevel]]


def as_level(given: Task | StackLevel) -> StackLevel:
    return given if isinstance(given, StackLevel) else StackLevel(given.name, (given,))


def place_of(levels: Sequence[StackLevel], name: str) -> int:
    names = [level.name for level in levels]
    if name not in names:
        from surefoot_campaign.errors import valid_names

        raise UnknownNameError(f"the stack has no level {name!r}; {valid_names(name, names)}")
    return names.index(name)


@checked
class Stack:
    """A strict hierarchy, highest priority first: `Stack("terrain_adaptation")`, or one that begins empty. What changes it returns another stack:

    >>> Stack("terrain_adaptation").before("torso_yaw", surefoot.tasks.FramePosition("kinova", kp=100, kd=20)).without("torso_height")

    base: name or path of a stack file; surefoot.stacks() lists those that there are. Its numbers, and all defaults, go with the robot's
    size; numbers that you give are as they stand. print(stack) shows it line by line with all gains."""

    name: str

    def __init__(self, base: str | os.PathLike[str] | None = None, name: str | None = None) -> None:
        self._base = None if base is None else absolute_path(os.fspath(base))
        self._steps: tuple[Step, ...] = ()
        vars(self)["name"] = name or "own"
        self.levels()
        if name is None and self._base is not None:
            found = _core.stack_name(self._base, registered_tasks())
            vars(self)["name"] = found if STACK_NAME.fullmatch(found) else pathlib.Path(self._base).stem
        check_stack_name(self.name)

    def levels(self, robot: Robot | None = None, changed: Mapping[str, Mapping[str, float | str]] = {}) -> list[StackLevel]:
        """With the numbers of the base for this robot; without one for ANYmal B. changed: parameters of the base's tasks, as a scenario's `tasks:`."""
        with own_tasks_told():
            found = [] if self._base is None else _core.stack_levels(self._base, robot, own=registered_tasks())
        levels = [StackLevel(name, tuple(Task._read(task, name, weight, parameters | dict(changed.get(task, {}))) for task, weight, parameters in tasks), damping)
                  for name, damping, tasks in found]  # fmt: skip
        for step in self._steps:
            levels = step(levels)
        return levels

    def before(self, level: str, *new: Task | StackLevel) -> Stack:
        """With new levels of their own just above another."""
        return self._with(partial(insert_at, new, level, 0))

    def after(self, level: str, *new: Task | StackLevel) -> Stack:
        """With new levels just below another."""
        return self._with(partial(insert_at, new, level, 1))

    def first(self, *new: Task | StackLevel) -> Stack:
        """With new levels above all."""
        return self._with(partial(insert_first, new))

    def last(self, *new: Task | StackLevel) -> Stack:
        """With new levels below all."""
        return self._with(partial(insert_last, new))

    def without(self, *names: str) -> Stack:
        """Without these levels."""
        return self._with(partial(remove, names))

    def replace(self, level: str, *new: Task | StackLevel) -> Stack:
        """With others in place of a level."""
        return self._with(partial(put, new, level))

    def tune(self, task: str, *, weight: float | None = None, **parameters: float | str | Sequence[str]) -> Stack:
        """With other parameters of a task, wherever it is: `stack.tune("com_xy", kp=300)`."""
        return self._with(partial(tune, task, weight, parameters))

    def weighted_from(self, level: str, **weights: float) -> Stack:
        """With this level and all below it in one, in which weights replace the order: `stack.weighted_from("com_xy", com_xy=100)`."""
        place_of(self.levels(), level)
        made = self
        for name, weight in weights.items():
            made = made._with(partial(weigh, name, weight))
        made._parsed(f"weighted_from: {level}\n")  # raises Error on a level that keeps the physics
        return made._with(partial(merge, level))

    def text(self, robot: Robot | None = None, changed: Mapping[str, Mapping[str, float | str]] = {}) -> str:
        """As a stack file (stacks/*.yaml), complete in itself, for this robot. changed: as for levels()."""
        lines = [f"name: {self.name}", "levels:", *(f"  - {yaml_of(level)}" for level in self.levels(robot, changed))]
        return "\n".join(lines) + "\n"

    def write(self, path: str | os.PathLike[str], robot: Robot | str | os.PathLike[str] | None = None) -> None:
        """Writes that file, with the numbers that fit a robot, by default ANYmal B; a comment in it says which. Tasks of your own stand in it by
        their names: what reads it needs register_task()."""
        of = Robot(os.fspath(robot)) if isinstance(robot, str | os.PathLike) else robot
        fit = f"# Its numbers fit {'ANYmal B' if of is None else of.name}; Stack.write(…, robot=…) writes those of another robot.\n"
        try:
            pathlib.Path(path).write_text(fit * (self._base is not None) + self.text(of), encoding="utf-8")
        except OSError as error:
            raise FileError(f"{os.fspath(path)}: {error.strerror}; a file in a folder that exists would be valid") from None

    @property
    def own_tasks(self) -> list[OwnTask]:
        """Of the user, in its order; those that it has by name are the registered ones."""
        given = [task for level in self.levels() for task in level.tasks]
        own = [task if isinstance(task, OwnTask) else task._own or registered_task(task.task) for task in given]
        return list({task.task: task for task in own if task is not None}.values())

    @property
    def level_names(self) -> list[str]:
        """Highest priority first."""
        return [level.name for level in self._parsed()]

    def __iter__(self) -> Iterator[StackLevel]:
        return iter(self._parsed())

    def __getitem__(self, level: str | int) -> StackLevel:
        """By its name, or its place from 0 on."""
        levels = self._parsed()
        place = place_of(levels, level) if isinstance(level, str) else operator.index(level) if is_whole(level) else len(levels)
        if not -len(levels) <= place < len(levels):
            raise IndexError(f"the stack has no level {level!r}; a name, or a place from 0 to {len(levels) - 1}, would be valid")
        return levels[place]

    def __contains__(self, level: object) -> bool:
        return level in self.level_names or level in self._parsed()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Stack):
            return False
        return (self.name, [*map(content_of, self.levels())]) == (other.name, [*map(content_of, other.levels())])

    def __hash__(self) -> int:
        return hash((self.name, tuple(level.name for level in self.levels())))

    def __len__(self) -> int:
        return len(self._parsed())

    def __str__(self) -> str:
        return "\n".join([f"stack {self.name}", *(f"{number:3} {level}" for number, level in enumerate(self._parsed(), 1))])

    def __repr__(self) -> str:
        return f"<stack {self.name}: {' > '.join(self.level_names)}>"

    def _with(self, step: Step) -> Stack:
        """Throws at once what the program would refuse."""
        made = Stack.__new__(Stack)
        made._base, made._steps = self._base, (*self._steps, step)
        vars(made)["name"] = self.name
        levels = made.levels()
        names = [level.name for level in levels]
        twice = [name for name in names if names.count(name) > 1]
        if twice:
            raise Error(f"two levels have the name {twice[0]!r}; a name of its own, as Task(…, {twice[0] + '_2'!r}), would be valid")
        if levels:
            made._parsed()
        return made

    def _parsed(self, end: str = "") -> list[StackLevel]:
        """As the program reads it, and an end of its file."""
        if not self.levels():
            return []
        try:
            found = _core.parse_stack(self.text() + end, f"stack {self.name}", own=self.own_tasks)
        except Error as error:
            raise type(error)(re.sub(r":\d+: levels\.(\d+)\.", self._level_of, str(error))) from None
        return [StackLevel(name, tuple(Task._read(task, name, weight, parameters) for task, weight, parameters in tasks), damping)
                for name, damping, tasks in found]  # fmt: skip

    def _level_of(self, found: re.Match[str]) -> str:
        """Of a place in the text that nobody has seen."""
        return f", level {self.levels()[int(found[1])].name}: "


def advice_of_stack(stack: Stack, name: str) -> str:
    if name == "name":
        return "name of a stack can't be set; Stack(…, name=…) makes one that is called so"
    return f"a stack has no {name} to set; before(), after(), replace(), tune() and the like give another stack"


refuse_to_set(Stack, advice_of_stack, ["name"])


# What changes a stack; levels come last.


def insert(levels: list[StackLevel], place: int, new: Sequence[Task | StackLevel]) -> list[StackLevel]:
    if not new:
        raise Error("no level was given; a task of surefoot.tasks would be valid")
    return [*levels[:place], *map(as_level, new), *levels[place:]]


def insert_at(new: Sequence[Task | StackLevel], level: str, behind: int, levels: list[StackLevel]) -> list[StackLevel]:
    return insert(levels, place_of(levels, level) + behind, new)


def insert_first(new: Sequence[Task | StackLevel], levels: list[StackLevel]) -> list[StackLevel]:
    return insert(levels, 0, new)


def insert_last(new: Sequence[Task | StackLevel], levels: list[StackLevel]) -> list[StackLevel]:
    return insert(levels, len(levels), new)


def remove(names: Sequence[str], levels: list[StackLevel]) -> list[StackLevel]:
    places = {place_of(levels, name) for name in names}
    return [level for place, level in enumerate(levels) if place not in places]


def put(new: Sequence[Task | StackLevel], level: str, levels: list[StackLevel]) -> list[StackLevel]:
    place = place_of(levels, level)
    return insert(levels[:place] + levels[place + 1 :], place, new)


def tune(task: str, weight: float | None, parameters: Mapping[str, Any], levels: list[StackLevel]) -> list[StackLevel]:
    names = [each.task for level in levels for each in level.tasks]
    if task not in names:
        from surefoot_campaign.errors import valid_names

        raise UnknownNameError(f"the stack has no task {task!r}; {valid_names(task, names)}")

    def changed(each: Task) -> Task:
        if each.task != task:
            return each
        return each._with(each.weight if weight is None else weight, {**each.parameters, **parameters})

    return [replace(level, tasks=tuple(map(changed, level.tasks))) for level in levels]


def weigh(name: str, weight: float, levels: list[StackLevel]) -> list[StackLevel]:
    place_of(levels, name)
    return [replace(level, tasks=tuple(task._with(task.weight * weight, task.parameters) for task in level.tasks)) if level.name == name else level
            for level in levels]  # fmt: skip


def merge(name: str, levels: list[StackLevel]) -> list[StackLevel]:
    """As `control::weighted_from` does."""
    place = place_of(levels, name)
    return [*levels[:place], StackLevel("weighted", tuple(task for level in levels[place:] for task in level.tasks))]


def yaml_of(level: StackLevel) -> str:
    damping = [f"damping: {level.damping!r}"] * (level.damping != 0.0)
    if len(level.tasks) == 1:
        return "{" + ", ".join([f"name: {level.name}", *damping, *entries_of(level.tasks[0])]) + "}"
    tasks = ", ".join("{" + ", ".join(entries_of(task)) + "}" for task in level.tasks)
    return "{" + ", ".join([f"name: {level.name}", *damping, f"tasks: [{tasks}]"]) + "}"
