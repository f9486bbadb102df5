"""A log, read from front to back as far as it goes."""

import io
import json
import pathlib
import struct

from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Footer, Schema

from surefoot_campaign.errors import InputError
from surefoot_log import chunk

LOG_VERSION = "2"  # the first number, which says whether a reader must change (docs/log.md)
MAGIC = b"\x89MCAP0\r\n"
HEADER, SUMMARY = "header.json", "summary.json"
HEAD = struct.Struct("<BQ")
KINDS = {Opcode.ATTACHMENT: Attachment, Opcode.CHANNEL: Channel, Opcode.CHUNK: Chunk, Opcode.FOOTER: Footer, Opcode.SCHEMA: Schema}


def read_record(opcode, file, length):
    """A record of those that matter here; None of the others."""
    if opcode not in KINDS:
        return None
    stream = ReadDataStream(io.BytesIO(file.read(length)))
    try:
        return KINDS[opcode].read(stream)
    except (McapError, EOFError, ValueError) as error:
        raise chunk.Damaged(str(error) or "a record is shorter than it says") from None


class LogFile:
    """What stands in front of the messages is known at once; the rest after `messages` came to its end."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.attachments, self.channels, self.schemas = {}, {}, {}
        self.problem, self._at = "", 0  # why it could not be read to its end, and where
        self.complete = False
        self._check_magic()
        try:
            next(self._records(), None)
        except chunk.Damaged:
            pass  # `messages` comes to the same place, and says so
        self.header = self._header()

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

    def _header(self):
        text = self.attachments.get(HEADER)
        if text is None:
            raise InputError(f"{self.path}: an MCAP file, but it does not begin with a header of surefoot")
        try:
            header = json.loads(text)
            version = str(header["log_version"])
        except (ValueError, KeyError, TypeError) as error:
            raise InputError(f"{self.path}: its {HEADER} is not what it should be: {error}") from None
        if version.split(".")[0] != LOG_VERSION:
            raise InputError(f"{self.path}: log version {version}; this program reads {LOG_VERSION}.x. "
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

    def _stop(self, why):
        size = self.path.stat().st_size
        self.problem = f"{self.path}: {why} at byte {self._at} of {size}; everything before it was read"

    def _keep(self, record):
        if isinstance(record, Attachment):
            self.attachments[record.name] = record.data
        elif isinstance(record, Schema):
            self.schemas[record.id] = record
        elif isinstance(record, Channel):
            self.channels[record.id] = record
        elif isinstance(record, Footer):
            self.complete = True

    def messages(self, topics=None):
        """The messages, all or those of some topics, one after the other, to the last whole chunk."""
        self.complete, self.problem = False, ""
        try:
            for record in self._records():
                yield from chunk.messages(record, self.schemas, self.channels, topics)
        except chunk.Damaged as damage:
            self._stop(str(damage))
        if not self.complete and not self.problem:
            self._stop("cut off")

    def schema_of(self, topic):
        """The JSON schema of a topic's messages; None before its first message came."""
        for channel in self.channels.values():
            if channel.topic == topic:
                return json.loads(self.schemas[channel.schema_id].data)
        return None

    def text(self, name):
        """An attachment. Throws InputError if the log has none of that name."""
        if name not in self.attachments:
            raise InputError(f"{self.path}: has no attachment {name}, which this needs; record the run anew")
        return self.attachments[name].decode()
