"""A log, read from front to back as far as it goes."""

import heapq
import io
import json
import pathlib
import re
import struct
from functools import cache
from itertools import groupby
from operator import attrgetter

from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.reader import make_reader
from mcap.records import Attachment, Channel, Chunk, Footer, Schema

from surefoot_campaign.errors import InputError
from surefoot_log import chunk

ROOT = pathlib.Path(__file__).resolve().parents[2]
VERSION_SOURCE = ROOT / "surefoot/logging/log_header.hpp"
MAGIC = b"\x89MCAP0\r\n"
APART = {"/timings"}  # topics behind all ticks (docs/log.md)
HEADER, SUMMARY = "header.json", "summary.json"
HEAD = struct.Struct("<BQ")
KINDS = {Opcode.ATTACHMENT: Attachment, Opcode.CHANNEL: Channel, Opcode.CHUNK: Chunk, Opcode.FOOTER: Footer, Opcode.SCHEMA: Schema}


@cache
def log_version():
    """Of the logs that this program makes, from where it is written (docs/log.md)."""
    return re.search(r'kLogVersion = "([\d.]+)"', VERSION_SOURCE.read_text()).group(1)


def read_record(opcode, file, length):
    """A record of those that matter here; None of the others."""
    if opcode not in KINDS:
        return None
    stream = ReadDataStream(io.BytesIO(file.read(length)))
    try:
        return KINDS[opcode].read(stream)
    except (McapError, EOFError, ValueError) as error:
        raise chunk.Damaged(str(error) or "a record is shorter than it says") from None


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
        self.attachments, self.channels, self.schemas = {}, {}, {}
        self.problem, self._at = "", 0  # why it could not be read to its end, and where
        self.complete = False
        self._check_magic()
        damage = ""  # of what stands in front of the messages
        try:
            if next(self._records(), None) is None and not self.complete:
                damage = "cut off"
        except chunk.Damaged as found:
            damage = str(found)
        self.header = self._header(damage)

    def _check_magic(self):
        valid = "a log made by surefoot (.mcap) would be valid"
        try:
            with open(self.path, "rb") as file:
                start = file.read(len(MAGIC))
        except OSError as error:
            raise InputError(f"{self.path}: can't be read: {error.strerror}; {valid}") from None
        if not start:
            raise InputError(f"{self.path}: the file is empty; {valid}")
        if start != MAGIC[: len(start)]:
            raise InputError(f"{self.path}: not an MCAP file; {valid}")

    def _header(self, damage):
        text = self.attachments.get(HEADER)
        if text is None and damage:
            raise InputError(f"{self.path}: {self._place(damage)}, before its header was whole, so that nothing of the run can be read; "
                             "record the run anew")
        if text is None:
            raise InputError(f"{self.path}: an MCAP file, but it does not begin with a header of surefoot; "
                             "a log made by surefoot would be valid")
        try:
            header = json.loads(text)
            version = str(header["log_version"])
        except (ValueError, KeyError, TypeError) as error:
            raise InputError(f"{self.path}: its {HEADER} is not what it should be: {error}") from None
        if version.split(".")[0] != log_version().split(".")[0]:
            raise InputError(f"{self.path}: log version {version}; this program reads {log_version()}. "
                             "Read it with the version of surefoot that made it, or record the run anew")
        return header

    def _records(self):
        """The file's chunks; keeps what belongs to the file as a whole."""
        size = self.path.stat().st_size
        with open(self.path, "rb") as file:
            at = len(MAGIC)
            file.seek(at)
            while at < size and not self.complete:
                self._at = at
                head = file.read(HEAD.size)
                opcode, length = HEAD.unpack(head) if len(head) == HEAD.size else (0, size)
                if length > size - at - HEAD.size:
                    return
                at += HEAD.size + length
                record = read_record(opcode, file, length)
                if isinstance(record, Chunk):
                    yield record
                else:
                    self._keep(record)
                file.seek(at)

    def _place(self, why):
        return f"{why} at byte {self._at} of {self.path.stat().st_size}"

    def _stop(self, why):
        self.problem = f"{self.path}: {self._place(why)}; everything before it was read"

    def _keep(self, record):
        if isinstance(record, Attachment):
            self.attachments[record.name] = record.data
        elif isinstance(record, Schema):
            self.schemas[record.id] = record
        elif isinstance(record, Channel):
            self.channels[record.id] = record
        elif isinstance(record, Footer):
            self.complete = True

    def messages(self, topics=None, wanted=lambda record: True):
        """The messages, all or those of some topics, one after the other, to the last whole chunk; of wanted chunks only, where
        others are not even decompressed."""
        self.complete, self.problem = False, ""
        try:
            for record in filter(wanted, self._records()):
                yield from chunk.messages(record, self.schemas, self.channels, topics)
        except chunk.Damaged as damage:
            self._stop(str(damage))
        if not self.complete and not self.problem:
            self._stop("cut off")

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
        yield from beside.messages(topics, BehindTicks())

    def first_messages(self):
        """Of each topic its first message. Of a log that was closed only the chunks that hold one are decompressed."""
        places = self._first_chunks()
        first = {}
        for message in self.messages(wanted=lambda record: places is None or self._at in places):
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
        try:
            with open(self.path, "rb") as file:
                summary = make_reader(file).get_summary()
        except (McapError, EOFError, ValueError, OSError, struct.error):
            return None
        return summary if summary is not None and summary.chunk_indexes else None

    def schema_record(self, topic):
        """Of a topic whose messages came."""
        return next(self.schemas[channel.schema_id] for channel in self.channels.values() if channel.topic == topic)

    def schema_of(self, topic):
        """The JSON schema of a topic's messages."""
        return json.loads(self.schema_record(topic).data)

    def text(self, name):
        """An attachment. Throws InputError if the log has none of that name."""
        if name not in self.attachments:
            raise InputError(f"{self.path}: has no attachment {name}, which this needs; record the run anew")
        return self.attachments[name].decode()
