"""How `surefoot export` reads logs that were cut off, damaged, or written anew by others, and how much it reads at once."""

import json
import struct
from types import SimpleNamespace

import pyarrow.parquet
import pytest
import zstandard
from damaged_logs import HEAD, attachment_place, bare_messages, cut, damaged_at, in_other_chunks, rewritten, tick_chunks, without_chunk
from log_file import attachment
from log_tools import TICKS, complaint_of, exported
from mcap.opcode import Opcode
from mcap.reader import make_reader
from mcap.records import Chunk
from surefoot_campaign.errors import InputError
from surefoot_log import chunk
from surefoot_log.log_file import LogFile
from surefoot_log.table import Table


@pytest.mark.parametrize("share", [0.3, 0.6, 0.9])
def test_of_a_log_that_was_cut_off_the_beginning_is_exported_with_a_warning(log, table, tmp_path, share):
    result = exported(cut(log, tmp_path, share), "--parquet", tmp_path / "cut.parquet", "--topics", "state")
    assert result.stderr.count(f"cut{share}.mcap: the log is not whole: cut off at byte") == 1
    part = pyarrow.parquet.read_table(tmp_path / "cut.parquet")
    assert 0 < part.num_rows < TICKS
    assert part.equals(table.select(part.column_names).slice(0, part.num_rows))


@pytest.fixture
def opened(monkeypatch):
    """The chunks that were decompressed so far, by the time at which they begin."""
    starts, real = [], chunk.opened
    monkeypatch.setattr(chunk, "opened", lambda record: starts.append(record.message_start_time) or real(record))
    return starts


def test_an_export_begins_without_reading_the_whole_log(log, opened):
    file = LogFile(log)
    everything = list(file.by_time())
    chunks = len(opened)
    for topics, most in (({"/state"}, 1), ({"/state", "/timings"}, 2), (None, 2)):
        opened.clear()
        time, first = next(file.by_time(topics))
        assert (time, len(opened)) == (0, most)
        assert {message.topic for message in first} == (topics or {message.topic for message in everything[0][1]})
    opened.clear()
    assert {topic: message.time for topic, message in file.first_messages().items()} == dict.fromkeys(file.topics(), 0)
    assert len(opened) == 2 < chunks


def test_an_unknown_topic_is_told_before_anything_is_read(log, opened):
    with pytest.raises(InputError, match='unknown topic "/plann"'):
        Table(LogFile(log), {"/plann"})
    assert opened == []


@pytest.mark.parametrize("number", [0, 3])
def test_of_a_damaged_log_all_but_the_damaged_chunk_is_exported(log, table, tmp_path, number):
    file, first, last = without_chunk(log, tmp_path, number)
    result = exported(file, "--parquet", tmp_path / "part.parquet", "--topics", "state", "timings")
    assert f"({first:.4f} s to {last:.4f} s); what stood there is lost, the rest was read" in result.stderr
    part = pyarrow.parquet.read_table(tmp_path / "part.parquet")
    times = part["time"].to_pylist()
    assert all(time < first + 0.003 or time > last - 0.003 for time in times) and (times[0] == 0) == (number != 0)
    rows = [round(time / 0.0025) for time in times]
    assert len(rows) == pytest.approx(TICKS - (last - first) / 0.0025, abs=2)
    assert part.equals(table.select(part.column_names).take(rows))


@pytest.mark.parametrize("byte", [0, 1, 2, 5])
def test_of_a_log_whose_chunk_has_a_damaged_head_the_rest_is_exported(log, table, tmp_path, byte):
    chunk = tick_chunks(log)[3]
    file = damaged_at(log, tmp_path, chunk.chunk_start_offset + byte)
    result = exported(file, "--parquet", tmp_path / "part.parquet", "--topics", "plan")
    assert ("a record's head is damaged" in result.stderr) == (byte != 0)
    if byte != 0:
        first, last = 1e-9 * chunk.message_start_time, 1e-9 * chunk.message_end_time
        assert f"({first:.4f} s to {last:.4f} s); what stood there is lost" in result.stderr
    part = pyarrow.parquet.read_table(tmp_path / "part.parquet")
    assert part.num_rows > TICKS - 100 and part["time"][-1].as_py() == table["time"][-1].as_py()


@pytest.mark.parametrize("options", [{"by_time": True}, {"by_time": False}, {"use_chunking": False}, {"by_time": False, "use_chunking": False},
                                     {"channels_first": True, "use_chunking": False}], ids=str)
def test_a_log_that_another_writer_wrote_anew_is_exported_whole(log, table, tmp_path, options):
    file = in_other_chunks(log, tmp_path, **options)
    exported(file, "--parquet", tmp_path / "again.parquet")
    assert pyarrow.parquet.read_table(tmp_path / "again.parquet").equals(table)


def times(log, topic):
    return [time for time, group in log.by_time() for message in group if message.topic == topic]


@pytest.mark.parametrize("channels_first", [False, True])
def test_a_log_without_chunks_has_its_timings_beside_its_ticks(log, tmp_path, channels_first):
    read = LogFile(in_other_chunks(log, tmp_path, channels_first=channels_first, use_chunking=False))
    assert times(read, "/timings") == times(LogFile(log), "/timings")


def test_a_damaged_message_outside_of_chunks_costs_that_message_alone(log, tmp_path):
    file = in_other_chunks(log, tmp_path, by_time=False, use_chunking=False)
    place = bare_messages(file, "/plan")[100]
    read, whole = LogFile(damaged_at(file, tmp_path, place + HEAD.size)), LogFile(log)
    plans = times(whole, "/plan")
    assert times(read, "/plan") == plans[:100] + plans[101:]
    for topic in ("/state", "/command", "/timings"):
        assert times(read, topic) == times(whole, topic)
    assert read.problem.startswith(f"a message's channel is unknown at byte {place} of ") and read.problem.count("at byte") == 1


def test_a_message_outside_of_chunks_that_is_too_short_costs_nothing_else(log, tmp_path):
    file = in_other_chunks(log, tmp_path, by_time=False, use_chunking=False)
    place, data = bare_messages(file, "/plan")[100], file.read_bytes()
    file.write_bytes(data[:place] + HEAD.pack(Opcode.MESSAGE, 12) + bytes(12) + data[place:])
    read = LogFile(file)
    assert times(read, "/plan") == times(LogFile(log), "/plan")
    assert f"a record is shorter than it says at byte {place} of " in read.problem


def test_what_stands_behind_a_last_chunk_with_a_damaged_head_is_read(log, tmp_path):
    with open(log, "rb") as file:
        last = max(chunk.chunk_start_offset for chunk in make_reader(file).get_summary().chunk_indexes)
    read = LogFile(damaged_at(log, tmp_path, last + 3))
    assert sum(message.topic == "/plan" for message in read.messages()) == TICKS
    assert read.attachments["summary.json"] == attachment(log, "summary.json")
    assert read.problem.startswith(f"a record's head is damaged at byte {last} of ") and "cut off" not in read.problem


def test_an_index_whose_checksum_is_wrong_is_not_followed(log, tmp_path):
    chunk = tick_chunks(log)[3]
    entry = log.read_bytes().rindex(struct.pack("<Q", chunk.chunk_start_offset) + struct.pack("<Q", chunk.chunk_length))
    read = LogFile(damaged_at(log, tmp_path, entry + 1))
    assert LogFile(log).topics() is not None and read.topics() is None
    first = {topic: message.time for topic, message in read.first_messages().items()}
    assert first == {topic: message.time for topic, message in LogFile(log).first_messages().items()}


def data_length_place(log, name):
    """Where the highest byte of the length of an attachment's data is."""
    data, place = log.read_bytes(), attachment_place(log, name) + HEAD.size + 16
    for _ in ("name", "media type"):
        place += 4 + struct.unpack_from("<I", data, place)[0]
    return place + 7


@pytest.mark.parametrize("where", [lambda log: attachment_place(log, "robot.urdf") + 2000, lambda log: data_length_place(log, "robot.urdf")])
def test_an_attachment_whose_checksum_is_wrong_is_lost_and_told(log, tmp_path, where):
    file = damaged_at(log, tmp_path, where(log))
    read = LogFile(file)
    assert sum(message.topic == "/plan" for message in read.messages()) == TICKS
    told = f"the checksum of the attachment robot.urdf is wrong at byte {attachment_place(log, 'robot.urdf')} of "
    assert read.problem.startswith(told) and not read.complete
    line = complaint_of("export", file, "--foxglove", tmp_path / "scene.mcap")
    assert "has no attachment robot.urdf" in line and told in line


def test_a_header_that_lacks_something_is_told(log, tmp_path):
    header = json.loads(attachment(log, "header.json"))
    for name in ("robot", "level_names", "control_period"):
        other = {key: value for key, value in header.items() if key != name}
        file = rewritten(log, tmp_path / "other.mcap", attachments={"header.json": json.dumps(other).encode()})
        assert f"lacks {name}, or has something else" in complaint_of("export", file, "--csv", tmp_path / "run.csv")
    deep = b'{"log_version":"2.9","options":' + 100000 * b"[" + 100000 * b"]" + b"}"
    file = rewritten(log, tmp_path / "deep.mcap", attachments={"header.json": deep})
    assert "is damaged" in complaint_of("export", file, "--csv", tmp_path / "run.csv")


def test_a_message_that_is_no_json_is_told_and_leaves_nothing_behind(log, tmp_path):
    file = rewritten(log, tmp_path / "other.mcap", lambda channel, number, data: b'{"no' if (channel.topic, number) == ("/plan", 5) else data)
    assert "a message on /plan is not what it should be" in complaint_of("export", file, "--csv", tmp_path / "run.csv", "--topics", "plan")
    assert [path.name for path in tmp_path.iterdir()] == ["other.mcap"]


@pytest.mark.parametrize("size", [100, 1 << 30])
def test_a_chunk_gets_no_more_room_than_its_record_says_and_that_can_be(size):
    data = zstandard.ZstdCompressor().compress(bytes(1 << 24))
    with pytest.raises(chunk.Damaged):
        chunk.opened(Chunk(compression="zstd", data=data, message_end_time=0, message_start_time=0, uncompressed_crc=0, uncompressed_size=size))


@pytest.mark.parametrize("opcode", [Opcode.SCHEMA, Opcode.CHANNEL])
@pytest.mark.parametrize("content", [b"", b"\x01", b"\x01\x00\xff\xff\xff\x7fx", b"\x01\x00\x01\x02\x01\x00\x00\x00\xff" + bytes(20)])
def test_a_record_in_a_chunk_that_can_not_be_read_is_damage(opcode, content):
    data = chunk.HEAD.pack(opcode, len(content)) + content
    damaged = SimpleNamespace(uncompressed_size=len(data), compression="", uncompressed_crc=0, data=data)
    with pytest.raises(chunk.Damaged, match="can't be read"):
        list(chunk.messages(damaged, {}, {}))
