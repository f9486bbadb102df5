"""Files that are not what they should be, made from a log that is."""

import json

from mcap.reader import make_reader
from mcap.writer import Writer

from log_file import attachment


def written(path, attachments):
    with open(path, "wb") as file:
        writer = Writer(file)
        writer.start()
        for name, data in attachments.items():
            writer.add_attachment(0, 0, name, "application/json", data)
        writer.finish()
    return path


def foreign(folder):
    """MCAP, but nothing of ours."""
    return written(folder / "foreign.mcap", {"notes.json": b"{}"})


def newer(log, folder):
    header = json.loads(attachment(log, "header.json"))
    return written(folder / "newer.mcap", {"header.json": json.dumps(header | {"log_version": "3.0"}).encode()})


def without_ticks(log, folder):
    return written(folder / "empty.mcap", {"header.json": attachment(log, "header.json")})


def cut(log, folder, share):
    data = log.read_bytes()
    path = folder / f"cut{share}.mcap"
    path.write_bytes(data[: int(share * len(data))])
    return path


def damaged(log, folder, share):
    """One byte in its middle is another."""
    data = bytearray(log.read_bytes())
    data[int(share * len(data))] ^= 0xFF
    path = folder / f"damaged{share}.mcap"
    path.write_bytes(data)
    return path


def plain_text(folder):
    path = folder / "text.mcap"
    path.write_text("this is no log\n")
    return path


def changed(log, folder, topic, tick, change):
    """The same log, but for one message: `change` gets it decoded."""
    path = folder / "changed.mcap"
    with open(log, "rb") as source, open(path, "wb") as target:
        writer = Writer(target)
        writer.start()
        reader, channels, seen = make_reader(source), {}, 0
        for item in reader.iter_attachments():
            writer.add_attachment(0, 0, item.name, item.media_type, item.data)
        # In the order of the file, which is that of the ticks.
        for schema, channel, message in reader.iter_messages(log_time_order=False):
            if channel.id not in channels:
                schema_id = writer.register_schema(schema.name, schema.encoding, schema.data)
                channels[channel.id] = writer.register_channel(channel.topic, channel.message_encoding, schema_id)
            data = message.data
            if channel.topic == topic:
                if seen == tick:
                    content = json.loads(data)
                    change(content)
                    data = json.dumps(content).encode()
                seen += 1
            writer.add_message(channels[channel.id], message.log_time, data, message.publish_time)
        writer.finish()
    return path
