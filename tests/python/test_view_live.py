"""The program with --view, as a page without a browser hears it: the session, the frames, the run's begin and end."""

import json
import os
import pathlib
import time
import urllib.parse

import pytest
from mcap.reader import make_reader

from browser import wait_for
from live_page import LONG, Frames, Served
from log_file import messages
from program import SHORT, surefoot


def test_the_link_opens_the_page_and_its_session_describes_the_run(run):
    status, headers, body = run.get("/")
    assert status == 200 and b"<html" in body
    assert headers["Content-Security-Policy"].startswith("default-src 'none'; script-src 'self'; style-src 'self';")
    session = run.session()
    assert session["mode"] == "live" and session["protocol"] == 2
    assert session["title"] == "walk_flat"
    assert session["header"]["scenario"] == "walk_flat"
    assert session["frame_floats"] == sum(channel["size"] for channel in session["channels"])
    assert [level["level"] for level in session["tasks"]] == sorted(level["level"] for level in session["tasks"])
    assert session["orders"] == [{"tick": 0, "levels": session["header"]["level_names"]}]
    assert len(session["rows"]) == len(session["header"]["level_names"])


def test_every_field_of_the_log_is_a_channel(run, tmp_path):
    surefoot("run", "walk_flat", *LONG[2:], *SHORT, "--record", tmp_path / "run.mcap")
    names = [channel["name"] for channel in run.session()["channels"]]
    # Entries of a frame, what is said in words, and a list whose length a stack makes.
    listed = {"active", "missed", "blocked_by", "level_switches", "events", "frames"}
    with open(tmp_path / "run.mcap", "rb") as file:
        schemas = {schema.name: schema for schema, *_ in make_reader(file).iter_messages()}
        for schema in schemas.values():
            fields = json.loads(schema.data)["properties"]
            for field in fields.keys() - {"time", "levels"} - listed:
                assert any(f".{field}" in name for name in names), (schema.name, field)


def test_the_robot_and_its_meshes_are_served_by_number(run):
    assert b"<robot" in run.get("/api/robot.urdf")[2]
    meshes = run.session()["meshes"]
    assert meshes and all(mesh["found"] for mesh in meshes)
    status, _, body = run.get("/api/mesh/0")
    assert status == 200 and len(body) > 1000
    for wrong in [len(meshes), "x", "../0", "-1", "0/..%2f.."]:
        assert run.get(f"/api/mesh/{urllib.parse.quote(str(wrong))}")[0] == 404


def test_frames_come_in_order_at_real_time(run):
    with run.page() as page:
        page.hear_for(2.0)
        frames = Frames(run.session(), page.blocks)
    assert frames.dropped == 0
    assert frames.ticks == list(range(frames.ticks[0], frames.ticks[-1] + 1))
    assert frames.times == pytest.approx([0.0025 * tick for tick in frames.ticks])
    assert all(abs(z - 0.4) < 0.2 for _, _, z in frames.of("truth.p_SB"))
    assert {status["type"] for status in page.texts} == {"status"}
    status = page.texts[-1]
    assert status["paused"] is False and status["speed"] == 1.0 and status["ended"] is None
    assert status["command"]["by"] == "scenario"


def test_a_run_calibrates_and_then_waits_for_a_page_that_has_drawn():
    with Served("run", "walk_flat", "--view", *LONG, waits=True) as run, run.page() as page:
        page.status(lambda status: status["tick"] > 0 and status["calibrating"] is None, 60)
        held = page.status()["time"]
        assert 9.4 < held < 9.6
        page.hear_for(1.0)
        assert page.status()["time"] == held
        page.drawn()
        assert page.status(lambda status: status["time"] > held + 0.1)["calibrating"] is None
        assert run.end() == 2
    assert "waits" in run.errors and "--no-wait" in run.errors


def test_without_waiting_the_calibration_is_told_at_real_time():
    with Served("run", "walk_flat", "--view", *LONG) as run, run.page() as page:
        first = page.status(lambda status: status["calibrating"] is not None)
        later = page.status(lambda status: status["time"] > first["time"] + 0.2)
    assert first["time"] + first["calibrating"] == pytest.approx(9.5, abs=0.01)
    assert later["time"] + later["calibrating"] == pytest.approx(9.5, abs=0.01)


def test_after_its_end_the_page_stays_until_it_is_interrupted():
    with Served("run", "walk_flat", "--view", "--set", "duration=0.3") as run, run.page() as page:
        status = page.status(lambda status: status["ended"] is not None)
        assert status["ended"] == "ran to its end"
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
    assert code in (0, 1, 4)
    assert run.output.count("walk_flat") == 2, "results of each"


def test_an_interrupt_ends_a_run_that_is_watched_as_any_other(tmp_path):
    with Served("run", "walk_flat", "--view", *LONG, "--record", tmp_path / "run.mcap") as run, run.page() as page:
        page.do("push", body="base", impulse=[0, 5, 0], duration=0.1)
        page.change()
        assert run.end() == 2
    assert (tmp_path / "run.mcap.partial").exists()
    assert "interrupted" in run.errors


def ticks_of(path):
    return len(messages(path, "/command"))


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


def test_a_page_that_comes_late_can_ask_for_the_last_two_minutes():
    with Served("run", "walk_flat", "--view", *LONG) as run, run.page() as page:
        page.do("speed", factor=8.0)
        while len(page.blocks) < 60:
            page.hear()
        sent = Frames(run.session(), page.blocks)
        session = run.session()
        assert session["first_tick"] == 0 and session["ticks"] > 0
        first = sent.ticks[0]
        asked = run.frames(f"from={first}&count=200&stride=1")
        assert asked.ticks == list(range(first, first + 200))
        assert asked.of("truth.p_SB") == sent.of("truth.p_SB")[:200] and asked.active == sent.active[:200]
        assert any(state == 2 and by != 0 for rows in sent.active for _, state, _, by in rows), "the forces that are minimised are missed equalities"
        span = run.frames(f"from={first}&count=2&stride=100&min_max=1")
        heights = [p[2] for p in sent.of("truth.p_SB")[:100]]
        assert [p[2] for p in span.of("truth.p_SB")] == [min(heights), max(heights)]


LEAST_PRIORITY = 19  # niceness; at it there is nothing below


def scheduling(process):
    """Niceness and policy of its threads, by name."""
    found = {}
    for task in pathlib.Path(f"/proc/{process.pid}/task").iterdir():
        name, _, rest = (task / "stat").read_text().partition("(")[2].rpartition(")")
        found[name] = (int(rest.split()[16]), os.sched_getscheduler(int(task.name)))
    return found


def test_what_can_wait_gives_way_to_the_run(tmp_path):
    with Served("run", "walk_flat", "--view", *LONG, "--record", tmp_path / "run.mcap") as run:
        loop = os.getpriority(os.PRIO_PROCESS, run.process.pid)
        gives_way = (min(loop + 5, LEAST_PRIORITY), os.SCHED_BATCH)
        lower = {"view-server": gives_way, "log-writer": gives_way}
        wait_for(lambda: lower.items() <= scheduling(run.process).items(), "both threads to have a lower priority")
