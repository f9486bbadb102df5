"""How logs are read that were cut off, damaged, or written anew by others: mended by the program, and how much is read at once."""

import json
import struct

import pyarrow.parquet
import pytest
from damaged_logs import HEAD, attachment_place, bare_messages, cut, damaged_at, in_other_chunks, rewritten, tick_chunks, without_chunk
from log_file import attachment, summary_of
from log_tools import TICKS, complaint_of, exported
from mcap.writer import CompressionType
from surefoot_log import log_file
from surefoot_log.log_file import LogFile


def times(log, topic):
    return [time for time, group in log.by_time() for message in group if message.topic == topic]


def test_of_a_log_that_was_cut_off_the_beginning_is_exported_with_a_warning(log, table, tmp_path):
    result = exported(cut(log, tmp_path, 0.6), "--parquet", tmp_path / "cut.parquet", "--topics", "state")
    assert result.stderr.count("cut0.6.mcap: the log is not whole: cut off at byte") == 1
    part = pyarrow.parquet.read_table(tmp_path / "cut.parquet")
    assert 0 < part.num_rows < TICKS
    assert part.equals(table.select(part.column_names).slice(0, part.num_rows))


@pytest.mark.parametrize("number", [0, 3])
def test_of_a_damaged_log_all_but_the_damaged_chunk_is_exported(log, table, tmp_path, number):
    file, first, last = without_chunk(log, tmp_path, number)
    result = exported(file, "--parquet", tmp_path / "part.parquet", "--topics", "state", "timings")
    assert f"({first:.4f} s to {last:.4f} s); what stood there is lost, the rest was read" in result.stderr
    part = pyarrow.parquet.read_table(tmp_path / "part.parquet")
    rows = [round(time / 0.0025) for time in part["time"].to_pylist()]
    assert len(rows) == pytest.approx(TICKS - (last - first) / 0.0025, abs=2) and (rows[0] == 0) == (number != 0)
    assert part.equals(table.select(part.column_names).take(rows))


@pytest.mark.parametrize("options", [{"by_time": True}, {"by_time": False}, {"by_time": False, "use_chunking": False}, {"compression": CompressionType.NONE},
                                     {"channels_first": True, "use_chunking": False}], ids=str)  # fmt: skip
def test_a_log_that_another_writer_wrote_anew_is_exported_whole(log, table, tmp_path, options):
    file = in_other_chunks(log, tmp_path, **options)
    exported(file, "--parquet", tmp_path / "again.parquet")
    assert pyarrow.parquet.read_table(tmp_path / "again.parquet").equals(table)


def test_a_damaged_message_outside_of_chunks_costs_that_message_alone(log, tmp_path):
    file = in_other_chunks(log, tmp_path, by_time=False, use_chunking=False)
    read, whole = LogFile(damaged_at(file, tmp_path, bare_messages(file, "/plan")[100] + HEAD.size)), LogFile(log)
    plans = times(whole, "/plan")
    assert times(read, "/plan") == plans[:100] + plans[101:]
    assert all(times(read, topic) == times(whole, topic) for topic in ("/state", "/command", "/timings"))
    assert read.problem.startswith("a message's channel is unknown at byte")


def test_an_index_whose_checksum_is_wrong_is_not_followed(log, tmp_path):
    chunk = tick_chunks(log)[3]
    entry = log.read_bytes().rindex(struct.pack("<Q", chunk.chunk_start_offset) + struct.pack("<Q", chunk.chunk_length))
    file = damaged_at(log, tmp_path, entry + 1)
    assert log_file.index_of(log) is not None and log_file.index_of(file) is None
    assert times(LogFile(file), "/plan") == times(LogFile(log), "/plan")


def test_an_attachment_whose_checksum_is_wrong_is_lost_and_told(log, tmp_path):
    file = damaged_at(log, tmp_path, attachment_place(log, "robot.urdf") + 2000)
    read = LogFile(file)
    assert sum(message.topic == "/plan" for message in read.messages()) == TICKS
    assert read.attachments["summary.json"] == attachment(log, "summary.json") and "robot.urdf" not in read.attachments
    line = complaint_of("export", file, "--foxglove", tmp_path / "scene.mcap")
    assert "has no attachment robot.urdf" in line and "the checksum of the attachment robot.urdf is wrong at byte" in line


def test_little_is_read_at_once_and_only_chunks_with_messages_that_are_asked_for(log, monkeypatch):
    opened, real, file = [], log_file.messages_of, LogFile(log)
    monkeypatch.setattr(log_file, "messages_of", lambda chunk, topics: opened.append(chunk) or real(chunk, topics))
    for topics, most in (({"/state"}, 1), ({"/state", "/timings"}, 2), (None, 2)):
        opened.clear()
        time, first = next(file.by_time(topics))
        assert (time, len(opened)) == (0, most) and {message.topic for message in first} == (topics or file.topics())
    assert len(summary_of(log).chunk_indexes) > 4 * most


def test_a_header_that_lacks_something_is_told_in_the_programs_words(log, tmp_path):
    header = json.loads(attachment(log, "header.json"))
    del header["robot"]
    file = rewritten(log, tmp_path / "other.mcap", attachments={"header.json": json.dumps(header).encode()})
    assert "lacks robot, or has something else" in complaint_of("export", file, "--csv", tmp_path / "run.csv")


def test_a_message_that_is_no_json_is_told_and_leaves_nothing_behind(log, tmp_path):
    file = rewritten(log, tmp_path / "other.mcap", lambda channel, number, data: b'{"no' if (channel.topic, number) == ("/plan", 5) else data)
    assert "a message on /plan is not what it should be" in complaint_of("export", file, "--csv", tmp_path / "run.csv", "--topics", "plan")
    assert [path.name for path in tmp_path.iterdir()] == ["other.mcap"]


def test_a_program_that_is_not_there_is_told(log, tmp_path, monkeypatch):
    monkeypatch.setenv("SUREFOOT_PROGRAM", str(tmp_path / "none"))
    assert f"the program {tmp_path}/none, which logs are read with, can't be started" in complaint_of("export", log, "--csv", tmp_path / "run.csv")
