"""A log as one table: a row a tick, a column a channel. It goes from the log into the files in parts, whatever its length."""

import json
from contextlib import ExitStack
from itertools import islice

import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet

from surefoot_campaign.errors import InputError, valid_names
from surefoot_campaign.output_files import written_whole
from surefoot_log.channels import Flattener

TYPES = {"number": pa.float64(), "integer": pa.int64(), "boolean": pa.bool_(), "string": pa.string()}
TICK = "/state"  # each tick has a message on this topic
PART = 256  # ticks that are decoded at once
GROUP = 4096  # ticks of a row group in Parquet: columns are compressed in it, and all of it is in memory


def wanted_topics(names):
    """The topics by their full names; None means all. A name may lack its slash."""
    if not names:
        return None
    return {name if name.startswith("/") else f"/{name}" for name in names}


def check_topics(wanted, known):
    """Throws InputError on a topic that is not known."""
    known = sorted(known)
    for topic in sorted(wanted or []):
        if topic not in known:
            raise InputError(f'unknown topic "{topic}"; {valid_names(topic, known)}')


def first_messages(log, topics):
    """The first message of each topic, which has the sizes of lists. Throws InputError on unknown topics, and where there is no tick."""
    check_topics(topics, log.topics())
    first = {topic: log.decoded(topic, message.data) for topic in log.topics() for message in islice(log.messages({topic}), 1)}
    if TICK not in first:
        raise log.no_tick("export")
    return {topic: message for topic, message in first.items() if topics is None or topic in topics}


class Table:
    """The columns of a log, and its rows in parts; null where a tick has no message on a topic."""

    def __init__(self, log, topics=None, every=1):
        self._log, self._topics, self._every = log, topics, every
        first = first_messages(log, topics)
        self._flatteners = {topic: Flattener(topic, log.schema_of(topic), log.header, message) for topic, message in first.items()}
        fields = [pa.field("time", pa.float64(), metadata={"unit": "s", "about": "since the start of the run"})]
        for flattener in self._flatteners.values():
            fields += [pa.field(channel.name, TYPES[channel.kind], metadata={"unit": channel.unit, "about": channel.about})
                       for channel in flattener.channels]  # fmt: skip
        self.schema = pa.schema(fields, metadata={"surefoot": json.dumps(log.header)})

    def _ticks(self):
        """One of `every` ticks."""
        number = -1
        for time, messages in self._log.by_time(None if self._topics is None else self._topics | {TICK}):
            found = {message.topic: message.data for message in messages}
            number += TICK in found
            if TICK in found and number % self._every == 0:
                yield time, found

    def parts(self):
        all_ticks = self._ticks()
        while ticks := list(islice(all_ticks, PART)):
            arrays = [pa.array([time / 1e9 for time, _ in ticks], pa.float64())]
            for topic, flattener in self._flatteners.items():
                rows = [flattener.values(self._log.decoded(topic, found[topic]) if topic in found else None) for _, found in ticks]
                arrays += [pa.array(values, TYPES[channel.kind]) for channel, values in zip(flattener.channels, zip(*rows))]
            yield pa.RecordBatch.from_arrays(arrays, schema=self.schema)


class Grouped:
    """Collects parts to groups of rows, as a Parquet file should have them."""

    def __init__(self, writer):
        self._writer, self._parts = writer, []

    def write_batch(self, part):
        self._parts.append(part)
        if sum(part.num_rows for part in self._parts) >= GROUP:
            self._flush()

    def _flush(self):
        if self._parts:
            self._writer.write_table(pa.Table.from_batches(self._parts).combine_chunks(), row_group_size=GROUP)
        self._parts = []

    def close(self):
        self._flush()
        self._writer.close()


def with_unit(field):
    """The name of a column in CSV, which has no other place for its unit: "plan.com.p.x[m]"."""
    unit = field.metadata[b"unit"].decode()
    return f"{field.name}[{unit}]" if unit else field.name


class Csv:
    """Writes parts under names with units."""

    def __init__(self, path, schema):
        self._schema = pa.schema([field.with_name(with_unit(field)) for field in schema])
        self._writer = pyarrow.csv.CSVWriter(path, self._schema, write_options=pyarrow.csv.WriteOptions(quoting_style="needed"))

    def write_batch(self, part):
        self._writer.write_batch(pa.RecordBatch.from_arrays(part.columns, schema=self._schema))

    def close(self):
        self._writer.close()


def parquet_writer(path, schema):
    return Grouped(pyarrow.parquet.ParquetWriter(path, schema, compression="zstd"))


def write_table(table, files):
    """`files`: each path with what makes its writer, of those above."""
    with ExitStack() as stack:
        writers = []
        for path, make in files:
            partial = stack.enter_context(written_whole(path))
            writers.append(make(partial, table.schema))
        for part in table.parts():
            for writer in writers:
                writer.write_batch(part)
        for writer in writers:
            writer.close()
