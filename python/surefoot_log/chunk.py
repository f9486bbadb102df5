"""The messages of an MCAP chunk, fast: https://mcap.dev/spec."""

import io
import struct
import zlib
from typing import NamedTuple

import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Channel, Schema

HEAD = struct.Struct("<BQ")
MESSAGE = struct.Struct("<HIQQ")
LARGEST = 1 << 30  # bytes of a chunk
MOST_SHRUNK = 1 << 15  # by zstd, some 20 000 times: a run of zeros


class Damaged(Exception):
    """A chunk is not what its record says."""


class Message(NamedTuple):
    topic: str
    time: int  # ns
    data: memoryview


def decompressed(data, size):
    """There is room for what its record says, whatever the compressed bytes say."""
    if size // MOST_SHRUNK > len(data):
        raise Damaged("a chunk claims to be too large")
    try:
        if zstandard.frame_content_size(data) not in (-1, size):
            raise Damaged("a chunk can't be decompressed")
        return zstandard.ZstdDecompressor().decompress(data, size)
    except zstandard.ZstdError:
        raise Damaged("a chunk can't be decompressed") from None


def opened(chunk):
    if chunk.uncompressed_size > LARGEST:
        raise Damaged("a chunk claims to be larger than 1 GiB")
    if chunk.compression not in ("", "zstd"):
        raise Damaged("a chunk is not compressed with zstd")
    data = chunk.data if chunk.compression == "" else decompressed(chunk.data, chunk.uncompressed_size)
    if chunk.uncompressed_crc not in (0, zlib.crc32(data)):
        raise Damaged("the checksum of a chunk is wrong")
    return data


def message(content, channels, topics=None):
    """Gives the message that a record's content is, if it is of those topics."""
    if len(content) < MESSAGE.size:
        raise Damaged("a record is shorter than it says")
    channel, _, time, _ = MESSAGE.unpack_from(content)
    if channel not in channels:
        raise Damaged("a message's channel is unknown")
    if topics is None or channels[channel].topic in topics:
        yield Message(channels[channel].topic, time, content[MESSAGE.size :])


def record(kind, content):
    try:
        return kind.read(ReadDataStream(io.BytesIO(content)))
    except (McapError, struct.error, UnicodeDecodeError):
        raise Damaged(f"a {kind.__name__.lower()} can't be read") from None


def messages(chunk, schemas, channels, topics=None):
    """Gives the messages one by one, of some topics only if they are named; keeps the chunk's schemas and channels, by their ids."""
    data = memoryview(opened(chunk))
    at = 0
    while at < len(data):
        try:
            opcode, length = HEAD.unpack_from(data, at)
        except struct.error:
            raise Damaged("a record is shorter than it says") from None
        at += HEAD.size
        content = data[at : at + length]
        if len(content) < length:
            raise Damaged("a record is shorter than it says")
        at += length
        if opcode == Opcode.MESSAGE:
            yield from message(content, channels, topics)
        elif opcode == Opcode.SCHEMA:
            schema = record(Schema, content)
            schemas[schema.id] = schema
        elif opcode == Opcode.CHANNEL:
            channel = record(Channel, content)
            channels[channel.id] = channel
