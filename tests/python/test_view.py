"""The program with --view, and a log in the page, as a browser sees them."""

import contextlib
import json
import math
import os
import pathlib
import re
import socket
import struct
import subprocess
import time
import urllib.parse

import pytest

from damaged_logs import changed, damaged
from live_page import Closed, Frames, Page, Refused, Served
from program import PROGRAM, complaint

LONG = ["--set", "duration=1000", "--set", "stack=terrain_adaptation"]


@pytest.fixture(scope="module")
def run():
    with Served("run", "walk_flat", "--view", *LONG) as served:
        yield served


def test_the_link_opens_the_page_and_its_session_describes_the_run(run):
    status, headers, body = run.get("/")
    assert status == 200 and b"<html" in body
    assert headers["Content-Security-Policy"].startswith("default-src 'self'")
    session = run.session()
    assert session["mode"] == "live" and session["protocol"] == 1
    assert session["title"] == "walk_flat"
    assert session["header"]["scenario"] == "walk_flat"
    assert session["frame_floats"] == sum(channel["size"] for channel in session["channels"])
    assert [level["level"] for level in session["tasks"]] == sorted(level["level"] for level in session["tasks"])
    assert session["orders"] == [{"tick": 0, "levels": session["header"]["level_names"]}]
    assert len(session["rows"]) == len(session["header"]["level_names"])


def test_every_field_of_the_log_is_a_channel(run, tmp_path):
    from mcap.reader import make_reader

    subprocess.run([PROGRAM, "run", "walk_flat", *LONG[2:], "--set", "duration=0.1", "--record", tmp_path / "run.mcap"], check=False, capture_output=True)
    names = [channel["name"] for channel in run.session()["channels"]]
    listed = {"active", "blocked_by", "level_switches"}  # entries of a frame, and what is said in words
    with open(tmp_path / "run.mcap", "rb") as file:
        for schema in {schema.name: schema for schema, *_ in make_reader(file).iter_messages()}.values():
            fields = json.loads(schema.data)["properties"]
            for field in fields.keys() - {"time", "levels"} - listed:
                assert any(f".{field}" in name for name in names), (schema.name, field)


def test_the_robot_and_its_meshes_are_served_by_number(run):
    assert b"<robot" in run.get("/api/robot.urdf")[2]
    meshes = run.session()["meshes"]
    assert meshes and all(mesh["found"] for mesh in meshes)
    status, _, body = run.get("/api/mesh/0")
    assert status == 200 and len(body) == meshes[0]["bytes"]
    for wrong in [len(meshes), "x", "../0", "-1", "0/..%2f.."]:
        assert run.get(f"/api/mesh/{urllib.parse.quote(str(wrong))}")[0] == 404


def test_frames_come_in_order_at_real_time(run):
    with run.page() as page:
        begin = time.monotonic()
        while time.monotonic() < begin + 2.0:
            page.hear()
        frames = Frames(run.session(), page.blocks)
    assert frames.dropped == 0
    assert frames.ticks == list(range(frames.ticks[0], frames.ticks[-1] + 1))
    assert frames.times == pytest.approx([0.0025 * tick for tick in frames.ticks])
    assert all(abs(z - 0.4) < 0.2 for _, _, z in frames.of("truth.p_WB"))
    assert {status["type"] for status in page.texts} == {"status"}
    status = page.texts[-1]
    assert status["paused"] is False and status["speed"] == 1.0 and status["ended"] is None
    assert status["command"]["by"] == "scenario"


def test_pause_step_and_speed(run):
    with run.page() as page:
        page.do("pause")
        tick = page.status(lambda status: status["paused"])["tick"]
        time.sleep(0.3)
        page.do("step", ticks=5)
        still = page.status(lambda status: status["tick"] != tick)
        page.do("speed", factor=0.125)
        page.do("resume")
        slow = page.status(lambda status: not status["paused"])
        time.sleep(1.0)
        later = page.status(lambda status: status["tick"] > slow["tick"] + 20)
        page.do("speed", factor=1.0)
    assert tick < still["tick"] <= tick + 20  # what was on the way, and the five
    assert later["time"] - slow["time"] < 1.0
    assert "valid is" in run_error(run, "speed", factor=100)


def run_error(run, type, **members):
    with run.page() as page:
        reply = page.ask(type, **members)
    assert reply["ok"] is False
    return reply["error"]


def test_a_push_moves_the_robot(run):
    with run.page() as page:
        page.do("push", body="base", impulse=[0, 15, 0], duration=0.1)
        page.wait(lambda heard: heard["type"] == "change" and "push of 15 N·s" in heard["text"])
        end = time.monotonic() + 1.0
        while time.monotonic() < end:
            page.hear()
        sideways = [v[1] for v in Frames(run.session(), page.blocks).of("truth.v_WCom")]
    assert max(sideways) > 0.1
    assert "base" in run_error(run, "push", body="basis", impulse=[0, 1, 0], duration=0.1)
    assert "60 N·s" in run_error(run, "push", body="base", impulse=[0, 100, 0], duration=1)


def test_gains_order_and_friction_change_and_are_undone(run):
    def gain(session):
        (task,) = [task for task in session["tasks"] if task["task"] == "com_xy"]
        return next(number["value"] for number in task["numbers"] if number["name"] == "kp")

    before = run.session()
    order = before["orders"][-1]["levels"]
    with run.page() as page:
        changed = lambda heard: heard["type"] == "change" and heard["kind"] in ("stack", "friction")  # noqa: E731
        page.do("gain", level="com_xy", task="com_xy", name="kp", value=77.0)
        assert "→ 77" in page.wait(changed)["text"]
        yaw = order.index("torso_yaw")
        page.do("order", levels=[*order[: yaw - 1], order[yaw], order[yaw - 1], *order[yaw + 1 :]])
        page.wait(changed)
        page.do("friction", value=0.25)
        page.wait(changed)
        session = run.session()
        assert gain(session) == 77.0
        assert session["orders"][-1]["levels"].index("torso_yaw") == yaw - 1
        assert session["friction"] == 0.25
        assert session["generation"] > before["generation"]
        assert [channel["name"] for channel in session["channels"]] == [channel["name"] for channel in before["channels"]]
        for _ in range(3):
            page.do("undo")
            assert page.wait(changed)["text"].startswith("undo: ")
        assert page.status(lambda status: status["undo"] == 0)
    after = run.session()
    assert gain(after) == gain(before)
    assert after["orders"][-1]["levels"] == order and after["friction"] == before["friction"]


def test_the_operator_commands_the_walk_and_gives_it_back(run):
    with run.page() as page:
        page.do("walk", walk=True, velocity=[0.05, 0.0], yaw_rate=0.1, height=0.0)
        status = page.status(lambda status: status["command"]["by"] == "operator" and status["command"]["yaw_rate"] != 0)
        assert status["command"] == {"walk": True, "velocity": [0.05, 0.0], "yaw_rate": 0.1, "height": 0.0, "by": "operator"}
        page.do("walk", by="scenario")
        page.status(lambda status: status["command"]["by"] == "scenario")


def test_a_reset_begins_the_run_again(run):
    with run.page() as page:
        generation = page.status()["generation"]
        page.do("reset")
        status = page.status(lambda status: status["generation"] > generation)
        assert status["time"] < 1.0


def test_the_four_refusals(run):
    assert run.get("/", {"Host": "evil.example"})[0] == 421
    with pytest.raises(Refused, match="403"):
        Page(run, origin="http://evil.example")
    with run.page(token="wrong") as page:
        reply = page.ask("pause")
    assert not reply["ok"] and "token" in reply["error"]
    assert "--token" in complaint("run", "walk_flat", "--view", "--listen", "0.0.0.0")


def test_without_a_token_a_page_may_look(run):
    with run.page(token="") as page:
        assert page.status()["clients"] >= 1
        while not page.blocks:
            page.hear()


def test_a_port_in_use_is_told_with_what_to_do(run):
    text = complaint("run", "walk_flat", "--view", "--port", run.port)
    assert f"port {run.port}" in text and "--port" in text


def test_what_does_not_go_with_a_view_is_told():
    assert "--seeds" in complaint("run", "walk_flat", "--view", "--seeds", 3)
    assert "--record" in complaint("run", "walk_flat", "--view", "--report", "out")
    assert "--view" in complaint("run", "walk_flat", "--listen", "0.0.0.0")
    assert "16 to 128" in complaint("run", "walk_flat", "--view", "--token", "short")
    assert "65535" in complaint("run", "walk_flat", "--view", "--port", 70000)
    assert "64" in complaint("run", "walk_flat", "--view", "--view-clients", 65)


def test_after_its_end_the_page_stays_until_it_is_interrupted():
    with Served("run", "walk_flat", "--view", "--set", "duration=0.3") as run, run.page() as page:
        status = page.status(lambda status: status["ended"] is not None)
        assert status["ended"] == "the whole duration"
        assert "reset" in page.ask("push", body="base", impulse=[0, 1, 0], duration=0.1)["error"]
        page.do("reset")
        page.status(lambda status: status["ended"] is None)
        page.status(lambda status: status["ended"] is not None)
        with run.page() as late:
            late.status()  # comes before the frames that wait
            end = time.monotonic() + 20
            while not late.blocks or Frames(run.session(), late.blocks).ticks[-1] != 119:
                assert time.monotonic() < end
                late.hear()
        code = run.end()
    assert code in (0, 1)
    assert run.output.count("walk_flat") == 2, "results of each"


def test_an_interrupt_ends_a_run_that_is_watched_as_any_other(tmp_path):
    with Served("run", "walk_flat", "--view", *LONG, "--record", tmp_path / "run.mcap") as run, run.page() as page:
        page.do("push", body="base", impulse=[0, 5, 0], duration=0.1)
        page.wait(lambda heard: heard["type"] == "change")
        assert run.end() == 2
    assert (tmp_path / "run.mcap.partial").exists()
    assert "interrupted" in run.errors


def ticks_of(path):
    from mcap.reader import make_reader

    with open(path, "rb") as file:
        return sum(1 for _ in make_reader(file).iter_messages(topics=["/command"]))


def test_a_reset_keeps_the_log_of_the_run_before(tmp_path):
    """Of one that it cuts off and of one that has ended."""
    (tmp_path / "run-3.mcap").write_text("mine")
    with Served("run", "walk_flat", "--view", "--set", "duration=1", "--record", tmp_path / "run.mcap") as run, run.page() as page:
        page.status(lambda status: 0 < status["tick"] < 380)
        assert page.status()["recording"] == str(tmp_path / "run.mcap")
        page.do("reset")
        page.status(lambda status: status["recording"].endswith("run-2.mcap") and status["ended"] is not None)
        cut = ticks_of(tmp_path / "run.mcap.partial")
        assert 0 < cut < 400 and ticks_of(tmp_path / "run-2.mcap") == 400
        page.do("reset")
        page.status(lambda status: status["recording"].endswith("run-4.mcap") and 0 < status["tick"] < 380)
        assert run.end() == 2
    assert ticks_of(tmp_path / "run.mcap.partial") == cut and ticks_of(tmp_path / "run-2.mcap") == 400
    assert ticks_of(tmp_path / "run-4.mcap.partial") > 0 and (tmp_path / "run-3.mcap").read_text() == "mine"
    assert "run.mcap.partial; the next goes into" in run.errors
    assert "run-4.mcap.partial holds the run so far" in run.errors


def test_a_page_too_many_is_told_the_limit():
    with Served("run", "walk_flat", "--view", "--view-clients", 2, *LONG) as run, run.page() as first, run.page() as second:
        with pytest.raises(Closed, match="2 pages watch already, the limit; close one of them, or raise --view-clients"), run.page() as third:
            third.hear()
        assert first.status(lambda status: status["clients"] == 2) and second.status()


def test_a_page_that_comes_late_can_ask_for_the_last_two_minutes():
    with Served("run", "walk_flat", "--view", *LONG) as run, run.page() as page:
        page.do("speed", factor=8.0)
        while len(page.blocks) < 60:
            page.hear()
        sent = Frames(run.session(), page.blocks)
        session = run.session()
        assert session["first_tick"] == 0 and session["ticks"] > 0
        first = sent.ticks[0]
        asked = Frames(session, [run.get(f"/api/frames?from={first}&count=200&stride=1")[2]])
        assert asked.ticks == list(range(first, first + 200))
        assert asked.of("truth.p_WB") == sent.of("truth.p_WB")[:200] and asked.active == sent.active[:200]
        span = Frames(session, [run.get(f"/api/frames?from={first}&count=2&stride=100&min_max=1")[2]])
        heights = [p[2] for p in sent.of("truth.p_WB")[:100]]
        assert [p[2] for p in span.of("truth.p_WB")] == [min(heights), max(heights)]


def niceness(process):
    """Of its threads, by name."""
    found = {}
    for task in pathlib.Path(f"/proc/{process.pid}/task").iterdir():
        name, _, rest = (task / "stat").read_text().partition("(")[2].rpartition(")")
        found[name] = int(rest.split()[16])
    return found


def test_what_can_wait_gives_way_to_the_run(tmp_path):
    with Served("run", "walk_flat", "--view", *LONG, "--record", tmp_path / "run.mcap") as run:
        nice, loop = niceness(run.process), os.getpriority(os.PRIO_PROCESS, run.process.pid)
        assert nice["view-server"] == nice["log-writer"] == loop + 5, (nice, loop)


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    path = tmp_path_factory.mktemp("log") / "run.mcap"
    settings = ["--set", "duration=6", "planner.calibration.duration=0"]
    subprocess.run([PROGRAM, "run", "walk_flat", *settings, "--record", path], check=False, capture_output=True)
    return path


@pytest.fixture(scope="module")
def replay(log):
    with Served("replay", log) as served:
        for _ in range(200):
            if served.session()["summarised"] == served.session()["ticks"]:
                break
            time.sleep(0.1)
        yield served


def logged(path, topic):
    from mcap.reader import make_reader

    with open(path, "rb") as file:
        return [json.loads(message.data) for *_, message in make_reader(file).iter_messages(topics=[topic])]


def f32(number):
    return math.nan if number is None else struct.unpack("<f", struct.pack("<f", number))[0]


def described(session):
    """The channels, but for those of the levels: the two have other stacks."""
    return [
        {key: value for key, value in channel.items() if key != "offset"}
        for channel in session["channels"]
        if not channel["name"].startswith("hierarchy.level.")
    ]


def test_a_log_is_described_as_a_live_run_is(replay, run):
    session = replay.session()
    assert session["mode"] == "replay" and session["source"] == "run.mcap" and not session["can_command"]
    assert session["ticks"] == session["summarised"] == 2400
    live = run.session()
    assert described(session) == described(live)
    assert session["rows"][:4] == live["rows"][:4]  # the levels that keep the physics
    with pytest.raises(Refused, match="404"):
        replay.page()


def test_the_frames_of_a_log_are_those_that_stand_in_it(replay, log):
    session = replay.session()
    asked = [(0, 400, 1), (750, 300, 1), (2399, 1, 1), (10, 90, 7), (2390, 50, 1), (2400, 5, 1)]
    state, command, timing = (logged(log, topic) for topic in ("/state", "/command", "/timings"))
    for begin, count, stride in asked:
        frames = Frames(session, [replay.get(f"/api/frames?from={begin}&count={count}&stride={stride}")[2]])
        wanted = [tick for tick in range(begin, begin + count * stride, stride) if tick < 2400]
        assert frames.ticks == wanted
        assert frames.of("state.p_WB") == [tuple(map(f32, state[tick]["p_WB"])) for tick in wanted]
        assert frames.of("command.torque") == [tuple(map(f32, command[tick]["torque"])) for tick in wanted]
        assert frames.of("timings.total") == [f32(timing[tick]["total"]) for tick in wanted]


@pytest.mark.parametrize("stride", [16, 64, 256])
def test_least_and_greatest_of_a_log(replay, log, stride):
    pieces = [replay.get(f"/api/frames?from={begin}&count={2 * 1536 // stride}&stride={stride}&min_max=1")[2] for begin in (0, 1536)]
    frames = Frames(replay.session(), pieces)
    heights = [f32(state["p_WB"][2]) for state in logged(log, "/state")]
    begins = list(range(0, 2400, stride))
    assert frames.ticks == [tick for tick in begins for _ in range(2)]
    z = [p[2] for p in frames.of("state.p_WB")]
    assert z[0::2] == [min(heights[tick : tick + stride]) for tick in begins]
    assert z[1::2] == [max(heights[tick : tick + stride]) for tick in begins]


def test_the_events_of_a_log(replay, log):
    events = json.loads(replay.get("/api/events")[2])
    planned = [[plan["time"], plan["event"]] for plan in logged(log, "/plan") if plan["event"] != 0]
    assert [event[:2] for event in events if isinstance(event, list)] == planned
    names = replay.session()["header"]["event_names"]
    lift = [event[2] for event in events if isinstance(event, list) and names[event[1]] == "lift-off"]
    assert lift and set(lift) <= {"LF", "RF", "LH", "RH"}


def test_requests_for_frames_that_make_no_sense_are_told(replay):
    for query in ["from=-1", "from=x", "count=0", "count=5000", "stride=0", "min_max=2"]:
        status, _, body = replay.get(f"/api/frames?{query}")
        assert status == 400 and query.split("=")[0].encode() in body and b"valid is" in body


def test_logs_that_cannot_be_shown_are_told_with_what_to_do(tmp_path, log):
    whole = log.read_bytes()
    (tmp_path / "foreign.mcap").write_bytes(b"not a log at all")
    (tmp_path / "empty.mcap").write_bytes(b"")
    (tmp_path / "short.mcap").write_bytes(whole[:5000])
    for name, part in [("missing", "no such file"), ("foreign", "not an MCAP file"), ("empty", "empty"), ("short", "surefoot")]:
        assert part in complaint("replay", tmp_path / f"{name}.mcap", "--port", 0)


def test_a_log_of_a_newer_program_is_told_with_both_versions(tmp_path):
    from mcap.writer import Writer

    with open(tmp_path / "newer.mcap", "wb") as file:
        writer = Writer(file)
        writer.start()
        writer.add_attachment(0, 0, "header.json", "application/json", b'{"log_version":"9.0"}')
        writer.finish()
    assert re.search("log version 9.0; this program reads 2", complaint("replay", tmp_path / "newer.mcap", "--port", 0))


def test_a_damaged_log_says_what_is_missing_and_shows_the_rest(tmp_path, log):
    with Served("replay", damaged(log, tmp_path, 0.3)) as served:
        session = served.session()
        for _ in range(200):
            if session["summarised"] == session["ticks"]:
                break
            time.sleep(0.1)
            session = served.session()
        assert session["ticks"] == 2400 and len(session["damage"]) == 1 and "can't be read" in session["damage"][0]
        frames = Frames(session, [served.get("/api/frames?from=0&count=4096&stride=1")[2]])
        assert 1200 < len(frames.ticks) < 2400
        marks = [event for event in json.loads(served.get("/api/events")[2]) if isinstance(event, dict) and event["kind"] == "damage"]
        assert [mark["text"] for mark in marks] == session["damage"]


def test_a_first_message_that_is_no_signal_costs_a_tick(tmp_path, log):
    file = changed(log, tmp_path, "/state", 0, lambda state: state.update(p_WB="nowhere"))
    with Served("replay", file) as served:
        assert Frames(served.session(), [served.get("/api/frames?from=0&count=3&stride=1")[2]]).ticks == [1, 2]


def test_what_a_page_cannot_do_is_refused(log):
    for words, part in [
        (["run", "walk_flat", "--view", "--video", "x.mp4"], "--view shows one run, and can't go with --video"),
        (["demo", "--view", "--out", "x"], "can't go with --out"),
        (["demo", "--view", "--seeds", 3], "can't go with --seeds"),
        (["demo", "--view", "--jobs", 1], "can't go with --jobs"),
        (["replay", log, "--verify", "--port", 8123], "--verify and --stack don't serve"),
        (["replay", log, "--stack", "walk", "--listen", "127.0.0.1"], "--verify and --stack don't serve"),
    ]:
        assert part in complaint(*words)


def test_too_many_connections_are_told_so():
    with Served("run", "walk_flat", "--view", "--view-clients", 1, *LONG) as served, contextlib.ExitStack() as open_ones:
        sockets = [open_ones.enter_context(socket.create_connection((served.host, served.port), timeout=20)) for _ in range(45)]
        assert sockets[-1].recv(1000).startswith(b"HTTP/1.1 503 ")
        sockets[0].sendall(f"GET /api/session HTTP/1.1\r\nHost: {served.host}:{served.port}\r\n\r\n".encode())
        assert sockets[0].recv(1000).startswith(b"HTTP/1.1 200 ")


def test_the_tasks_of_a_log_have_what_they_were_given(replay):
    (cone,) = [task for task in replay.session()["tasks"] if task["task"] == "friction_cone"]
    assert cone["choices"].keys() >= {"axes", "pyramid"}


def test_a_log_that_was_cut_off_shows_what_is_left(tmp_path, log):
    cut = tmp_path / "cut.mcap"
    whole = log.read_bytes()
    cut.write_bytes(whole[: len(whole) // 2])
    with Served("replay", cut) as served:
        session = served.session()
        assert 200 < session["ticks"] < 2400 and session["whole"] is False
        last = session["ticks"] - 1
        assert Frames(session, [served.get(f"/api/frames?from={last}&count=10&stride=1")[2]]).ticks == [last]
