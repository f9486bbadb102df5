"""Whole runs: one, or a campaign of many."""

from __future__ import annotations

import contextlib
import io
import json
import os
import pathlib
import re
import tempfile
from collections.abc import Callable, Mapping, Sequence
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from surefoot import _core
from surefoot._core import Error, Estimator, Planner, Result, Robot, Scenario, Tick
from surefoot._arguments import checked
from surefoot._errors import told_as_error
from surefoot.control import load_scenario
from surefoot.stack import Stack

if TYPE_CHECKING:
    import pyarrow as pa


@checked
def run(
    scenario: Scenario | str,
    *,
    seed: int = 0,
    set: Sequence[str] = (),
    robot: Robot | str | None = None,
    stack: Stack | str | None = None,
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
    seed, set, robot, stack: as for load_scenario(), where the scenario is a name. Other threads go on meanwhile; Ctrl-C ends it."""
    if isinstance(scenario, Scenario) and (seed, [*set], robot, stack) != (0, [], None, None):
        raise Error("seed, set, robot and stack are for a scenario's name: give them to load_scenario()")
    given = scenario if isinstance(scenario, Scenario) else load_scenario(scenario, seed, set, robot=robot, stack=stack)
    return _core.run_scenario(given, None if record is None else os.fspath(record), every_tick, estimator, planner)


class Campaign:
    """What came of a campaign: `.table` has a row a run, `.points` a row a point of its grid, `.pairs` the cases against the first one, seed by seed."""

    def __init__(self, folder: pathlib.Path, summary: dict[str, Any]) -> None:
        self.folder, self.summary = folder, summary

    def __repr__(self) -> str:
        every = self.summary["all"]
        return f"<campaign {self.summary['name']}: {every['successes']} of {every['trials']} runs succeeded: {self.folder}>"

    @property
    def table(self) -> pa.Table:
        """A row a run: its parameters, outcome and metrics; `.to_pandas()` makes a data frame of it."""
        import pyarrow.parquet

        return pyarrow.parquet.read_table(self.folder / "runs.parquet")

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
def campaign(spec: str | os.PathLike[str] | Mapping[str, Any], *, out: str | os.PathLike[str] | None = None, jobs: int | None = None) -> Campaign:
    """Runs a grid of scenario parameters times seeds, each run in a process of its own, as `surefoot campaign` does.

    spec: a file, the name of one that ships, or its content as a dict: {"scenario": "walk_flat", "seeds": [1, 2, 3], "grid": {…}}.
    out: folder of the results, by default results/NAME; a campaign that was cut off goes on there. jobs: runs at once, one a core by default.
    """
    from surefoot_campaign.cli import make_campaign
    from surefoot_campaign.command_line import WRONG_INPUT
    from surefoot_campaign.errors import InputError
    from surefoot_campaign.plan import make_plan
    from surefoot_campaign.program import Program
    from surefoot_campaign.spec import load_spec

    if jobs is not None and jobs < 1:
        raise Error(f"jobs is {jobs}; a whole number above 0 would be valid")
    with told_as_error(), tempfile.TemporaryDirectory(prefix="surefoot_") as folder:
        path = pathlib.Path(spec) if not isinstance(spec, Mapping) else pathlib.Path(folder) / f"{spec.get('name', 'campaign')}.yaml"
        if isinstance(spec, Mapping):
            path.write_text(json.dumps(dict(spec)))  # JSON is YAML
        try:
            loaded = load_spec(path)
        except InputError as error:
            raise Error(re.sub(re.escape(str(path)) + r"(:\d+)?", "spec", str(error)) if isinstance(spec, Mapping) else str(error)) from None
        program, workers = Program(), jobs or len(os.sched_getaffinity(0))
        place = pathlib.Path(out or pathlib.Path("results") / loaded.name)
        arguments = SimpleNamespace(scheduler="local", jobs=workers, retry=False, no_plots=True, json=True)
        with contextlib.redirect_stdout(io.StringIO()):
            status = make_campaign(make_plan(loaded, program, workers), program, arguments, place, [str(path)])
    if status == WRONG_INPUT:
        raise KeyboardInterrupt(f"rows that are finished are kept in {place}; the same call goes on there")
    return Campaign(place, json.loads((place / "summary.json").read_text()))
