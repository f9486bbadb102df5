"""Keys, mouse and fingers of the viewer's page, as the browser's own input events: each does what the help says, and nothing else."""

import math
import time

import pytest

from browser import SHIFT, wait_for
from viewer_page import SCREENSHOTS, SPY, pause, phone, show, tap


@pytest.fixture
def page(browser, live):
    """The run's page, that keeps what it sends; what a test changed of it is gone afterwards."""
    show(browser, live.link)
    browser.run(SPY)
    yield browser
    browser.run("localStorage.clear()")


def camera(browser):
    return browser.run("surefoot.camera")


def distance(browser):
    return math.dist(camera(browser), browser.run("surefoot.position('base')"))


def moved(browser, before, least=0.05):
    """The camera stands elsewhere."""
    wait_for(lambda: math.dist(camera(browser), before) > least, "the camera to move")


def stand_still(browser):
    """The run is paused, and the camera has come to rest after it."""
    pause(browser)
    browser.press("f")

    def rests():
        before = camera(browser)
        time.sleep(0.3)
        return before == camera(browser)
    wait_for(rests, "the camera to rest")


def go_on(browser):
    browser.press(" ")
    browser.wait("!surefoot.status.paused")


def test_the_help_opens_and_closes_by_its_keys_and_holds_all_others_back(page):
    is_open = "document.querySelector('#help').open"
    for close in ("?", "Escape"):
        page.press("?")
        page.wait(is_open)
        for key in "wxpr":
            page.press(key)
        page.press(close)
        page.wait(f"!{is_open}")
    page.click("#help-open")
    page.wait(is_open)
    page.screenshot(SCREENSHOTS / "help.png")
    box = page.run("(() => { const b = document.querySelector('#help').getBoundingClientRect(); return [b.top, innerHeight - b.bottom, b.left]; })()")
    assert min(box) >= 0, "all of it is in the page"
    page.mouse("mousePressed", 5, 5)
    page.mouse("mouseReleased", 5, 5)  # a press beside it closes it
    page.wait(f"!{is_open}")
    assert page.run("sent") == []


def test_every_key_of_the_help_does_what_it_says(page):
    status = "surefoot.status"
    command = f"{status}.command"
    page.press("t")
    page.wait("document.documentElement.dataset.theme === 'dark'")
    page.press("t")
    for follows in ("false", "true"):
        page.press("f")
        page.wait(f"document.querySelector('#follow').getAttribute('aria-pressed') === '{follows}'")
    boxes = "[...document.querySelectorAll('#overlays input')].map(one => one.checked)"
    before = page.run(boxes)
    for expected in ([not checked for checked in before], before):
        for key in "1234567890-=o":
            page.press(key)
        wait_for(lambda: page.run(boxes) == expected, "the overlays to change")
    page.press("x")
    page.wait(f"{command}.by === 'operator' && !{command}.walk && {command}.velocity[0] === 0")
    for key, test in {"w": "velocity[0] > 0", "a": "velocity[1] > 0", "q": "yaw_rate > 0", "PageUp": "height > 0"}.items():
        page.press(key)
        page.wait(f"{command}.by === 'operator' && {command}.{test}")
    for key, test in {"s": "velocity[0] === 0", "d": "velocity[1] === 0", "e": "yaw_rate === 0", "PageDown": "height === 0"}.items():
        page.press(key)
        page.wait(f"{command}.{test}")
    page.press("x")
    page.wait(f"!{command}.walk")
    page.press("g")
    page.wait(f"{command}.by === 'scenario'")
    page.press("]")
    page.wait(f"{status}.speed === 2")
    page.press("[")
    page.wait(f"{status}.speed === 1")
    pause(page)
    assert page.run("surefoot.following && surefoot.time === surefoot.last")
    newest = page.run("surefoot.tick")
    page.press(".")
    page.wait(f"surefoot.tick === {newest + 1}")
    page.press(",")
    page.wait(f"surefoot.tick === {newest} && !surefoot.following")
    page.press("l")
    page.wait("surefoot.following")
    for key, modifiers, seconds in (("ArrowLeft", 0, 0.1), ("ArrowLeft", SHIFT, 1), ("ArrowRight", 0, 0.1)):
        shown = page.run("surefoot.time")
        page.press(key, modifiers=modifiers)
        page.wait(f"Math.abs(Math.abs(surefoot.time - {shown}) - {seconds}) < 1e-6")
    page.press("l")
    page.press("p")
    page.press("r")
    page.wait(f"surefoot.tick <= 1 && {status}.paused", 60)
    assert [one["type"] for one in page.run("sent") if one["type"] in ("push", "reset")] == ["push", "reset"]
    go_on(page)


def test_keys_that_are_typed_into_a_field_are_no_commands(page):
    page.click("#tab-tune")
    page.run("document.querySelector('#channel-search').focus()")
    for key in "wasdxpr ?":
        page.press(key)
    page.wait("document.querySelector('#channel-search').value === 'wasdxpr ?'")
    assert page.run("sent") == [] and not page.run("document.querySelector('#help').open")


@pytest.mark.parametrize(("given", "why"), [("", "was no number"), ("-5", "can't be −5 N·s, its direction is chosen below"), ("0", "can't be 0 N·s, its direction is chosen below")])
def test_a_push_of_no_size_is_told_and_nothing_is_sent(page, given, why):
    page.run(f"sent.length = 0; document.querySelector('#tab-drive').click(); document.querySelector('#push-impulse').value = '{given}'")
    page.click("#push")
    page.wait(f"document.querySelector('#notes').textContent.includes(\"No push: its impulse {why}. It is 15 N·s again.\")")
    assert page.run("document.querySelector('#push-impulse').value") == "15"
    assert not [one for one in page.run("sent") if one["type"] == "push"]


def test_the_mouse_turns_moves_and_zooms_the_view_and_home_brings_it_back(page):
    stand_still(page)
    x, y = page.middle("#canvas")
    corner = (x - 250, y + 120)  # of the ground, beside the robot
    first = camera(page)
    page.stroke(corner, (corner[0] + 90, corner[1]))
    moved(page, first)
    turned = distance(page)
    page.wheel(*corner, -300)
    wait_for(lambda: distance(page) < 0.95 * turned, "the zoom")
    before = camera(page)
    page.stroke(corner, (corner[0] + 90, corner[1]), button="right")
    moved(page, before)
    page.press("h")
    wait_for(lambda: math.dist(camera(page), first) < 0.05, "the first view")
    go_on(page)


def test_a_level_is_moved_by_its_buttons_and_the_note_says_what_moved(page):
    names = "surefoot.levels().map(one => one.name)"
    order = page.run(names)
    lowest, place = order[-1], len(order)
    page.run(f"document.querySelectorAll('.level[data-level={lowest}] .movers button')[0].click()")
    page.wait(f"[...document.querySelectorAll('.note')].some(one => one.textContent.includes('rder: {lowest} from {place} to {place - 1}'))", 60)
    expected = [*order[:-2], lowest, order[-2]]
    wait_for(lambda: page.run(names) == expected, "the new order", 60)
    page.run(f"document.querySelectorAll('.level[data-level={lowest}] .movers button')[1].click()")
    wait_for(lambda: page.run(names) == order, "the order that was", 60)


def test_a_level_that_keeps_the_physics_stays_above_the_others_and_the_page_says_why(page):
    page.run("document.querySelectorAll('.level[data-level=com_xy] .movers button')[0].click()")
    page.wait("[...document.querySelectorAll('.note.error')].some(one => one.textContent.includes('keeps the physics'))")


def test_steering_by_keys_is_told_in_one_note_that_renews_itself(page):
    notes = "[...document.querySelectorAll('.note')].filter(one => one.textContent.includes('commands')).map(one => one.textContent)"
    page.press("x")
    for steps in range(1, 7):
        page.press("w")
        page.wait(f"Math.abs(surefoot.status.command.velocity[0] - 0.01 * {steps}) < 1e-9")
    wait_for(lambda: any("(0.06, 0)" in note for note in page.run(notes)), "the note of the last step")
    assert len(page.run(notes)) == 1
    page.press("g")
    page.wait("surefoot.status.command.by === 'scenario'")
    wait_for(lambda: any("The scenario commands" in note for note in page.run(notes)), "the note of who commands now")
    assert len(page.run(notes)) == 1


def test_buttons_that_move_a_level_hide_nothing_that_it_says(page):
    hidden = """(() => { const level = document.querySelector('[data-level=torso_yaw]'), a = level.querySelector('.movers').getBoundingClientRect();
      const texts = [...level.querySelectorAll('.sign, .level-name, .residual, .status, .brief, .level-time')].filter(one => one.textContent !== '');
      return [a.width > 0, texts.filter(one => { const b = one.getBoundingClientRect(); return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom; })
        .map(one => one.className)]; })()"""
    x, y = page.middle("[data-level=torso_yaw]")
    page.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
    page.wait(f"{hidden}[0]")
    assert page.run(hidden) == [True, []]
    page.call("Input.dispatchMouseEvent", type="mouseMoved", x=1, y=1)


def test_a_bound_that_no_leg_reaches_is_refused_in_words(page):
    page.click("#tab-tune")
    field = "document.querySelector('[data-gain=\"limb_extension_limits.limb_extension_limits.max\"]')"
    before = page.run(f"{field}.value")
    page.run(f"{field}.value = '5.2'; {field}.dispatchEvent(new Event('change'))")
    page.wait("[...document.querySelectorAll('.note.error')].some(one => one.textContent.includes('limb_extension_limits max is 5.2 m; valid is 0 to 0.571 m'))")
    page.wait(f"{field}.value === '{before}'")


def test_two_fingers_zoom_the_picture_and_one_scrubs(browser, live):
    with phone(browser):
        show(browser, live.link)
        stand_still(browser)
        x, y = browser.middle("#canvas")
        far = distance(browser)
        browser.touch([(x - 20 - 12 * step, y) for step in range(6)], [(x + 20 + 12 * step, y) for step in range(6)])
        wait_for(lambda: distance(browser) < 0.9 * far, "the picture to come nearer")
        assert browser.run("[document.documentElement.scrollWidth, visualViewport.scale]") == [390, 1], "the page itself does not zoom"
        newest = browser.run("surefoot.time")
        x, y = browser.middle("#scrub")
        browser.touch([(x + 60 - 20 * step, y) for step in range(6)])
        browser.wait(f"!surefoot.following && surefoot.time < {newest}")
        tap(browser, "#go-live")
        browser.wait("surefoot.following")
        go_on(browser)
