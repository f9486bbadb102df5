"""A log, read from front to back; what can't be read is passed over."""

import heapq
import json
import pathlib
import re
from contextlib import suppress
from functools import cache
from itertools import groupby
from operator import attrgetter

from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, DataEnd, Footer, Schema

from surefoot_campaign.errors import InputError
from surefoot_log import chunk
from surefoot_log.records import HEAD, MAGIC, Walk, read_record, summary_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
VERSION_SOURCE = ROOT / "surefoot/logging/log_header.hpp"
APART = {"/timings"}  # topics behind all ticks (docs/log.md)
HEADER, SUMMARY = "header.json", "summary.json"
PARTS = {"scenario": str, "seed": int, "control_period": (int, float), "level_names": list, "event_names": list, "robot": dict}
TOLD = 4  # places of damage
OTHER_COMPRESSION = ("its chunks are compressed with lz4; chunks with zstd or without compression would be valid: "
                     "`mcap compress LOG -o NEW.mcap --compression zstd` rewrites it")


@cache
def log_version():
    """Of the logs that this program makes, from where it is written (docs/log.md)."""
    return re.search(r'kLogVersion = "([\d.]+)"', VERSION_SOURCE.read_text()).group(1)


class BehindTicks:
    """Which chunks stand behind all ticks: those from the first on whose time goes back."""

    def __init__(self):
        self._latest = -1
        self._begun = False

    def __call__(self, record):
        self._begun = self._begun or record.message_start_time <= self._latest
        self._latest = record.message_start_time
        return self._begun


class LogFile:
    """What stands in front of the messages is known at once; the rest after `messages` came to its end."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.partial_beside = self.path.with_name(self.path.name + ".partial")
        self.attachments, self.channels, self.schemas = {}, {}, {}
        self.losses = []  # places that could not be read, and why
        self._at, self._end, self._closed, self._has_learned, self._has_all_data = 0, "", False, False, False
        self._check_magic()
        if next(self._records(), None) is None and not self._closed:
            self._end = f"cut off at byte {self._at}"
        self.header = self._header()

    def _check_magic(self):
        valid = "a log made by surefoot (.mcap) would be valid"
        if self.path.is_dir():
            raise InputError(f"{self.path}: is a folder; a log in it (.mcap) would be valid")
        try:
            with open(self.path, "rb") as file:
                start = file.read(len(MAGIC))
        except OSError as error:
            if self.partial_beside.is_file():
                valid = f"{self.partial_beside}, of a run that goes on or was cut off, would be valid"
            raise InputError(f"{self.path}: can't be read: {error.strerror}; {valid}") from None
        if not start:
            raise InputError(f"{self.path}: the file is empty; {valid}")
        if start != MAGIC[: len(start)]:
            raise InputError(f"{self.path}: not an MCAP file; {valid}")

    def _header(self):
        text = self.attachments.get(HEADER)
        elsewhere = "the messages in it can be read by other readers of MCAP, but not by surefoot: record the run anew"
        if text is None and self.losses:
            raise InputError(f"{self.path}: {self.losses[0]}, so that its {HEADER} is lost, which says what run it is; {elsewhere}")
        if text is None and self._end:
            raise InputError(f"{self.path}: {self._end}, before its header was whole, so that nothing of the run can be read; "
                             "record the run anew")
        if text is None:
            raise InputError(f"{self.path}: an MCAP file, but it does not begin with a header of surefoot; "
                             "a log made by surefoot would be valid")
        try:
            header = json.loads(text)
            version = str(header["log_version"])
        except (ValueError, KeyError, TypeError, RecursionError):
            raise InputError(f"{self.path}: its {HEADER}, which says what run it is, is damaged; {elsewhere}") from None
        major = log_version().split(".")[0]
        if version.split(".")[0] != major:
            raise InputError(f"{self.path}: log version {version}; this program reads {log_version()} and all others of {major}.x. "
                             "Read it with the version of surefoot that made it, or record the run anew")
        for name, kind in PARTS.items():
            if not isinstance(header.get(name), kind):
                raise InputError(f"{self.path}: its {HEADER}, which says what run it is, lacks {name}, or has something else in its place; "
                                 f"{elsewhere}")
        return header

    def _records(self):
        """The file's chunks, and messages outside of chunks; keeps what belongs to the file as a whole."""
        with open(self.path, "rb") as file:
            walk = Walk(file, self.path.stat().st_size)
            self._at = len(MAGIC)
            for skipped, self._at, opcode, length in walk:
                if skipped:
                    begin = self._at - skipped
                    self._lose("a record's head is damaged", begin, walk.lost_times(begin, self._at))
                file.seek(self._at + HEAD.size)
                try:
                    record = read_record(opcode, file, length)
                except chunk.Damaged as damage:
                    self._lose(str(damage), self._at)
                    continue
                if isinstance(record, Chunk) and record.compression == "lz4":
                    raise InputError(f"{self.path}: {OTHER_COMPRESSION}")
                if opcode in (Opcode.CHUNK, Opcode.MESSAGE):
                    yield record
                else:
                    self._keep(record)
                self._at += HEAD.size + length
                if self._closed:
                    return

    def _place(self, why, at):
        return f"{why} at byte {at} of {self.path.stat().st_size}"

    def _lose(self, why, at, times=None):
        """`times` of the first and last message there [ns]."""
        span = f" ({1e-9 * times[0]:.4f} s to {1e-9 * times[1]:.4f} s)" if times else ""
        self.losses.append(self._place(why, at) + span)
        if not self._has_learned:
            self._has_learned = True
            self._learn_descriptions()

    def _learn_descriptions(self):
        """Channels stand in the chunk of their first message, which may be lost, and once more behind the data."""
        with open(self.path, "rb") as file:
            for _, at, opcode, length in Walk(file, self.path.stat().st_size):
                if opcode in (Opcode.SCHEMA, Opcode.CHANNEL):
                    file.seek(at + HEAD.size)
                    with suppress(chunk.Damaged):
                        self._keep(read_record(opcode, file, length))

    @property
    def complete(self):
        return self._closed and not self.losses

    @property
    def problem(self):
        """What is lost so far, and where the file was cut off, without the file's name; empty if nothing is."""
        parts = []
        if self.losses:
            more = f" and {len(self.losses) - TOLD} more places" if len(self.losses) > TOLD else ""
            parts.append(f"{', '.join(self.losses[:TOLD])}{more}; what stood there is lost, the rest was read")
        if self._end:
            lost = (", behind all of the run: only the index of the file is lost" if self._has_all_data
                    else ": what came behind it is lost, everything before it was read")
            parts.append(self._end + lost)
        return "; ".join(parts)

    def _keep(self, record):
        if isinstance(record, Attachment):
            self.attachments[record.name] = record.data
        elif isinstance(record, Schema):
            self.schemas[record.id] = record
        elif isinstance(record, Channel):
            self.channels[record.id] = record
        elif isinstance(record, DataEnd):
            self._has_all_data = True
        elif isinstance(record, Footer):
            self._closed = True

    def messages(self, topics=None, wanted=lambda record: True):
        """The messages, all or those of some topics, one after the other; of wanted chunks only, where
        others are not even decompressed, and those outside of chunks. What is damaged is passed over."""
        self._closed, self._end, self.losses = False, "", []
        for record in self._records():
            is_chunk = isinstance(record, Chunk)
            try:
                if not is_chunk:
                    yield from chunk.message(memoryview(record), self.channels, topics)
                elif wanted(record):
                    yield from chunk.messages(record, self.schemas, self.channels, topics)
            except chunk.Damaged as damage:
                self._lose(str(damage), self._at, (record.message_start_time, record.message_end_time) if is_chunk else None)
        if not self._closed:
            self._end = f"cut off at byte {self._at}"

    def by_time(self, topics=None):
        """The messages of all or some topics, time by time: each time [ns] with its messages. What stands apart behind all
        ticks is read beside them, so that nothing waits in memory."""
        apart = APART if topics is None else APART & topics
        others = (message for message in self.messages(topics) if message.topic not in APART)
        merged = heapq.merge(others, self._beside(apart), key=attrgetter("time")) if apart else others
        for time, group in groupby(merged, key=attrgetter("time")):
            yield time, list(group)

    def _beside(self, topics):
        """Messages that stand apart, by a file of their own; of the ticks before them only the chunks' heads are read."""
        beside = LogFile(self.path)
        beside.channels, beside.schemas = self.channels, self.schemas
        places = self._chunks_with(topics)
        yield from beside.messages(topics, BehindTicks() if places is None else lambda record: beside._at in places)

    def _chunks_with(self, topics):
        """Where the chunks begin that hold messages of some topics; None: not known."""
        summary = self._summary()
        if summary is None or any(not index.message_index_offsets for index in summary.chunk_indexes):
            return None
        wanted = {channel.id for channel in summary.channels.values() if channel.topic in topics}
        return {index.chunk_start_offset for index in summary.chunk_indexes if wanted & index.message_index_offsets.keys()}

    def first_messages(self):
        """Of each topic its first message. Of a log that was closed only the chunks that hold one are decompressed."""
        places = self._first_chunks()
        first = self._first_of(lambda record: places is None or self._at in places)
        return first if places is None or not self.losses else self._first_of(lambda record: True)

    def _first_of(self, wanted):
        first = {}
        for message in self.messages(wanted=wanted):
            first.setdefault(message.topic, message)
        return first

    def topics(self):
        """All topics, if the log was closed, so that they stand at its end; None otherwise."""
        summary = self._summary()
        return summary and {channel.topic for channel in summary.channels.values()}

    def _first_chunks(self):
        """Where the chunks begin that hold the first message of a topic; None: not known."""
        summary = self._summary()
        if summary is None:
            return None
        starts = {}
        for index in sorted(summary.chunk_indexes, key=attrgetter("chunk_start_offset")):
            for channel in index.message_index_offsets:
                starts.setdefault(channel, index.chunk_start_offset)
        return set(starts.values())

    def _summary(self):
        with open(self.path, "rb") as file:
            return summary_of(file)

    def schema_record(self, topic):
        """Of a topic whose messages came."""
        return next(self.schemas[channel.schema_id] for channel in self.channels.values() if channel.topic == topic)

    def schema_of(self, topic):
        """The JSON schema of a topic's messages."""
        return json.loads(self.schema_record(topic).data)

    def text(self, name):
        """An attachment. Throws InputError if the log has none of that name."""
        if name not in self.attachments:
            raise InputError(f"{self.path}: has no attachment {name}, which this needs; record the run anew"
                             f"{'; ' + self.problem if self.problem else ''}")
        return self.attachments[name].decode()

    def decoded(self, topic, data):
        """What a message says. Throws InputError where it says nothing."""
        try:
            return json.loads(bytes(data))
        except (ValueError, RecursionError) as error:
            raise InputError(f"{self.path}: a message on {topic} is not what it should be: {error}") from None
