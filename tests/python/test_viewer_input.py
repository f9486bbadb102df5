"""What a user does in the viewer's page with mouse, keys and fingers: the run does it, and nothing else."""

import json
import os
import pathlib
import shutil
import signal
import sysconfig
import time

import pytest

from browser import wait_for
from live_page import WALK, Served
from log_file import messages
from viewer_page import SCREENSHOTS, SPY, pause, phone, sent, show, tap


@pytest.fixture(scope="module")
def played(tmp_path_factory):
    """A run that goes on, and its log."""
    log = tmp_path_factory.mktemp("played") / "run.mcap"
    with Served(*WALK, "--record", log) as viewer:
        viewer.log = log
        yield viewer


def set_field(browser, field, value):
    browser.run(f"(() => {{ const field = {field}; field.value = '{value}'; field.dispatchEvent(new Event('change')); }})()")


def test_a_paused_run_that_begins_again_shows_its_first_tick(browser, played):
    show(browser, played.link)
    pause(browser)
    assert browser.run("surefoot.tick") > 0
    browser.press("r")
    browser.wait("surefoot.tick === 0 && surefoot.drawn === 0 && surefoot.status.paused", 60)
    browser.press(" ")
    browser.wait("surefoot.tick > 20", 60)


def test_three_presses_make_it_eight_times_as_fast(browser, played):
    show(browser, played.link)
    for keys, speed in (("]]]", 8), ("[[[", 1)):
        for key in keys:
            browser.press(key)
        browser.wait(f"Number(document.querySelector('#speed').value) === {speed}")
        browser.wait(f"surefoot.status.speed === {speed}")


def test_a_field_asks_for_what_was_typed_once_whatever_changes_meanwhile(browser, played):
    show(browser, played.link)
    browser.run(SPY)
    browser.click("#tab-tune")
    field = "document.querySelector('[data-gain=\"com_xy.com_xy.kp\"]')"
    before = browser.run(f"{field}.value")
    set_field(browser, field, "")
    assert browser.run(f"{field}.value") == before
    browser.run(f"{field}.focus(); {field}.select()")
    browser.call("Input.insertText", text="45")
    generation = browser.run("surefoot.generation")
    set_field(browser, "document.querySelector('#friction')", 0.45)
    browser.wait(f"surefoot.generation > {generation}")
    browser.call("Input.insertText", text="0")
    assert browser.run(f"{field}.value") == "450" and sent(browser, "gain") == []
    browser.run(f"{field}.blur()")
    browser.wait("document.querySelector('#notes').textContent.includes('kp 500 → 450')")
    assert [(one["name"], one["value"]) for one in sent(browser, "gain")] == [("kp", 450)]
    browser.wait(f"{field}.value === '450'")


def test_two_moves_of_a_level_add_up(browser, played):
    show(browser, played.link)
    browser.run(SPY)
    names = "surefoot.levels().map(one => one.name)"
    order = browser.run(names)
    tilt = order[-2]
    expected = [*order[:-4], tilt, *order[-4:-2], order[-1]]
    browser.run(f"""(() => {{ const up = document.querySelector('.level[data-level={tilt}] .movers button'); up.click(); up.click(); }})()""")
    browser.wait(f"JSON.stringify({names}) === {json.dumps(json.dumps(expected, separators=(',', ':')))}", 60)
    assert sent(browser, "order")[-1]["levels"] == expected
    cards = "[...document.querySelectorAll('.level')].map(one => one.dataset.level)"
    wait_for(lambda: browser.run(cards) == expected, "the panel's order")


def test_a_program_that_stands_still_is_told(browser, played):
    show(browser, played.link)
    browser.wait("document.querySelector('#link-state').textContent === 'connected'")
    played.process.send_signal(signal.SIGSTOP)
    try:
        browser.wait("/^no answer for \\d+ s$/.test(document.querySelector('#link-state').textContent)")
        assert browser.run("document.querySelector('#link-state').dataset.state") == "lost"
    finally:
        played.process.send_signal(signal.SIGCONT)
    browser.wait("document.querySelector('#link-state').textContent === 'connected'")


def test_a_phone_turns_the_view_and_commands_by_touch(browser, played):
    with phone(browser):
        show(browser, played.link)
        for tab in ("hierarchy", "state", "drive", "tune"):
            tap(browser, f"#tab-{tab}")
            browser.wait(f"!document.querySelector('#panel-{tab}').hidden")
            browser.screenshot(SCREENSHOTS / f"phone_{tab}.png")
            assert browser.run("[document.documentElement, document.querySelector('#main')].map(one => one.scrollWidth - one.clientWidth)") == [0, 0]
        tap(browser, "#play")
        browser.wait("surefoot.status.paused")

        def turned():
            camera, (x, y) = browser.run("surefoot.camera"), browser.middle("#canvas")
            browser.touch([(x + 12 * step, y) for step in range(6)])
            picture = browser.run("surefoot.pictures")
            browser.wait(f"surefoot.pictures > {picture}")
            return max(abs(a - b) for a, b in zip(camera, browser.run("surefoot.camera"))) > 0.1
        wait_for(turned, "the camera to turn", 60)
        tap(browser, "#tab-drive")
        browser.wait("!document.querySelector('#panel-drive').hidden")
        tap(browser, "#stand")
        browser.wait("surefoot.status.command.by === 'operator'")
        tap(browser, "#play")
        browser.wait("!surefoot.status.paused")


def test_all_that_was_changed_stands_in_the_log(played):
    played.process.send_signal(signal.SIGINT)
    played.process.wait(timeout=60)
    last = max(played.log.parent.glob("run*.mcap*"), key=os.path.getmtime)  # of the run since its last reset
    kinds = {change["kind"]: change["text"] for change in messages(last, "/changes")}
    assert kinds.keys() >= {"stack", "friction", "walk"}


def test_a_server_of_a_log_that_is_gone_is_told_and_found_again(browser, log):
    with Served("replay", log) as first:
        show(browser, first.link)
        first.process.kill()
    browser.wait("document.querySelector('#notes').textContent.includes('start `surefoot replay` again')")
    assert browser.run("document.querySelector('#link-state').dataset.state") == "lost"
    browser.run("window.before = true")
    with Served("replay", log, port=first.port):
        browser.wait("window.before === undefined && window.surefoot?.pictures > 0", 60)
        assert browser.run("document.querySelector('#notes').textContent") == ""


def test_a_server_of_a_log_that_stands_still_is_told_and_is_not_asked_by_ever_more_requests(browser, log):
    with Served("replay", log) as viewer:
        show(browser, viewer.link)
        viewer.process.send_signal(signal.SIGSTOP)
        try:
            browser.wait("document.querySelector('#notes').textContent.includes('does not answer')", 30)
            assert browser.run("document.querySelector('#link-state').dataset.state") == "lost"
            asked = len(browser.requests)
            time.sleep(8)
            assert len(browser.requests) - asked <= 2
        finally:
            viewer.process.send_signal(signal.SIGCONT)
        browser.wait("document.querySelector('#notes').textContent === '' && document.querySelector('#link-state').textContent === ''", 30)


def test_rough_ground_is_drawn_as_it_is_and_a_missing_mesh_is_told(browser, tmp_path, monkeypatch):
    robot = "example-robot-data/robots/anymal_b_simple_description"
    packages = pathlib.Path(os.environ.get("SUREFOOT_ROBOT_PACKAGES") or pathlib.Path(sysconfig.get_path("platlib")) / "cmeel.prefix/share")
    shutil.copytree(packages / robot, tmp_path / robot, ignore=shutil.ignore_patterns("anymal_thigh.dae"))
    monkeypatch.setenv("SUREFOOT_ROBOT_PACKAGES", str(tmp_path))
    with Served("run", "rough_field", "--view") as viewer:
        assert any("primitives" in line and "anymal_thigh.dae" in line for line in viewer.errors.splitlines()), "in the terminal, too"
        show(browser, viewer.link)
        browser.wait("surefoot.meshesLoading === 0", 60)
        pause(browser)
        field = next(one for one in viewer.session()["header"]["terrain"] if one["columns"] > 1)
        step = [size / (count - 1) for size, count in zip(field["size"], (field["columns"], field["rows"]))]
        for i, j in ((field["columns"] // 2, field["rows"] // 2), (field["columns"] // 3, field["rows"] // 4)):
            x, y = (position + (k - (count - 1) / 2) * one for position, k, count, one in
                    zip(field["position"], (i, j), (field["columns"], field["rows"]), step))
            height = field["position"][2] + field["heights"][j * field["columns"] + i]
            assert abs(browser.run(f"surefoot.ground({x + 1e-7}, {y + 1e-7})") - height) < 1e-4
        assert "anymal_thigh.dae" in browser.run("document.querySelector('[data-note=meshes]').textContent")
        assert [uri.rsplit("/", 1)[1] for uri in browser.run("surefoot.meshesMissing")] == ["anymal_thigh.dae"]
        browser.screenshot(SCREENSHOTS / "rough_field_without_thigh.png")
        browser.click("#tab-drive")
        browser.run("document.querySelector('#push-impulse').value = 61")
        for _ in range(8):
            browser.press("p")
        refusals = "[...document.querySelectorAll('.note.error')].filter(one => one.textContent.includes('up to 60 N·s'))"
        browser.wait(f"{refusals}[0]?.textContent.includes('× 8')")
        assert browser.run(f"{refusals}.length") == 1
        assert "anymal_thigh.dae" in browser.run("document.querySelector('[data-note=meshes]').textContent"), "what must stay stays"
