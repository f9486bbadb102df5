"""A log, read by the package mcap. The program says what is in it, and mends one that is cut off or damaged before it is read."""

import heapq
import json
import os
import pathlib
import re
import struct
import subprocess
import tempfile
import zlib
from dataclasses import replace
from functools import cached_property
from itertools import groupby
from operator import attrgetter
from typing import NamedTuple

import zstandard
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.reader import make_reader
from mcap.records import Chunk

from surefoot_campaign.errors import InputError

APART = {"/timings"}  # topics behind all ticks (docs/log.md)
SUMMARY = "summary.json"
HEAD, MESSAGE = struct.Struct("<BQ"), struct.Struct("<HIQQ")
FOOTER, MAGIC = struct.Struct("<BQQQI"), 8  # bytes at the end of a closed file
LARGEST_INDEX = 1 << 28  # bytes
ONE_WORLD = "2."  # logs of these versions call the simulator's world W, too
OLD_NAME, OLD_FRAME = re.compile(rb'"([pqvw])_W(B_B|B|Com|F)"'), re.compile(rb"\b(in|to) W\b")
WHEEL = str(pathlib.Path(__file__).parents[1] / "surefoot/bin/surefoot")  # the program, where a wheel has it


class Message(NamedTuple):
    topic: str
    time: int  # ns
    data: memoryview


def program(*words):
    """What the program prints, and its notes. Throws InputError with its complaint."""
    command = [os.environ.get("SUREFOOT_PROGRAM") or (WHEEL if os.path.exists(WHEEL) else "surefoot"), *map(str, words)]
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    except OSError as error:
        raise InputError(f"the program {command[0]}, which logs are read with, can't be started: {error.strerror}; bin/surefoot names it") from None
    said = [line.removeprefix("surefoot: ") for line in done.stderr.splitlines()]
    if done.returncode:
        raise InputError(said[-1] if said else f"the program {command[0]} ended with {done.returncode}")
    return done.stdout, said


def event_text(event):
    """What happened, with the leg that it happened to."""
    return f"{event['leg']}: {event['text']}" if event["leg"] else event["text"]


def stop_reason(event):
    """Why the controller stopped for safety: "encoders stopped" of "command mode: sit, as encoders stopped". Empty for other events."""
    return event["text"].partition(", as ")[2] if event["by"] == "controller" else ""


def index_of(path):
    """The index behind the data of a closed file; None if its checksum is wrong, or it does not say which topics are in which chunk."""
    with open(path, "rb") as file:
        end = file.seek(-MAGIC - FOOTER.size, os.SEEK_END)
        _, _, begin, _, crc = FOOTER.unpack(file.read(FOOTER.size))
        file.seek(max(begin, end - LARGEST_INDEX) if begin < end else end)
        if zlib.crc32(file.read()[: -MAGIC - 4]) != crc:
            return None
        file.seek(0)
        summary = make_reader(file).get_summary()
    return summary if summary.chunk_indexes and all(chunk.message_index_offsets for chunk in summary.chunk_indexes) else None


def messages_of(chunk, topics):
    """The messages of an MCAP chunk on these channels. The package takes 3 times as long."""
    data = memoryview(zstandard.decompress(chunk.data, chunk.uncompressed_size) if chunk.compression else chunk.data)
    at = 0
    while at < len(data):
        opcode, length = HEAD.unpack_from(data, at)
        at += HEAD.size
        if opcode == Opcode.MESSAGE:
            channel, _, time, _ = MESSAGE.unpack_from(data, at)
            if channel in topics:
                yield Message(topics[channel], time, data[at + MESSAGE.size : at + length])
        at += length


def of_worlds(data):
    """A message on /truth, or its schema, of an old log with the names of today."""
    return OLD_FRAME.sub(rb"\1 S", OLD_NAME.sub(rb'"\1_S\2"', bytes(data)))


class LogFile:
    """Reads a log. Throws InputError if the file is none."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        contents, self.notes = program("info", path, "--json")
        self.problem = json.loads(contents).get("problem", "")  # what is lost; empty if nothing is
        self._whole = self.path
        self._index = None if self.problem else index_of(path)
        if self._index is None:
            self._folder = tempfile.TemporaryDirectory(prefix="surefoot_")
            self._whole = pathlib.Path(self._folder.name) / "mended.mcap"
            program("mend", path, "--out", self._whole)
        with open(self._whole, "rb") as file:
            reader = make_reader(file)
            self._index = self._index or reader.get_summary()
            self.attachments = {one.name: one.data for one in reader.iter_attachments()}
        self.header = json.loads(self.attachments["header.json"])
        self._has_one_world = self.header["log_version"].startswith(ONE_WORLD)
        if self._has_one_world:
            self.header["terrain"] = [{"q_SG" if name == "q_WT" else name: value for name, value in piece.items()} for piece in self.header.get("terrain") or []]
        self._chunks = sorted(self._index.chunk_indexes, key=attrgetter("chunk_start_offset"))
        self._channels = {channel.topic: channel for channel in self._index.channels.values()}

    @cached_property
    def events(self):
        """What happened in the run, as `surefoot explain` has it: of each `time`, `text`, the `leg` that it happened to, and `by` whom."""
        return json.loads(program("info", self.path, "--json", "--events")[0])["events"]

    def topics(self):
        return self._channels.keys()

    def num_messages(self, topic):
        return self._index.statistics.channel_message_counts.get(self._channels[topic].id, 0)

    def messages(self, topics=None):
        """All messages, or those on some topics, in the order of the file."""
        wanted = {channel.id: topic for topic, channel in self._channels.items() if topics is None or topic in topics}
        with open(self._whole, "rb") as file:
            for chunk in self._chunks:
                if wanted.keys() & chunk.message_index_offsets.keys():
                    file.seek(chunk.chunk_start_offset + HEAD.size)
                    found = messages_of(Chunk.read(ReadDataStream(file)), wanted)
                    yield from map(self._renamed, found) if self._has_one_world else found

    @staticmethod
    def _renamed(message):
        return message._replace(data=memoryview(of_worlds(message.data))) if message.topic == "/truth" else message

    def by_time(self, topics=None):
        """The same, time by time: each time [ns] with its messages. Topics that stand behind all ticks are read in parallel, so that nothing waits
        in memory."""
        wanted = self.topics() if topics is None else topics
        merged = heapq.merge(self.messages(wanted - APART), self.messages(wanted & APART), key=attrgetter("time"))
        for time, group in groupby(merged, key=attrgetter("time")):
            yield time, list(group)

    def schema_record(self, topic):
        record = self._index.schemas[self._channels[topic].schema_id]
        return replace(record, data=of_worlds(record.data)) if self._has_one_world and topic == "/truth" else record

    def schema_of(self, topic):
        """The JSON schema of a topic's messages."""
        return json.loads(self.schema_record(topic).data)

    def text(self, name):
        """An attachment. Throws InputError if the log has none of that name."""
        if name not in self.attachments:
            valid = "one that is recorded with a plant" if name == "model.xml" else "one that is recorded anew"
            raise self._error(f"the log has no attachment {name}, which this needs; {valid} would be valid")
        return self.attachments[name].decode()

    def no_tick(self, purpose):
        """The error of a log without ticks."""
        return self._error(f"the log holds no tick, so there is nothing to {purpose}")

    def _error(self, text):
        return InputError(f"{self.path}: {text}{'; ' + self.problem if self.problem else ''}")

    def decoded(self, topic, data):
        """What a message says. Throws InputError where it says nothing."""
        try:
            return json.loads(bytes(data))
        except (ValueError, RecursionError) as error:
            raise InputError(f"{self.path}: a message on {topic} is not what it should be: {error}") from None
