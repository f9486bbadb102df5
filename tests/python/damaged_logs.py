"""Files that are not what they should be, made from a log that is."""

import io
import json
import re
import struct
from operator import attrgetter

from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.reader import make_reader
from mcap.records import Channel, Chunk
from mcap.writer import Writer

from log_file import attachment, summary_of
from surefoot_log.log_file import messages_of

MAGIC = b"\x89MCAP0\r\n"
HEAD = struct.Struct("<BQ")


def written(path, attachments):
    with open(path, "wb") as file:
        writer = Writer(file)
        writer.start()
        for name, data in attachments.items():
            writer.add_attachment(0, 0, name, "application/json", data)
        writer.finish()
    return path


def in_other_chunks(log, folder, by_time=True, **options):
    """The same messages in the chunks of another writer."""
    return rewritten(log, folder / "in_other_chunks.mcap", by_time=by_time, **options)


def foreign(folder):
    """MCAP, but nothing of ours."""
    return written(folder / "foreign.mcap", {"notes.json": b"{}"})


def newer(log, folder):
    header = json.loads(attachment(log, "header.json"))
    return written(folder / "newer.mcap", {"header.json": json.dumps(header | {"log_version": "4.0"}).encode()})


def without_ticks(log, folder):
    return written(folder / "empty.mcap", {"header.json": attachment(log, "header.json")})


def cut(log, folder, share):
    data = log.read_bytes()
    path = folder / f"cut{share}.mcap"
    path.write_bytes(data[: int(share * len(data))])
    return path


def cut_at(log, folder, length):
    path = folder / f"cut_at{length}.mcap"
    path.write_bytes(log.read_bytes()[:length])
    return path


def attachment_place(log, name):
    """Where the record of an attachment begins."""
    return next(index.offset for index in summary_of(log).attachment_indexes if index.name == name)


def damaged(log, folder, share):
    """One byte is another, at that share of its length."""
    return damaged_at(log, folder, int(share * log.stat().st_size), f"damaged{share}")


def tick_chunks(log):
    """The chunks that hold ticks, in their order: those before the time goes back."""
    chunks = sorted(summary_of(log).chunk_indexes, key=attrgetter("chunk_start_offset"))
    return [chunk for i, chunk in enumerate(chunks) if all(chunk.message_start_time >= other.message_start_time for other in chunks[:i])]


def first_topic(log, chunk):
    """Of a chunk's messages, which may begin within a tick."""
    channels = {channel.id: channel.topic for channel in summary_of(log).channels.values()}
    with open(log, "rb") as file:
        file.seek(chunk.chunk_start_offset + HEAD.size)
        return next(messages_of(Chunk.read(ReadDataStream(file)), channels)).topic


def timings_chunk(log):
    """A place in the first chunk of timings, which stand behind all ticks."""
    last = tick_chunks(log)[-1].chunk_start_offset
    behind = [chunk for chunk in summary_of(log).chunk_indexes if chunk.chunk_start_offset > last]
    chunk = min(behind, key=attrgetter("chunk_start_offset"))
    return chunk.chunk_start_offset + chunk.chunk_length // 2


def bare_messages(log, topic):
    """Of the messages on a topic that stand outside of chunks: where each record begins."""
    places = []
    with open(log, "rb") as file:
        file.seek(len(MAGIC))
        channel = None
        while len(head := file.read(HEAD.size)) == HEAD.size:
            opcode, length = HEAD.unpack(head)
            place, content = file.tell() - HEAD.size, file.read(length)
            if opcode == Opcode.CHANNEL and (made := Channel.read(ReadDataStream(io.BytesIO(content)))).topic == topic:
                channel = made.id
            if opcode == Opcode.MESSAGE and struct.unpack_from("<H", content)[0] == channel:
                places.append(place)
    return places


def damaged_at(log, folder, place, name="damaged"):
    """The byte at that place of the file is another."""
    data = bytearray(log.read_bytes())
    data[place] ^= 0xFF
    path = folder / f"{name}.mcap"
    path.write_bytes(data)
    return path


def without_chunk(log, folder, number):
    """A byte in the middle of a chunk of ticks is another, so that all of it is lost. Gives the log, and the times of what is lost."""
    chunk = tick_chunks(log)[number]
    path = damaged_at(log, folder, chunk.chunk_start_offset + chunk.chunk_length // 2, f"without{number}")
    return path, 1e-9 * chunk.message_start_time, 1e-9 * chunk.message_end_time


def without_calls(log, folder, first, skipped):
    """A log whole as a file, as of a controller that was called from tick `first` on, and at one more tick not at all."""

    def called(channel, number, data):
        return None if number < first or number == skipped else data

    return rewritten(log, folder / "skips.mcap", called)


def plain_text(folder):
    path = folder / "text.mcap"
    path.write_text("this is no log\n")
    return path


def changed(log, folder, topic, tick, change):
    """The same log, but for one message: `change` gets it decoded."""

    def changed_data(channel, number, data):
        if (channel.topic, number) != (topic, tick):
            return data
        content = json.loads(data)
        change(content)
        return json.dumps(content).encode()

    return rewritten(log, folder / "changed.mcap", changed_data)


def of_version(log, folder, version, lacks=()):
    """The same log as another version has it: without those members of each topic's messages. Before 3.0 the simulator's world was called W."""

    def of_one_world(text):
        return re.sub(r'"([pqvw])_S(\w+)"', r'"\1_W\2"', text).replace('"q_WG"', '"q_WT"') if version < "3" else text

    def data_of(channel, _, data):
        if channel.topic in lacks:
            data = json.dumps({name: value for name, value in json.loads(data).items() if name not in lacks[channel.topic]}).encode()
        return of_one_world(data.decode()).encode() if channel.topic == "/truth" else data

    header = json.loads(of_one_world(attachment(log, "header.json").decode())) | {"log_version": version}
    return rewritten(log, folder / f"version_{version}.mcap", data_of, attachments={"header.json": json.dumps(header).encode()}, schema_of=of_one_world)


def steered(log, folder, changes):
    """The same log with messages on /changes; members that they don't give are unknown."""
    unknown = {"stack": "", "duration": None, "friction": None, "body": "", "point": [None] * 3, "force": [None] * 3}
    return rewritten(log, folder / "steered.mcap", changes=[unknown | change for change in changes])


def rewritten(log, path, data_of=lambda channel, number, data: data, changes=(), attachments=None, by_time=False, channels_first=False, schema_of=str, **options):
    """The same messages, in the order of the file or of their times, with other data (None: without this one); a change before the tick of its
    time. `attachments`: data of those that are others. `channels_first`: all before the first message. `schema_of`: a schema's text from the old one. `options`:
    of the writer."""
    with open(log, "rb") as source, open(path, "wb") as target:
        reader, writer = make_reader(source), Writer(target, **options)
        writer.start()
        summary, channels, seen, waiting = reader.get_summary(), {}, {}, list(changes)
        for one in reader.iter_attachments():
            writer.add_attachment(one.create_time, one.log_time, one.name, one.media_type, (attachments or {}).get(one.name, one.data))
        for one in reader.iter_metadata():
            writer.add_metadata(one.name, one.metadata)

        def channel_of(schema, channel):
            if channel.id not in channels:
                schema_id = writer.register_schema(schema.name, schema.encoding, schema_of(schema.data.decode()).encode())
                channels[channel.id] = writer.register_channel(channel.topic, channel.message_encoding, schema_id, channel.metadata)
            return channels[channel.id]

        for channel in summary.channels.values() if channels_first else ():
            channel_of(summary.schemas[channel.schema_id], channel)
        own = writer.register_channel("/changes", "json", writer.register_schema("surefoot.Change", "jsonschema", b"{}")) if changes else None
        for schema, channel, message in reader.iter_messages(log_time_order=by_time):
            place = channel_of(schema, channel)
            while waiting and channel.topic == "/readings" and 1e-9 * message.log_time > waiting[0]["time"] - 1e-6:
                change = waiting.pop(0)
                writer.add_message(own, message.log_time, json.dumps(change).encode(), message.publish_time)
            number = seen[channel.topic] = seen.get(channel.topic, -1) + 1
            data = data_of(channel, number, message.data)
            if data is not None:
                writer.add_message(place, message.log_time, data, message.publish_time, message.sequence)
        writer.finish()
    return path
