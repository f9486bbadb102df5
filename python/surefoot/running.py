"""Whole runs: one, or a campaign of many."""

from __future__ import annotations

import functools
import hashlib
import json
import os
import pathlib
import re
import signal
import tempfile
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from surefoot import _core
from surefoot._core import Error, Estimator, Gait, Planner, Result, Robot, Scenario, Tick
from surefoot._arguments import check_takes, checked
from surefoot._errors import told_as_error
from surefoot.control import load_scenario, plain
from surefoot.stack import Stack

if TYPE_CHECKING:
    import pyarrow as pa


@checked
def run(
    scenario: Scenario | str | os.PathLike[str],
    *,
    seed: int = 0,
    set: Sequence[str] | Mapping[str, Any] = (),
    robot: Robot | str | os.PathLike[str] | None = None,
    stack: Stack | str | os.PathLike[str] | None = None,
    gaits: Mapping[str, Callable[[], Gait]] | None = None,
    record: str | os.PathLike[str] | None = None,
    every_tick: Callable[[Tick], None] | None = None,
    estimator: Estimator | None = None,
    planner: Planner | None = None,
) -> Result:
    """Runs a scenario in closed loop and judges it, as `surefoot run` does.

    record: path of a log to write, run.mcap, for surefoot.read().
    every_tick: called before each tick with the run; it may push, let sensors fail, change stack or command, or stop() the run:

    >>> run("walk_flat", every_tick=lambda tick: tick.plant.push([0, 60, 0]) if tick.time == 12 else None)

    estimator, planner: your own, in place of the library's.
    seed, set, robot, stack, gaits: as for load_scenario(), where the scenario is a name. Other threads go on meanwhile; Ctrl-C ends it."""
    if isinstance(scenario, Scenario) and (seed, [*set], robot, stack, gaits) != (0, [], None, None, None):
        raise Error("seed, set, robot, stack and gaits are for a scenario's name: give them to load_scenario()")
    if every_tick is not None:
        check_takes("every_tick", every_tick, "tick")
    given = scenario if isinstance(scenario, Scenario) else load_scenario(scenario, seed, set, robot=robot, stack=stack, gaits=gaits)
    return _core.run_scenario(given, None if record is None else os.fspath(record), every_tick, estimator, planner)


class Campaign:
    """What came of a campaign: `.table` has a row a run, `.points` a row a point of its grid, `.pairs` the cases against the first one, seed by seed;
    `.notes` are lines worth telling: of its scenarios, and of runs that broke."""

    def __init__(self, folder: pathlib.Path, summary: dict[str, Any], notes: list[str]) -> None:
        self.folder: pathlib.Path = folder
        self.summary: dict[str, Any] = summary
        self.notes: list[str] = notes
        self._rows = (folder / "runs.parquet").read_bytes()  # another campaign may write there

    def __repr__(self) -> str:
        every, finished = self.summary["all"], self.summary["runs"]["finished"]
        unjudged = finished - every["trials"]
        rate = [f"{every['successes']} of {every['trials']} runs succeeded"] * bool(every["trials"] or not finished)
        return f"<campaign {self.summary['name']}: {', '.join(rate + [f'{unjudged} not judged'] * bool(unjudged))}: {self.folder}>"

    @property
    def table(self) -> pa.Table:
        """A row a run: its parameters, outcome and metrics; `.to_pandas()` makes a data frame of it."""
        import pyarrow.parquet

        return pyarrow.parquet.read_table(pyarrow.BufferReader(self._rows))

    @property
    def frame(self) -> Any:
        """The same as a pandas data frame, where pandas is installed."""
        return data_frame(self.table)

    @property
    def points(self) -> list[dict[str, Any]]:
        """Of each point: how many runs succeeded, with the rate's 95 % interval, and the judging metric."""
        return list(self.summary["points"])

    @property
    def pairs(self) -> list[dict[str, Any]]:
        """Of each case but the first: seeds that it mends and breaks, and the median difference of the judging metric with its 95 % interval."""
        return list(self.summary["pairs"])


def data_frame(table: pa.Table) -> Any:
    try:
        return table.to_pandas()
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(f"{error.name} is not installed: `pip install {error.name}`, or use `.table`, which needs no pandas") from None


@checked
def campaign(
    spec: str | os.PathLike[str] | Mapping[str, Any], *, out: str | os.PathLike[str] | None = None, jobs: int | None = None, retry: bool = False
) -> Campaign:
    """Runs a grid of scenario parameters times seeds, each run in a process of its own, as `surefoot campaign` does.

    spec: a file, the name of one that ships, or its content as a dict: {"scenario": "walk_flat", "seeds": [1, 2, 3], "grid": {…}}. In a dict
        `stack` may be a Stack, made for the robot of its runs, of one size; one with tasks of your own can't run in other processes.
    out: folder of the results, by default results/NAME, of a dict without `name` one of its own; a campaign that was cut off goes on there.
    jobs: runs at once, one a core by default. retry: makes runs again that crashed, took too long or were refused.
    Ctrl-C ends it, from the main thread. Raises Error where runs were ended from outside; rows that are finished are kept."""
    from surefoot_campaign.cli import make_campaign
    from surefoot_campaign.errors import InputError
    from surefoot_campaign.plan import make_plan
    from surefoot_campaign.program import Program
    from surefoot_campaign.scheduler import LocalScheduler
    from surefoot_campaign.spec import load_spec

    if jobs is not None and jobs < 1:
        raise Error(f"jobs is {jobs}; a whole number above 0 would be valid")
    if isinstance(spec, Mapping):
        spec = plain_spec(spec)
    if isinstance(spec, Mapping) and "name" not in spec:
        spec = {**spec, "name": f"campaign_{hashlib.sha1(repr(spec_text(spec)).encode()).hexdigest()[:8]}"}
    workers = jobs or len(os.sched_getaffinity(0))
    with told_as_error(), tempfile.TemporaryDirectory(prefix="surefoot_") as folder:
        program = Program()
        path = pathlib.Path(folder) / "campaign.yaml" if isinstance(spec, Mapping) else pathlib.Path(spec)
        try:
            if isinstance(spec, Mapping):
                stacks = pathlib.Path(out or pathlib.Path("results") / str(spec["name"])).absolute() / "stacks"
                path.write_text(json.dumps(with_stacks_as_files(spec, stacks)))  # JSON is YAML
            loaded = load_spec(path)
            plan = make_plan(loaded, program, workers)
        except InputError as error:
            raise Error(re.sub(re.escape(str(path)) + r"(:\d+)?", "spec", str(error)) if isinstance(spec, Mapping) else str(error)) from None
        place = pathlib.Path(out or pathlib.Path("results") / loaded.name)
        try:
            made = make_campaign(plan, program, LocalScheduler(workers), place, retry)
        except InputError as error:
            raise Error(str(error).replace("with --out", "with out=")) from None
    if made.stopped == signal.SIGINT and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        raise KeyboardInterrupt(f"{made.kept()} in {place}; the same call goes on there")
    if made.stopped:
        signal.raise_signal(made.stopped)  # whoever asked this process to end, asked for more than the campaign
    if not made.is_whole():
        raise Error(f"{made.trouble()}; {made.kept()} in {place}: the same call goes on there")
    return Campaign(place, json.loads(json.dumps(made.found)), [*plan.notes, *filter(None, [made.broken_note("retry=True")])])


def plain_spec(value: Any) -> Any:
    """In lists, dicts, texts and numbers, but for each Stack."""
    if isinstance(value, Mapping):
        return {str(key): plain_spec(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [*map(plain_spec, value)]
    if value is None or isinstance(value, Stack) or type(value) in (str, int, float, bool):
        return value
    if isinstance(value, str):
        return str(value)
    return plain_spec(plain(value, "spec", "`stack` may be a Stack; scenarios and robots go by their names"))


def with_stacks_as_files(spec: Mapping[str, Any], folder: pathlib.Path) -> Any:
    """Each Stack in it as the path of its file, for the runs' processes."""
    written: list[str] = []

    def replaced(value: Any, robots: Callable[[], list[Robot | None]]) -> Any:
        if isinstance(value, Mapping):
            return {key: replaced(each, robots) for key, each in value.items()}
        if isinstance(value, list | tuple):
            return [replaced(each, robots) for each in value]
        return file_of(value, robots()) if isinstance(value, Stack) else value

    def file_of(stack: Stack, robots: list[Robot | None]) -> str:
        if stack.own_tasks:
            raise Error(f"stack {stack.name} has the task {stack.own_tasks[0].name}, which only this process knows; surefoot.run(…, seed=…) in a loop "
                        "would be valid")  # fmt: skip
        text = text_for(stack, robots)
        written.append(stack.name)
        number = written.count(stack.name)
        file = folder / f"{stack.name}{f'_{number}' if number > 1 else ''}.yaml"
        if file.exists() and file.read_text(encoding="utf-8") != text:
            raise Error(f"{folder.parent} has results of another stack {file.stem}; another `out`, or another name of the campaign, would be valid")
        folder.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return str(file)

    def section(key: str, value: Any) -> Any:
        if isinstance(value, Stack):
            raise Error(f"spec: {key} is a Stack; one under `set`, in a list under `grid`, or in one of `cases` would be valid")
        if key != "cases" or not isinstance(value, Mapping):
            return replaced(value, everywhere)
        return {name: replaced(case, functools.cache(partial(robots_in, spec, case))) for name, case in value.items()}

    everywhere = functools.cache(partial(robots_in, spec))
    return {key: section(key, value) for key, value in spec.items()}


def text_for(stack: Stack, robots: Sequence[Robot | None]) -> str:
    """Of its file, which is the same for all these robots."""
    texts = {stack.text(robot): robot for robot in reversed(robots)}
    if len(texts) > 1:
        names = ", ".join(dict.fromkeys(robot.name for robot in reversed(texts.values()) if robot is not None))
        raise Error(f"stack {stack.name} has other numbers for each of the robots {names}; a case for each robot, with `robot` and a Stack of its own, or the "
                    "name of a stack would be valid")  # fmt: skip
    return [*texts][0]


def spec_text(value: Any) -> Any:
    """The same for equal specs: each Stack as its file would be."""
    if isinstance(value, Mapping):
        return sorted((str(key), spec_text(each)) for key, each in value.items())
    if isinstance(value, list | tuple):
        return [spec_text(each) for each in value]
    return value.text() if isinstance(value, Stack) else value


def robots_in(spec: Mapping[str, Any], case: Any = None) -> list[Robot | None]:
    """All that the runs of a campaign may have, or those of one of its cases."""
    of = {key: section for key in ("set", "grid", "cases") if isinstance(section := spec.get(key), Mapping)}
    cases = [each for each in (of.get("cases", {}).values() if case is None else [case]) if isinstance(each, Mapping)]
    many = of.get("grid", {}).get("robot")
    one = of.get("set", {}).get("robot")
    names = many if isinstance(many, list | tuple) and many else [each.get("robot", one) for each in cases] or [one]
    robots: list[Robot | None] = [Robot(name) for name in dict.fromkeys(names) if isinstance(name, str)]
    scenarios = spec.get("scenario")
    if None in names:
        robots += [load_scenario(each).robot_model for each in (scenarios if isinstance(scenarios, list | tuple) else [scenarios]) if isinstance(each, str)]
    return robots or [None]  # what is wrong with the spec is found when it is read
