"""Scenarios and controllers from robots, stacks and options."""

from __future__ import annotations

import copyreg
import json
import os
import pathlib
import tempfile
import weakref
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from surefoot import _core
from surefoot._arguments import ArgumentError, checked, is_number, number
from surefoot._core import Error, Estimator, Gait, Planner, Plant, Robot, Scenario
from surefoot._fixed import refuse_to_set
from surefoot._paths import absolute_path, is_path, with_absolute_paths
from surefoot.stack import Stack
from surefoot.task import OwnTask, own_tasks_told, registered_tasks

_arguments_of: weakref.WeakKeyDictionary[Scenario, tuple[Any, ...]] = weakref.WeakKeyDictionary()
PLAIN = "walk_flat"  # whose options a controller of a robot alone has


@checked
def load_scenario(
    name: str | os.PathLike[str],
    seed: int = 0,
    set: Sequence[str] | Mapping[str, Any] = (),
    *,
    robot: Robot | str | os.PathLike[str] | None = None,
    stack: Stack | str | os.PathLike[str] | None = None,
    gaits: Mapping[str, Callable[[], Gait]] | None = None,
) -> Scenario:
    """Reads a scenario, by its name or as a path that ends in .yaml.

    seed: 0 is the nominal run; any other draws what `randomise:` lists.
    set: ["path.to.key=value"] or {"path.to.key": value}, laid over the file; `surefoot list options` has all keys.
    robot, stack: others than the file's.
    gaits: your own, {"sway": Sway}, which `gait:` and commands may then name; each controller makes one.
    Raises Error, naming file, line and key, on everything that is unknown or out of range."""
    words = words_in(set) + ([f"stack={os.fspath(stack)}"] if isinstance(stack, str | os.PathLike) else [])
    of = os.fspath(robot) if isinstance(robot, os.PathLike) else robot
    return _load_scenario(os.fspath(name), seed, words, of, stack if isinstance(stack, Stack) else None, dict(gaits or {}), registered_tasks())


def words_in(given: Sequence[str] | Mapping[str, Any]) -> list[str]:
    """As the program's --set takes them. A text is YAML already; other values have JSON, which is YAML."""
    if not isinstance(given, Mapping):
        return list(given)
    return [f"{key}={value if isinstance(value, str) else json.dumps(value, default=plain)}" for key, value in given.items()]


def plain(value: Any, whose: str = "set", objects: str = "robot= and stack= take objects") -> Any:
    """Of a number, an array, a range or a path."""
    if is_number(value):
        return number(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, range):
        return [*value]
    if not isinstance(value, os.PathLike):
        raise Error(f"{whose} has a {type(value).__name__}; numbers, texts, lists, dicts and paths would be valid, and {objects}")
    return os.fspath(value)


def _load_scenario(
    name: str,
    seed: int,
    words: list[str],
    robot: Robot | str | None,
    stack: Stack | None,
    gaits: dict[str, Callable[[], Gait]],
    registered: list[OwnTask],
) -> Scenario:
    """As load_scenario(); `words`: as the program's --set takes them."""
    robot = Robot(robot) if isinstance(robot, str) else robot
    all_words = words + ([] if robot is None else [f"robot={robot.file}"])
    scenario = _read_with_stack(name, seed, all_words, robot, stack, gaits, registered)
    place = os.path.abspath(scenario.file) if is_path(name) else name
    robot_file = None if robot is None else absolute_path(robot.file)
    _arguments_of[scenario] = (place, seed, [with_absolute_paths(word) for word in words], robot_file, stack, gaits, [] if stack else registered)
    return scenario


def _reduce_scenario(scenario: Scenario) -> tuple[Any, ...]:
    """For pickle: another process reads the scenario from the same files."""
    if scenario not in _arguments_of:
        raise Error("only scenarios of load_scenario() can be pickled")
    return _load_scenario, _arguments_of[scenario]


def _read_with_stack(
    name: str, seed: int, words: list[str], robot: Robot | None, stack: Stack | None, gaits: dict[str, Callable[[], Gait]], registered: list[OwnTask]
) -> Scenario:
    if stack is None:
        return read_scenario(name, seed, words, registered, gaits)
    with tempfile.TemporaryDirectory(prefix="surefoot_") as folder:
        file = pathlib.Path(folder) / "stack.yaml"
        file.write_text(stack.text(robot or robot_of(name, seed, words, gaits)), encoding="utf-8")
        try:
            return read_scenario(name, seed, [*words, f"stack={file}"], stack.own_tasks, gaits, stack.name)
        except Error as error:
            raise type(error)(str(error).replace(str(file), f"stack {stack.name}")) from None


def robot_of(name: str, seed: int, words: list[str], gaits: dict[str, Callable[[], Gait]]) -> Robot:
    """By the scenario, which must be whole without the stack; other words may be about the stack."""
    of_robot = [word for word in words if word.partition("=")[0] == "robot"]
    return read_scenario(name, seed, of_robot, registered_tasks(), gaits).robot_model


def read_scenario(name: str, seed: int, words: list[str], own: list[OwnTask], gaits: dict[str, Callable[[], Gait]], stack_name: str = "") -> Scenario:
    """What the program says of its option --set is told of the argument that the word came from. stack_name: of the stack whose file is the last word."""
    try:
        with own_tasks_told():
            return _core.read_scenario(name, seed, words, own, gaits)
    except Error as error:
        text = str(error)
        for word in words:
            key, _, value = word.partition("=")
            called = stack_name if stack_name and word is words[-1] else pathlib.Path(value).stem
            told = f"{key} {called}: " if key in ("stack", "robot") else f"set has {word!r}: "
            text = text.replace(f"--set {word}: ", told).replace(f"{told}{key}: ", told)
        raise type(error)(text) from None


copyreg.pickle(Scenario, _reduce_scenario)


def advice_of_scenario(scenario: Scenario, name: str) -> str:
    key = {"stack_name": "stack", "robot_model": "robot"}.get(name, name)
    argument = f"{key}=…" if key in ("seed", "robot", "stack", "gaits") else f"set={{{name!r}: …}}" if name in json.loads(scenario.options_json) else "set={…}"
    read = _arguments_of.get(scenario, [scenario.name])[0]
    listed = "" if argument != "set={…}" else ", by the keys that `surefoot list options` has"
    return f"{name} of a scenario can't be set; load_scenario({read!r}, {argument}) reads one with another{listed}"


refuse_to_set(Scenario, advice_of_scenario)


@checked
class Controller(_core.ControllerBase):
    """The whole-body controller: one step() a tick, 400 times a second, turns sensor readings into joint torques.

    of: a scenario, or a robot (or its name), whose controller then has the options of the scenario walk_flat, changed by `stack` and `set`.
    estimator, planner: your own, in place of the library's. Tasks of your own come with the stack.
    plant: needed only where the scenario says `estimation: truth`. Without it readings may come from anywhere: from a real robot."""

    scenario: Scenario

    def __init__(
        self,
        of: Scenario | Robot | str | os.PathLike[str],
        plant: Plant | None = None,
        *,
        stack: Stack | str | os.PathLike[str] | None = None,
        set: Sequence[str] | Mapping[str, Any] = (),
        estimator: Estimator | None = None,
        planner: Planner | None = None,
    ) -> None:
        if isinstance(of, Scenario):
            if stack is not None or set:
                raise Error("a scenario has its stack and options; give them to load_scenario(…, stack=…, set=…)")
            scenario = of
        else:
            words: Any = {"user": []} | dict(set) if isinstance(set, Mapping) else ["user=[]", *set]  # each step() has its command
            scenario = load_scenario(PLAIN, set=words, robot=of, stack=stack)
        super().__init__(scenario, plant, estimator, planner)
        vars(self)["scenario"] = scenario


def advice_of_controller(controller: _core.ControllerBase, name: str) -> str:
    calls = f"set_{name}() changes it" if hasattr(controller, f"set_{name}") else "set_stack(), set_friction() and switch_levels() change what it does"
    return f"a Controller has no {name} to set; {calls}, and its scenario is given where it is made"


refuse_to_set(_core.ControllerBase, advice_of_controller)


def advice_of_plant(plant: Plant, name: str) -> str:
    return f"a Plant has no {name} to set; push() and fail() change what it does, and its scenario is given where it is made"


refuse_to_set(Plant, advice_of_plant)


def advice_of_robot(robot: Robot, name: str) -> str:
    return f"{name} of a Robot can't be set; a robot file with another one would be valid ({robot.file} is this robot's)"


refuse_to_set(Robot, advice_of_robot)


def change_stack(controller: _core.ControllerBase, stack: Stack | str | os.PathLike[str], duration: float, robot: Robot, options: str) -> bool:
    """`ControllerBase.set_stack()`; `options`: the scenario's, as JSON."""
    if not isinstance(stack, Stack | str | os.PathLike):
        raise ArgumentError(f"stack is {stack!r}; a Stack, or the name of one, would be valid")
    made = stack if isinstance(stack, Stack) else Stack(stack)
    changed = json.loads(options).get("tasks") or {}
    return controller.set_stack_text(made.text(robot, changed), made.name, duration, made.own_tasks)
