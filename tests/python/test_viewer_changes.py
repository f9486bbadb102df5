"""What was changed before a page came, and what waits for the next tick, stands in the page as in the run."""

import pytest

from live_page import Page
from viewer import Viewer
from viewer_page import SCREENSHOTS, WALK, pause, show

CHANGES = "[...document.querySelectorAll('.changes li')].map(one => one.textContent)"


# A page whose connection ends, and is not had again while `offline` says so.
CUT = """window.WebSocket = class extends WebSocket {
  constructor(url) { super(window.offline ? `${url}/none` : url); window.socket = this; }
};"""


@pytest.fixture
def walk():
    with Viewer(*WALK) as viewer:
        yield viewer


def changed(kind):
    return lambda heard: heard["type"] == "change" and heard["kind"] == kind


def test_a_page_that_is_opened_late_shows_the_changes_from_before_it_came(browser, walk):
    with Page(walk) as first:
        first.do("friction", value=0.4)
        first.wait(changed("friction"))
        first.do("gain", level="com_xy", task="com_xy", name="kp", value=450.0)
        first.wait(changed("stack"))
    show(browser, walk.link)
    browser.click("#tab-tune")
    browser.wait("document.querySelector('#undo').textContent === 'Undo (2)'")
    browser.wait(f"{CHANGES}.length === 2")
    later, earlier = browser.run(CHANGES)
    assert "→ 450" in later and "friction" in earlier and "→ 0.4" in earlier
    assert "No change so far" not in browser.run("document.querySelector('#panel-tune').innerText")
    browser.screenshot(SCREENSHOTS / "late_changes.png")
    browser.press("r")
    browser.wait(f"surefoot.generation > 2 && {CHANGES}.length === 0")  # of the run that has begun


def test_what_is_changed_while_the_run_is_paused_waits_for_the_next_tick(browser, walk):
    show(browser, walk.link)
    browser.click("#tab-tune")
    pause(browser)
    with Page(walk) as other:
        other.do("friction", value=0.4)
    note = "document.querySelector('[data-note=pending]')?.textContent ?? ''"
    browser.wait(f"({note}).includes('→ 0.4')")
    (line,) = browser.run(CHANGES)
    assert line.startswith("with the next tick friction")
    browser.screenshot(SCREENSHOTS / "pending.png")
    with Page(walk) as late:
        assert "→ 0.4" in late.status()["pending"]
    browser.press(".")
    browser.wait(f"({note}) === ''")
    (line,) = browser.wait(f"(changes => changes.length === 1 && !changes[0].includes('next tick') && changes)({CHANGES})")
    assert "→ 0.4" in line


def test_a_page_that_was_away_during_a_reset_shows_nothing_of_the_run_before(browser, walk):
    script = browser.call("Page.addScriptToEvaluateOnNewDocument", source=CUT)["identifier"]
    show(browser, walk.link)
    browser.call("Page.removeScriptToEvaluateOnNewDocument", identifier=script)
    browser.wait("surefoot.tick > 100", 60)
    with Page(walk) as other:
        other.do("friction", value=0.4)
        other.wait(changed("friction"))
        browser.wait(f"{CHANGES}.length === 1")
        browser.run("window.offline = true; socket.close()")
        browser.wait("surefoot.connection === 'lost'")
        other.do("reset")
        other.status(lambda status: status["generation"] > 1 and status["time"] < 2)
        browser.run("window.offline = false")
    browser.wait("surefoot.connection === 'open' && document.querySelector('#notes').textContent.includes('Connected again')", 60)
    assert browser.run(CHANGES) == []


def test_a_speed_that_is_none_of_the_menus_is_shown_and_left_by_the_keys(browser, walk):
    show(browser, walk.link)
    speed = "document.querySelector('#speed')"
    with Page(walk) as other:
        other.do("speed", factor=3.0)
        browser.wait(f"{speed}.selectedOptions[0]?.textContent === '3×'")
    browser.press("]")
    browser.wait("surefoot.status.speed === 4")
    assert browser.run(f"[...{speed}.options].filter(one => !one.hidden).length") == len(walk.json("api/session")["limits"]["speeds"])
