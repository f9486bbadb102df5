"""Who looks back at a live run is told so, sees where the run itself is, and changes nothing unseen."""

import pytest

from browser import wait_for
from live_page import WALK, Served
from viewer_page import SPY, VIEW_ONLY, every_look, look_back, pause, sent, show

PAST = "document.querySelector('#past').textContent"
MODE = "document.querySelector('#mode').textContent"
NOTES = "document.querySelector('#notes').textContent"


@pytest.fixture(scope="module")
def robot():
    """It stands: a push does not end the run."""
    with Served(*WALK, "--set", "planner.gait.start_duration=600") as viewer:
        yield viewer


@pytest.fixture
def page(browser, robot):
    show(browser, robot.link)
    browser.run(SPY)
    return browser


def test_the_past_is_called_so_and_says_where_the_run_is(page):
    page.wait(f"{MODE} === 'live' && {PAST} === ''")
    width = page.run("document.querySelector('#scrub').clientWidth")
    look_back(page, 2)
    said = f"Number(/^past; the run is at (\\d+\\.\\d) s$/.exec({PAST})?.[1])"
    page.wait(f"{MODE} === 'past' && Math.abs({said} - surefoot.last) < 0.3")
    assert page.run("document.querySelector('#scrub').clientWidth") == width, "the bar stands still under the pointer"
    for look in every_look(page, "past"):
        cut = "[...document.querySelectorAll('#transport > *, #transport button, #past')].filter(one => one.getBoundingClientRect().right > innerWidth).map(one => one.outerHTML)"
        assert page.run(cut) == [], look
    page.click("#go-live")
    page.wait(f"surefoot.following && {MODE} === 'live' && {PAST} === ''")


def test_the_space_bar_of_the_past_plays_what_was_and_says_so(page):
    shown = look_back(page, 3)
    label = "document.querySelector('#play').title"
    page.wait(f"{label} === 'play on from here; the run is left alone (space)'")
    page.press(" ")
    page.wait(f"surefoot.playing && surefoot.time > {shown}")
    page.wait(f"{label} === 'stop here; the run is left alone (space)'")
    page.press(" ")
    page.wait("!surefoot.playing && !surefoot.following")
    assert sent(page, "pause") == [] and sent(page, "resume") == []
    page.press("l")
    page.wait(f"{label} === 'pause the run (space)'")
    pause(page)
    page.wait(f"{MODE} === 'paused' && {label} === 'let the run go on (space)'")
    page.press(",")
    page.wait(f"{MODE} === 'past' && /^past; the run is paused at /.test({PAST})")
    page.press("l")
    page.press(" ")
    page.wait("!surefoot.status.paused")


@pytest.mark.parametrize(("key", "type"), [("p", "push"), ("x", "walk")])
def test_what_acts_on_the_run_is_seen_to_act(page, key, type):
    look_back(page, 2)
    page.press(key)
    page.wait(f"surefoot.following && {NOTES}.includes('Back to now, where that acts.')")
    wait_for(lambda: sent(page, type), "the command")
    page.press("g")


def test_a_page_that_may_not_push_stays_in_the_past(browser, robot):
    show(browser, robot.address)
    browser.wait(VIEW_ONLY)
    look_back(browser, 2)
    browser.press("p")
    browser.wait(f"{NOTES}.includes('token')")
    assert not browser.run("surefoot.following") and "Back to now" not in browser.run(NOTES)


def test_plots_go_on_with_the_run_while_one_looks_back(browser):
    with Served(*WALK) as walk:
        show(browser, walk.link)
        browser.wait("surefoot.last > 10", 60)  # all of what plots show
        look_back(browser, 3)
        before = browser.run("surefoot.last")
        browser.wait(f"surefoot.last > {before} + 4", 60)
        x, y = browser.run("(() => { const b = document.querySelector('.u-over').getBoundingClientRect(); return [b.right - 2, b.y + 10]; })()")
        browser.mouse("mousePressed", x, y)
        browser.mouse("mouseReleased", x, y)
        browser.wait("surefoot.last - surefoot.time < 2", 5)
