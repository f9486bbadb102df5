"""A log, as a page without a browser gets it: what stands in it, and what of a damaged one is left."""

import json
import math
import re
import struct
import time

import pytest
from mcap.writer import CompressionType

from conftest import record
from damaged_logs import changed, cut, damaged, in_other_chunks, tick_chunks, without_chunk
from live_page import Frames, Refused, Served
from log_file import messages
from program import answer


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    return record(tmp_path_factory.mktemp("log") / "run.mcap", "--set", "planner.calibration.duration=0", scenario="walk_flat", duration=6)


@pytest.fixture(scope="module")
def replay(log):
    with Served("replay", log) as served:
        served.summarised()
        yield served


def f32(number):
    return math.nan if number is None else struct.unpack("<f", struct.pack("<f", number))[0]


def described(session):
    """The channels, but for those of the levels: the two have other stacks."""
    return [
        {key: value for key, value in channel.items() if key != "offset"}
        for channel in session["channels"]
        if not channel["name"].startswith(("hierarchy.level.", "timings.level.", "told.level."))
    ]


def test_a_log_is_described_as_a_live_run_is(replay, run):
    session = replay.session()
    assert session["mode"] == "replay" and session["source"] == "run.mcap"
    assert session["ticks"] == session["summarised"] == 2400
    live = run.session()
    assert described(session) == described(live)
    assert session["rows"][:4] == live["rows"][:4]  # the levels that keep the physics
    with pytest.raises(Refused, match="404"):
        replay.page()


def test_the_frames_of_a_log_are_those_that_stand_in_it(replay, log):
    asked = [(0, 400, 1), (750, 300, 1), (2399, 1, 1), (10, 90, 7), (2390, 50, 1), (2400, 5, 1)]
    state, command, timing = (messages(log, topic) for topic in ("/state", "/command", "/timings"))
    for begin, count, stride in asked:
        frames = replay.frames(f"from={begin}&count={count}&stride={stride}")
        wanted = [tick for tick in range(begin, begin + count * stride, stride) if tick < 2400]
        assert frames.ticks == wanted
        assert frames.of("state.p_WB") == [tuple(map(f32, state[tick]["p_WB"])) for tick in wanted]
        assert frames.of("command.torque") == [tuple(map(f32, command[tick]["torque"])) for tick in wanted]
        assert frames.of("timings.total") == [f32(timing[tick]["total"]) for tick in wanted]


@pytest.mark.parametrize("stride", [16, 64, 256])
def test_least_and_greatest_of_a_log(replay, log, stride):
    pieces = [replay.get(f"/api/frames?from={begin}&count={2 * 1536 // stride}&stride={stride}&min_max=1")[2] for begin in (0, 1536)]
    frames = Frames(replay.session(), pieces)
    heights = [f32(state["p_WB"][2]) for state in messages(log, "/state")]
    begins = list(range(0, 2400, stride))
    assert frames.ticks == [tick for tick in begins for _ in range(2)]
    z = [p[2] for p in frames.of("state.p_WB")]
    assert z[0::2] == [min(heights[tick : tick + stride]) for tick in begins]
    assert z[1::2] == [max(heights[tick : tick + stride]) for tick in begins]


def test_the_events_of_a_log(replay, log):
    events = json.loads(replay.get("/api/events")[2])
    planned = [[plan["time"], event["event"], event["leg"]] for plan in messages(log, "/plan") for event in plan["events"]]
    assert [event for event in events if isinstance(event, list)] == planned
    names = replay.session()["header"]["event_names"]
    lift = [event[2] for event in events if isinstance(event, list) and names[event[1]] == "lift-off"]
    assert lift and set(lift) <= {"LF", "RF", "LH", "RH"}


def test_requests_for_frames_that_make_no_sense_are_told(replay):
    for query in ["from=-1", "from=x", "count=0", "count=5000", "stride=0", "min_max=2"]:
        status, _, body = replay.get(f"/api/frames?{query}")
        assert status == 400 and query.split("=")[0].encode() in body and b"valid is" in body


def test_a_damaged_log_says_what_is_missing_and_shows_the_rest(tmp_path, log):
    with Served("replay", damaged(log, tmp_path, 0.3)) as served:
        session = served.summarised()
        assert session["ticks"] == 2400 and len(session["damage"]) == 1 and "can't be read" in session["damage"][0]
        assert 1200 < len(served.frames("from=0&count=4096&stride=1").ticks) < 2400
        marks = [event for event in json.loads(served.get("/api/events")[2]) if isinstance(event, dict) and event["kind"] == "damage"]
        assert [mark["text"] for mark in marks] == session["damage"]


def test_a_first_message_that_is_no_signal_costs_a_tick(tmp_path, log):
    file = changed(log, tmp_path, "/state", 0, lambda state: state.update(p_WB="nowhere"))
    with Served("replay", file) as served:
        assert served.frames("from=0&count=3&stride=1").ticks == [1, 2]


def test_a_log_that_was_cut_off_shows_what_is_left(tmp_path, log):
    with Served("replay", cut(log, tmp_path, 0.5)) as served:
        session = served.session()
        assert 200 < session["ticks"] < 2400 and session["cut"].startswith("the log was never closed")
        last = session["ticks"] - 1
        assert served.frames(f"from={last}&count=10&stride=1").ticks == [last]


def test_a_log_whose_run_was_interrupted_is_told_from_one_that_was_cut_off(replay, tmp_path):
    assert replay.session()["cut"] == ""
    with Served("run", "walk_flat_ideal", "--view", "--record", tmp_path / "run.mcap") as run:
        time.sleep(1)
        assert run.end() == 2
    kept = (tmp_path / "run.mcap.partial").rename(tmp_path / "kept.mcap")  # it is told by what is in it
    with Served("replay", kept) as served:
        assert served.session()["cut"] == "the run was interrupted: the log's file is whole, and ends there"


@pytest.mark.parametrize("options", [{"by_time": True}, {"by_time": False}, {"by_time": False, "chunk_size": 20000},
                                     {"by_time": False, "compression": CompressionType.NONE}, {"by_time": False, "use_chunking": False}], ids=str)
def test_a_log_that_another_writer_wrote_anew_has_all_its_ticks_and_their_timings(replay, log, tmp_path, options):
    with Served("replay", in_other_chunks(log, tmp_path, **options)) as served:
        session = served.session()
        assert (session["first_tick"], session["ticks"], session["damage"]) == (0, 2400, [])
        query = "/api/frames?from=2390&count=10&stride=1"
        assert served.get(query)[2] == replay.get(query)[2]


def test_page_and_terminal_tell_the_same_place_of_damage(log, tmp_path):
    file, _, _ = without_chunk(log, tmp_path, 3)
    place = f"at byte {tick_chunks(log)[3].chunk_start_offset}"
    assert f"{place} of " in answer("info", file)
    with Served("replay", file) as served:
        (damage,) = served.session(lambda session: session["damage"])["damage"]
        assert damage.endswith(place)
        assert re.match(r"\d+\.\d{4} s to \d+\.\d{4} s can't be read: ", damage), "as finely as ticks are told"


def test_meshes_that_are_missing_are_told_in_the_terminal(log, tmp_path, monkeypatch):
    monkeypatch.setenv("SUREFOOT_ROBOT_PACKAGES", str(tmp_path))
    with Served("replay", log) as served:
        missing = [mesh["uri"].rsplit("/", 1)[1] for mesh in served.session()["meshes"] if not mesh["found"]]
        assert len(missing) > 3
        assert f"the page shows primitives, as these meshes are missing: {', '.join(missing[:3])} and {len(missing) - 3} more" in served.errors
