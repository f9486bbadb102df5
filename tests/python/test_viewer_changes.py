"""What is changed of a run, before a page came, by another page or while it is paused, is told as it is in the run."""

import pytest

from live_page import WALK, Page, Served
from viewer_page import pause, show

NOTES = "document.querySelector('#notes').textContent"


# A page whose connection ends, and is not had again while `offline` says so.
CUT = """window.WebSocket = class extends WebSocket {
  constructor(url) { super(window.offline ? `${url}/none` : url); window.socket = this; }
};"""


@pytest.fixture
def walk():
    """Of each test its own: they count changes."""
    with Served(*WALK) as viewer:
        yield viewer


def test_a_change_by_another_page_is_told_and_a_page_that_is_opened_late_knows_that_there_was_one(browser, walk):
    again = "[...document.querySelectorAll('#panel-state dt')].find(one => one.textContent === 'Again')?.nextSibling.textContent"
    with Page(walk) as other:
        show(browser, walk.link)
        other.do("friction", value=0.4)
        browser.wait(f"/Friction .* → 0\\.4/.test({NOTES})")
    show(browser, walk.link)
    browser.wait(f"({again} ?? '').includes('without what was changed and pushed by hand')")


def test_what_is_changed_while_the_run_is_paused_waits_for_the_next_tick_and_says_so(browser, walk):
    show(browser, walk.link)
    browser.click("#tab-tune")
    pause(browser)
    browser.run("(() => { const field = document.querySelector('#friction'); field.value = 0.4; field.dispatchEvent(new Event('change')); })()")
    browser.wait(f"{NOTES}.includes('that comes with its next tick')")
    browser.press(".")
    browser.wait(f"/Friction .* → 0\\.4/.test({NOTES})")


def test_a_page_that_was_away_during_a_reset_shows_nothing_of_the_run_before(browser, walk):
    script = browser.call("Page.addScriptToEvaluateOnNewDocument", source=CUT)["identifier"]
    show(browser, walk.link)
    browser.call("Page.removeScriptToEvaluateOnNewDocument", identifier=script)
    browser.wait("surefoot.tick > 100", 60)
    with Page(walk) as other:
        other.do("friction", value=0.4)
        browser.wait("surefoot.status.changes === 1")
        browser.run("window.offline = true; socket.close()")
        browser.wait("surefoot.connection === 'lost'")
        other.do("reset")
        other.status(lambda status: status["generation"] > 1 and status["time"] < 2)
        browser.run("window.offline = false")
    browser.wait("surefoot.connection === 'open' && document.querySelector('#notes').textContent.includes('Connected again')", 60)
    browser.wait("surefoot.status.changes === 0")


def test_a_speed_that_is_none_of_the_menus_is_shown_and_left_by_the_keys(browser, walk):
    show(browser, walk.link)
    speed = "document.querySelector('#speed')"
    with Page(walk) as other:
        other.do("speed", factor=3.0)
        browser.wait(f"{speed}.selectedOptions[0]?.textContent === '3×'")
    browser.press("]")
    browser.wait("surefoot.status.speed === 4")
    assert browser.run(f"[...{speed}.options].filter(one => !one.hidden).length") == len(walk.session()["limits"]["speeds"])
