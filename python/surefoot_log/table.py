"""A log as one table: a row a tick, a column a channel."""

import json
import os

import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet

from surefoot_campaign.errors import InputError, valid_names
from surefoot_log.channels import Flattener

TYPES = {"number": pa.float64(), "integer": pa.int64(), "boolean": pa.bool_(), "text": pa.string()}
TICK = "/state"  # the topic whose messages say which ticks there are


def wanted_topics(names):
    """None: all. A name may stand without its slash."""
    if not names:
        return None
    return {name if name.startswith("/") else f"/{name}" for name in names}


def check_topics(wanted, log):
    known = sorted(channel.topic for channel in log.channels.values())
    for topic in sorted(wanted or []):
        if topic not in known:
            raise InputError(f'unknown topic "{topic}"; {valid_names(topic, known)}')


def read_messages(log, topics, every):
    """The times of every so manieth tick [ns], and of each topic its messages at these times. The timings stand behind all
    ticks; what comes before its tick's state waits for it."""
    ticks, found, waiting, number = set(), {}, [], -1
    for message in log.messages(None if topics is None else topics | {TICK}):
        if waiting and waiting[0].time < message.time:
            waiting.clear()
        if message.topic == TICK:
            number += 1
            if number % every == 0:
                ticks.add(message.time)
                keep(found, waiting)
            waiting.clear()
        if topics is not None and message.topic not in topics:
            continue
        if message.time in ticks:
            keep(found, [message])
        else:
            waiting.append(message)
    return sorted(ticks), found


def keep(found, messages):
    for message in messages:
        found.setdefault(message.topic, {})[message.time] = bytes(message.data)


def topic_arrays(log, topic, rows, times):
    """The columns of a topic, one value a time; null where it has no message."""
    decoded = [json.loads(rows[time]) if time in rows else None for time in times]
    example = next((message for message in decoded if message is not None), None)
    if example is None:
        return []
    flattener = Flattener(topic, log.schema_of(topic), log.header, example)
    columns = list(zip(*(flattener.values(message) for message in decoded)))
    return [(channel, pa.array(values, TYPES[channel.kind])) for channel, values in zip(flattener.channels, columns)]


def read_table(log, topics=None, every=1):
    """Throws InputError on unknown topics, and where the log holds no tick."""
    times, by_topic = read_messages(log, topics, every)
    if not times:
        raise InputError(f"{log.path}: the log holds no tick, so there is nothing to export{'; ' + log.problem if log.problem else ''}")
    check_topics(topics, log)
    fields = [pa.field("time", pa.float64(), metadata={"unit": "s", "about": "since the start of the run"})]
    arrays = [pa.array([1e-9 * time for time in times], pa.float64())]
    for topic, rows in by_topic.items():
        for channel, array in topic_arrays(log, topic, rows, times):
            fields.append(pa.field(channel.name, array.type, metadata={"unit": channel.unit, "about": channel.about}))
            arrays.append(array)
    return pa.Table.from_arrays(arrays, schema=pa.schema(fields, metadata={"surefoot": json.dumps(log.header)}))


def written_whole(path, write):
    """Under another name first, so that nothing partial ever has its name."""
    partial = f"{path}.partial"
    try:
        write(partial)
        os.replace(partial, path)
    except OSError as error:
        raise InputError(f"{path}: can't be written: {error.strerror or error}") from None
    finally:
        if os.path.exists(partial):
            os.remove(partial)


def write_csv(table, path):
    written_whole(path, lambda partial: pyarrow.csv.write_csv(table, partial, pyarrow.csv.WriteOptions(quoting_style="needed")))


def write_parquet(table, path):
    written_whole(path, lambda partial: pyarrow.parquet.write_table(table, partial, compression="zstd"))
