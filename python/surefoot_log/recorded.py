"""A recorded run in Python: its channels as NumPy arrays."""

from functools import cached_property

import numpy as np
import pyarrow as pa

from surefoot_campaign.errors import valid_names
from surefoot_log.log_file import LogFile
from surefoot_log.table import Table


class Recorded:
    """A recorded run. `run["state.p_WB.x"]` is a channel, a number a tick; `run["state.p_WB"]` all that begin so, a column each; `run.time` their times [s].
    A topic ("state", "plan", "command", …) is read when something of it is asked for, and kept."""

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

    def __getitem__(self, name: str) -> np.ndarray:
        topic, topics = name.partition(".")[0], [each.removeprefix("/") for each in self._log.topics()]
        if topic not in topics:
            raise KeyError(f"{self._log.path} has no topic {topic}; {valid_names(topic, topics)}")
        table = self.table(topic)
        if name in table.column_names:
            return table[name].to_numpy()
        inside = [column for column in table.column_names if column.startswith(f"{name}.")]
        if not inside:
            members = list(dict.fromkeys(".".join(column.split(".")[:2]) for column in table.column_names if column != "time"))
            raise KeyError(f"{self._log.path} has no channel {name}; {valid_names(name, members)}")
        return np.column_stack([table[column].to_numpy() for column in inside])
