"""The records of an MCAP file: where they begin, also where something is damaged, and what they say."""

import io
import re
import struct
import zlib

from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.reader import make_reader
from mcap.records import Attachment, Channel, Chunk, DataEnd, Footer, Schema

from surefoot_log import chunk

MAGIC = b"\x89MCAP0\r\n"
HEAD = struct.Struct("<BQ")
ZSTD = b"\x04\0\0\0zstd"
BEFORE_COMPRESSION, LONGEST_NAME = 28, 16  # of a chunk's content, of its compression's name [bytes]
SOUGHT = 1 << 20  # bytes at once
DATA_END = HEAD.size + 4  # the record before the index [bytes]
FOOTER = HEAD.size + 20 + len(MAGIC)  # with what stands behind it [bytes]
LARGEST_INDEX = 1 << 28  # [bytes]
KINDS = {Opcode.ATTACHMENT: Attachment, Opcode.CHANNEL: Channel, Opcode.CHUNK: Chunk, Opcode.DATA_END: DataEnd, Opcode.FOOTER: Footer,
         Opcode.SCHEMA: Schema}


def fits(opcode, start, length):
    """Whether the sizes in a record's content, of which `start` has the first bytes, fit together."""
    try:
        if opcode == Opcode.MESSAGE_INDEX:
            return length == 6 + struct.unpack_from("<I", start, 2)[0]
        if opcode != Opcode.CHUNK:
            return True
        (name,) = struct.unpack_from("<I", start, BEFORE_COMPRESSION)
        return name <= LONGEST_NAME and length == 40 + name + struct.unpack_from("<Q", start, BEFORE_COMPRESSION + 4 + name)[0]
    except struct.error:
        return False


class Walk:
    """The records of a file outside of chunks, by their heads alone. Where a head can't be one, it goes on at the next record that the
    file's index has, of a file without one at the next chunk that it finds; a chunk is known by its sizes and its compression, also
    where its opcode is damaged."""

    def __init__(self, file, size):
        self._file, self._size, self._next = file, size, len(MAGIC)
        self._index = None  # where it was needed
        self._chunks = []  # of the index: where each begins, and its times [ns]

    def record_at(self, at):
        """Opcode and length; None where none can begin."""
        self._file.seek(at)
        start = self._file.read(HEAD.size + 40 + LONGEST_NAME)
        if len(start) < HEAD.size:
            return None
        opcode, length = HEAD.unpack_from(start)
        content = start[HEAD.size :]
        if length > self._size - at - HEAD.size:
            return None
        if content[BEFORE_COMPRESSION:].startswith(ZSTD) and fits(Opcode.CHUNK, content, length):
            return Opcode.CHUNK, length
        return (opcode, length) if opcode != 0 and fits(opcode, content, length) else None

    def record_behind(self, at):
        """Where the next record begins that can be one; None without one. What looks like a chunk within another record's data is none:
        where there is an index, it alone counts."""
        if self._index is None:
            self._index = self._read_index()
        known = (place for place in self._index if place > at and self.record_at(place))
        return next(known, None) if self._index else self.chunk_behind(at)

    def _read_index(self):
        """Where the records stand that a closed file names behind its data, in order, and that index itself."""
        summary = summary_of(self._file)
        if summary is None:
            return []
        self._file.seek(self._size - FOOTER)
        (begin,) = struct.unpack_from("<Q", self._file.read(FOOTER), HEAD.size)
        self._chunks = [(index.chunk_start_offset, index.message_start_time, index.message_end_time) for index in summary.chunk_indexes]
        places = [place for place, _, _ in self._chunks]
        places += [index.offset for index in summary.attachment_indexes + summary.metadata_indexes]
        return sorted([*places, begin - DATA_END, begin])

    def lost_times(self, begin, end):
        """Times of the first and last message of what was skipped, as the index has them [ns]; None where it has none there."""
        if begin not in (self._index or []):
            return None
        lost = [times for place, *times in self._chunks if begin <= place < end]
        return (min(first for first, _ in lost), max(last for _, last in lost)) if lost else None

    def chunk_behind(self, at):
        """Where the next compressed chunk begins; None without one."""
        to_name = HEAD.size + BEFORE_COMPRESSION
        begin = at + 1 + to_name
        while begin < self._size:
            self._file.seek(begin)
            part = self._file.read(SOUGHT + len(ZSTD))
            for found in re.finditer(re.escape(ZSTD), part):
                start = begin + found.start() - to_name
                record = self.record_at(start)
                if record is not None and record[0] == Opcode.CHUNK:
                    return start
            begin += SOUGHT
        return None

    def __iter__(self):
        """Of each record: bytes that were skipped before it, where it begins, its opcode and length. Ends where none can be found."""
        while self._next < self._size:
            at, record = self._next, self.record_at(self._next)
            if record is None:
                at = self.record_behind(at)
                if at is None:
                    return
                record = self.record_at(at)
            skipped, self._next = at - self._next, at + HEAD.size + record[1]
            yield skipped, at, *record


def has_whole_summary(file):
    """Whether its checksum is right, where it has one."""
    size = file.seek(0, io.SEEK_END)
    file.seek(max(0, size - FOOTER))
    begin, _, crc = struct.unpack_from("<QQI", file.read(FOOTER), HEAD.size)
    file.seek(begin)
    summed = size - len(MAGIC) - 4 - begin
    return crc == 0 or (0 < summed <= LARGEST_INDEX and zlib.crc32(file.read(summed)) == crc)


def summary_of(file):
    """What stands behind a file's data; None where it can't be read, is damaged or names no chunk."""
    try:
        if not has_whole_summary(file):
            return None
        file.seek(0)
        summary = make_reader(file).get_summary()
    except (McapError, EOFError, ValueError, OSError, struct.error):
        return None
    return summary if summary is not None and summary.chunk_indexes else None


def name_in(content):
    """Of an attachment, as far as it can be told: what is damaged may be its name."""
    length = int.from_bytes(content[16:20], "little")
    name = content[20 : 20 + length].decode("ascii", "replace")
    return f"the attachment {name}" if 0 < length < 80 and re.fullmatch("[!-~]+", name) else "an attachment"


def check_attachment(content):
    """By the checksum at its end, where it has one: the package does not look at that."""
    if int.from_bytes(content[-4:], "little") not in (0, zlib.crc32(content[:-4])):
        raise chunk.Damaged(f"the checksum of {name_in(content)} is wrong")


def read_record(opcode, file, length):
    """A record of those that matter here, of a message its bytes; None of the others."""
    if opcode == Opcode.MESSAGE:
        return file.read(length)
    if opcode not in KINDS:
        return None
    content = file.read(length)
    if opcode == Opcode.ATTACHMENT:
        check_attachment(content)
    try:
        return KINDS[opcode].read(ReadDataStream(io.BytesIO(content)))
    except (McapError, EOFError, ValueError, OverflowError, struct.error) as error:
        raise chunk.Damaged(str(error) or "a record is shorter than it says") from None
