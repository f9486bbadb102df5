"""A recorded run in Python: its channels as NumPy arrays."""

from functools import cached_property

import numpy as np
import pyarrow as pa

from surefoot_campaign.errors import valid_names
from surefoot_log.log_file import LogFile
from surefoot_log.table import Table
from surefoot_log.worlds import in_world, transforms, world_of


ERRORS = ["com", "height", "base", "heading"]  # of /alignment


class Recorded:
    """A recorded run. `run["state.p_WB.x"]` is a channel, a number a tick; `run["state.p_WB"]` all that begin so, a column each; `run.time` their times [s].
    A topic ("state", "plan", "command", …) is read when something of it is asked for, and kept. What is in W, the controller's world, and what is in
    S, the simulator's, can't be subtracted: `aligned_error("com")` is their difference."""

    def __init__(self, path):
        self._log, self._tables = LogFile(path), {}
        self.header: dict = self._log.header

    def __repr__(self):
        return f"<run of {self.header['scenario']}, seed {self.header['seed']}, {len(self.channels)} channels: {self._log.path}>"

    @cached_property
    def channels(self) -> dict[str, str]:
        """Each name with its unit; "" where it has none."""
        return {field.name: field.metadata[b"unit"].decode() for field in Table(self._log).schema}

    @property
    def events(self) -> list[dict]:
        """What happened, in order."""
        return self._log.events

    @cached_property
    def time(self) -> np.ndarray:
        """Of the ticks [s]."""
        return self.table("state")["time"].to_numpy()

    def table(self, topic: str) -> pa.Table:
        """A topic's channels, a row a tick; `.to_pandas()` makes a data frame of it."""
        if topic not in self._tables:
            table = Table(self._log, {f"/{topic}"})
            self._tables[topic] = pa.Table.from_batches(table.parts(), schema=table.schema)
        return self._tables[topic]

    def _alignment(self, member: str) -> np.ndarray:
        if "/alignment" not in self._log.topics() or len(self.table("alignment").column_names) < 2:
            raise KeyError(f"{self._log.path} has no /alignment: its version is {self.header['log_version']}, logs have it from 3.0 on; record the run anew")
        return np.asarray(self[f"alignment.{member}"])

    @cached_property
    def _worlds(self) -> dict[str, str]:
        return {field.name: world_of(field.metadata[b"about"].decode()) for field in Table(self._log).schema}

    def X_WS(self, at: str = "feet") -> np.ndarray:
        """Of each tick the 4×4 matrix that takes the simulator's world S to the controller's W: by the "feet" that stand, as plans are compared with
        the truth, or as at the "start", by which the estimate's drift is counted."""
        if at not in ("feet", "start"):
            raise KeyError(f"X_WS is by the feet or as at the start; {valid_names(at, ['feet', 'start'])}")
        return transforms(self._alignment(f"{at}.p_WS"), self._alignment(f"{at}.q_WS"))

    def in_W(self, name: str, at: str = "feet") -> np.ndarray:
        """A vector of the truth in the controller's world: `in_W("truth.p_SCom")`."""
        values = self[name]
        if getattr(values, "world", "") != "S" or values.ndim != 2 or values.shape[1] != 3:
            raise KeyError(f"{name} is no vector in S, the simulator's world; truth.p_SB and truth.v_SCom are")
        X = self.X_WS(at)
        turned = np.einsum("nij,nj->ni", X[:, :3, :3], np.asarray(values))
        is_place = any(part == "point" or part.startswith("p_") for part in name.split("."))
        return in_world(turned + X[:, :3, 3] if is_place else turned, "W")

    def aligned_error(self, name: str) -> np.ndarray:
        """Of each tick an error with both worlds aligned: of the plan "com" (x and y, truth minus plan) and "height", by the feet that stand; of the
        estimate "base" (estimate minus truth) and "heading", since the start."""
        if name not in ERRORS:
            raise KeyError(f"there is no aligned error {name}; {valid_names(name, ERRORS)}")
        return self._alignment(f"{name}_error")

    def __getitem__(self, name: str) -> np.ndarray:
        topic, topics = name.partition(".")[0], [each.removeprefix("/") for each in self._log.topics()]
        if topic not in topics:
            raise KeyError(f"{self._log.path} has no topic {topic}; {valid_names(topic, topics)}")
        table = self.table(topic)
        if name in table.column_names:
            return in_world(table[name].to_numpy(), self._worlds[name])
        inside = [column for column in table.column_names if column.startswith(f"{name}.")]
        if not inside:
            members = list(dict.fromkeys(".".join(column.split(".")[:2]) for column in table.column_names if column != "time"))
            raise KeyError(f"{self._log.path} has no channel {name}; {valid_names(name, members)}")
        worlds = {self._worlds[column] for column in inside}
        return in_world(np.column_stack([table[column].to_numpy() for column in inside]), worlds.pop() if len(worlds) == 1 else "")
