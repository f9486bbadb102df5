"""A recorded run in Python: its channels as NumPy arrays, its pictures and plots."""

from __future__ import annotations

import json
import math
import os
import pathlib
import warnings
from collections.abc import Iterator, Sequence
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa

from surefoot import _core
from surefoot._core import Error, Planner
from surefoot._errors import told_as_error
from surefoot._named import named
from surefoot.stack import Stack
from surefoot.task import OwnTask, with_registered
from surefoot_campaign.errors import InputError, valid_names
from surefoot_log.figures import figure_of
from surefoot_log.log_file import SUMMARY, LogFile
from surefoot_log.table import Table
from surefoot_log.worlds import in_world, transforms, world_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from PIL.Image import Image

Array = npt.NDArray[Any]
ERRORS = ["com", "height", "base", "heading"]  # of /alignment
KEPT = 1 << 28  # bytes: of a larger topic only the channels asked for stay in memory


def _check_folder(path: str | os.PathLike[str]) -> None:
    folder = pathlib.Path(path).absolute().parent
    if not folder.is_dir():
        raise InputError(f"path is {os.fspath(path)}, and there is no folder {folder}; one that exists would be valid")


def _nan_for_null(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _nan_for_null(each) for name, each in value.items()}
    return math.nan if value is None else value


class Recorded:
    """A recorded run. `run["state.p_WB.x"]` is a channel, a number a tick; `run["state.p_WB"]` all that begin so, a column each; `run.time` their times [s].

    A topic ("state", "plan", "command", …) is read when something of it is asked for; of a long log only that stays in memory.
    What is in W, the controller's world, and what is in S, the simulator's, can't be subtracted: `aligned_error("com")` is their difference."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._log = LogFile(path)
        self._tables: dict[str, pa.Table] = {}
        self._columns: dict[str, Array] = {}
        self.header: dict[str, Any] = self._log.header

    def __repr__(self) -> str:
        run = f"run of {self.header['scenario']}, seed {self.header['seed']}"
        what = run if self._has_plant else f"{self.header['robot']['name']}'s controller without a plant"
        return f"<{what}, {len(self.channels)} channels: {self._log.path}>"

    @property
    def _has_plant(self) -> bool:
        return "model.xml" in self._log.attachments

    def __fspath__(self) -> str:
        """So that what takes a log's path takes this: `surefoot.explain(run, 3.0)`."""
        return str(self.path)

    @property
    def path(self) -> pathlib.Path:
        return pathlib.Path(self._log.path)

    @property
    def topics(self) -> list[str]:
        return [topic.removeprefix("/") for topic in self._log.topics()]

    @cached_property
    def channels(self) -> dict[str, str]:
        """Each name with its unit; "" where it has none."""
        if "state" not in self.topics:
            return {}
        units: dict[str, str] = named({field.name: field.metadata[b"unit"].decode() for field in Table(self._log).schema})
        return units

    @property
    def events(self) -> list[dict[str, Any]]:
        """What happened, in order."""
        return [named(each) for each in self._log.events]

    @cached_property
    def _summary(self) -> dict[str, Any]:
        found: dict[str, Any] = json.loads(self._log.attachments.get(SUMMARY, "{}"))
        if "metrics" not in found:
            why = "the run was cut off" if self._has_plant else "it was recorded without a plant"
            raise Error(f"{self._log.path} has no metrics: {why}")
        return found

    @property
    def metrics(self) -> dict[str, Any]:
        """How the run went, by name, as `Result.metrics`; None: not judged, NaN: not measured."""
        judged = {name: self._summary["metrics"].get(name) for name in ("succeeded", "goal_reached")}
        found: dict[str, Any] = named({name: _nan_for_null(value) for name, value in self._summary["metrics"].items()} | judged)
        return found

    @property
    def criteria(self) -> list[dict[str, Any]]:
        """Of the scenario: of each its metric, its limit, the value, and whether it passed; None: not judged."""
        return [named(each) for each in self._summary["criteria"]]

    @cached_property
    def time(self) -> Array:
        """Of the ticks [s]."""
        if "state" not in self.topics:
            raise Error(str(self._log.no_tick("read")))
        return self._column("state", "time")

    def parts(self, topic: str) -> Iterator[pa.RecordBatch]:
        """A topic's channels a few hundred ticks at a time, for logs of any length."""
        self._check_topic(topic)
        yield from Table(self._log, {f"/{topic}"}).parts()

    def table(self, topic: str) -> pa.Table:
        """A topic's channels, a row a tick; `.to_pandas()` makes a data frame of it. Its columns don't know their worlds: never subtract those in S
        from those in W; aligned_error() has their difference."""
        self._check_topic(topic)
        if topic not in self._tables:
            table = Table(self._log, {f"/{topic}"})
            self._tables[topic] = pa.Table.from_batches(table.parts(), schema=table.schema)
        return self._tables[topic]

    def frame(self, topic: str) -> Any:
        """The same as a pandas data frame with the times as index, where pandas is installed. The same holds of worlds."""
        from surefoot.running import data_frame

        return data_frame(self.table(topic)).set_index("time")

    def __contains__(self, name: object) -> bool:
        return name == "time" or name in self.channels or any(each.startswith(f"{name}.") for each in self.channels)

    def __iter__(self) -> Iterator[str]:
        return iter(self.channels)

    def __len__(self) -> int:
        return len(self.channels)

    def __getitem__(self, name: str) -> Array:
        if not isinstance(name, str):
            raise TypeError(f"a channel is named by a text, as run[\"state.p_WB.x\"]; {name!r} was given")
        if name == "time":
            return self.time
        topic = name.partition(".")[0]
        names = self._names(topic)
        if name in names:
            return self._in_world(self._column(topic, name), [name])
        inside = [column for column in names if column.startswith(f"{name}.")]
        if name == f"{topic}.time":
            raise KeyError(f'{self._log.path} has no channel {name}; the times of the ticks are log.time, or log["time"]')
        if not inside:
            members = list(dict.fromkeys(".".join(column.split(".")[:2]) for column in names if column != "time"))
            raise KeyError(f"{self._log.path} has no channel {name}; {valid_names(name, members)}")
        return self._in_world(np.column_stack([self._column(topic, column) for column in inside]), inside)

    def _alignment(self, member: str) -> Array:
        if "/alignment" not in self._log.topics() or len(self.table("alignment").column_names) < 2:
            old = f"its version is {self.header['log_version']}, logs have it from 3.0 on; record the run anew"
            why = old if self._has_plant else "it was recorded without a plant"
            raise Error(f"{self._log.path} has no /alignment: {why}")
        return np.asarray(self[f"alignment.{member}"])

    @cached_property
    def _worlds(self) -> dict[str, str]:
        return {field.name: world_of(field.metadata[b"about"].decode()) for field in Table(self._log).schema}

    def X_WS(self, at: str = "feet") -> Array:
        """Of each tick the 4×4 matrix that takes the simulator's world S to the controller's W: by the "feet" that stand, as plans are compared with
        the truth, or as at the "start", by which the estimate's drift is counted."""
        if at not in ("feet", "start"):
            raise KeyError(f"X_WS is by the feet or as at the start; {valid_names(at, ['feet', 'start'])}")
        found: Array = transforms(self._alignment(f"{at}.p_WS"), self._alignment(f"{at}.q_WS"))
        return found

    def in_W(self, name: str, at: str = "feet") -> Array:
        """A vector of the truth in the controller's world: `in_W("truth.p_SCom")`."""
        values = self[name]
        if getattr(values, "world", "") != "S" or values.ndim != 2 or values.shape[1] != 3:
            raise KeyError(f"{name} is {self._no_vector(name, values)}; one vector in S, the simulator's world, as truth.p_SB or truth.p_SF.LF, would be valid")
        X = self.X_WS(at)
        turned = np.einsum("nij,nj->ni", X[:, :3, :3], np.asarray(values))
        is_place = any(part == "point" or part.startswith("p_") for part in name.split("."))
        found: Array = in_world(turned + X[:, :3, 3] if is_place else turned, "W")
        return found

    def _no_vector(self, name: str, values: Array) -> str:
        if getattr(values, "world", "") != "S":
            return "not in S"
        inside = dict.fromkeys(column.rpartition(".")[0] for column in self._names(name.partition(".")[0]) if column.startswith(f"{name}."))
        return f"{len(inside)} of them: {', '.join(inside)}" if len(inside) > 1 else "a part of one" if values.ndim == 1 else "no vector of x, y, z"

    def aligned_error(self, name: str) -> Array:
        """Of each tick an error with both worlds aligned: of the plan "com" (x and y, truth minus plan) and "height", by the feet that stand; of the
        estimate "base" (estimate minus truth) and "heading", since the start."""
        if name not in ERRORS:
            raise KeyError(f"there is no aligned error {name}; {valid_names(name, ERRORS)}")
        return self._alignment(f"{name}_error")

    def plot(self, *names: str, path: str | os.PathLike[str] | None = None) -> Figure:
        """A figure of the report, as "com_tracking" (the paper's Fig. 4) or "terrain_adaptation" (Fig. 6), or channels over time, those of one unit
        in one plot. path: where to write it too, as .pdf, .svg or .png. Without a name it draws "com_tracking"."""
        with told_as_error():
            if path is not None:
                _check_folder(path)
            figure: Figure = figure_of(self, names or ("com_tracking",))
            if path is not None:
                figure.savefig(os.fspath(path))
        return figure

    @property
    def figures(self) -> list[str]:
        """Names of the report's figures for plot()."""
        from surefoot_report.report import FIGURES

        return list(FIGURES)

    def picture(self, time: float, path: str | os.PathLike[str] | None = None, size: tuple[int, int] = (1280, 720)) -> Image:
        """The robot at a time [s], drawn without a screen."""
        from surefoot_log.pictures import make_picture

        with told_as_error():
            if path is not None:
                _check_folder(path)
            image = make_picture(self._log, time, size)
            if path is not None:
                image.save(os.fspath(path))
        return image

    def film(
        self,
        path: str | os.PathLike[str],
        first: float | None = None,
        last: float | None = None,
        *,
        size: tuple[int, int] = (1280, 720),
        rate: int = 25,
        speed: float = 1.0,
    ) -> pathlib.Path:
        """A film in MP4 of the run, or of its part between two times [s]."""
        from surefoot_log.pictures import make_film

        with told_as_error():
            make_film(self._log, pathlib.Path(path), size, rate, speed, first, last)
        return pathlib.Path(path)

    def report(self, folder: str | os.PathLike[str], pictures: bool = True) -> pathlib.Path:
        """The page that `surefoot run --report` makes; returns its path."""
        from surefoot_report.report import write_report

        with told_as_error():
            return pathlib.Path(write_report(self._log.path, folder, pictures))

    def verify(self, *, own_tasks: Sequence[OwnTask] = (), planner: Planner | None = None) -> dict[str, Any]:
        """Computes every torque again, as `surefoot replay --verify`: whether they are the `same`, to the bit, in how many `ticks`, and what differs.

        own_tasks, planner: your own of the run, as they were at its start, each task with a name of its own. Tasks that are registered are known.
        Without a planner its plans are the log's, as the states of an estimator of your own always are."""
        found = self._computed(_core.verify_log(str(self.path), own_tasks, planner))
        if not found["same"] and "fault" in found:
            warnings.warn(f"as the run is computed again, {found['fault']}", RuntimeWarning, stacklevel=3)
        return found

    def compare(self, stack: Stack | str | os.PathLike[str], *, own_tasks: Sequence[OwnTask] = ()) -> dict[str, Any]:
        """What another stack would have commanded at each tick, as `surefoot replay --stack`: its `torque_difference` and `levels` beside the run's.

        stack: a Stack, whose numbers are made for the run's robot, or a name or file. own_tasks: as for verify(); without them the run's are
        those of the Stack."""
        if not isinstance(stack, Stack):
            return self._computed(_core.compare_stack(str(self.path), os.fspath(stack), own_tasks))
        known = [task.task for task in with_registered(own_tasks)]
        of_run = [*own_tasks, *(task for task in stack.own_tasks if task.task not in known)]
        text_for = partial(stack.text, changed=self.header["options"].get("tasks") or {})
        return self._computed(_core.compare_made_stack(str(self.path), text_for, stack.name, stack.own_tasks, of_run))

    @staticmethod
    def _computed(found: str) -> dict[str, Any]:
        computed: dict[str, Any] = named(json.loads(found))
        return computed

    def _in_world(self, values: Array, names: list[str]) -> Array:
        """Marked with its world, so that it can't be subtracted from another's."""
        worlds = {self._worlds[name] for name in names}
        marked: Array = in_world(values, worlds.pop() if len(worlds) == 1 else "")
        return marked

    def _check_topic(self, topic: str) -> None:
        if topic not in self.topics:
            raise KeyError(f"{self._log.path} has no topic {topic}; {valid_names(topic, self.topics)}")

    def _names(self, topic: str) -> list[str]:
        self._check_topic(topic)
        return [name for name in Table(self._log, {f"/{topic}"}).schema.names]

    def _column(self, topic: str, name: str) -> Array:
        if topic in self._tables or self._log.num_messages(f"/{topic}") * 8 * len(self._names(topic)) < KEPT:
            return np.asarray(self.table(topic)[name].to_numpy())
        if name not in self._columns:
            self._columns[name] = np.concatenate([part.column(name).to_numpy(zero_copy_only=False) for part in self.parts(topic)])
        return self._columns[name]
