"""The viewer's page under fingers: nothing is covered, nothing too small, nothing only where a pointer hovers."""

import pytest

from damaged_logs import damaged
from live_page import WALK, Served
from viewer_page import SCREENSHOTS, phone, show, tap

LEAST = 40  # of what a finger presses [pixels]
TABS = ("hierarchy", "state", "drive", "tune")
# Buttons and fields that are seen, with the size of what can be pressed: of a box with a text beside it both.
SMALL = """[...document.querySelectorAll('button, select, input')].filter(one => one.offsetParent !== null).map(one => {
  const box = (one.closest('.overlay-line') ?? one).getBoundingClientRect();
  return [box.width, box.height, one.outerHTML.slice(0, 80)];
}).filter(([width, height]) => width < %d || height < %d)""" % (LEAST, LEAST)
# Of what overlaps in the picture: messages and the buttons over it.
COVERED = """(() => {
  const boxes = query => [...document.querySelectorAll(query)].filter(one => one.offsetParent !== null).map(one => [one.textContent, one.getBoundingClientRect()]);
  return boxes('.note').flatMap(([note, a]) => boxes('#view-tools button')
    .filter(([, b]) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom).map(([button]) => [note, button]));
})()"""


def test_all_that_is_pressed_is_large_enough_for_a_finger(browser, live):
    with phone(browser):
        show(browser, live.link)
        for name in TABS:
            tap(browser, f"#tab-{name}")
            assert browser.run(SMALL) == [], name
        tap(browser, "#overlays-open")
        assert browser.run(SMALL) == [], "overlays"


def test_nothing_covers_the_tabs_and_what_is_scrolled_to(browser, live):
    with phone(browser):
        show(browser, live.link)
        tap(browser, "#tab-tune")
        last = "[...document.querySelectorAll('[data-gain]')].at(-1)"
        for one in (last, "document.querySelector('#friction')", "document.querySelector('#tab-state')", "document.querySelector('#channel-search')"):
            browser.run(f"{one}.scrollIntoView({{ block: 'start' }})")
            assert browser.run(f"(() => {{ const b = {one}.getBoundingClientRect(); return {one}.contains(document.elementFromPoint(b.x + b.width / 2, b.y + b.height / 2)); }})()"), one
        browser.run(f"{last}.scrollIntoView({{ block: 'start' }})")
        assert browser.run("document.querySelector('#main').scrollTop") > 1000
        top = "document.querySelector('#view').getBoundingClientRect().top - document.querySelector('#main').getBoundingClientRect().top"
        assert abs(browser.run(top)) <= 8, "the picture stays"
        tap(browser, "#tab-hierarchy")  # and so do the tabs


def test_what_a_pointer_would_be_told_of_a_number_stands_beside_it(browser, live):
    with phone(browser):
        show(browser, live.link)
        tap(browser, "#tab-tune")
        field = "document.querySelector('[data-gain=\"com_xy.com_xy.kp\"]')"
        assert browser.run(f"{field}.closest('label').innerText.includes({field}.title)")


@pytest.mark.parametrize("seen", ["phone", "desktop", "tablet"])
def test_what_is_wrong_with_a_log_covers_no_button_and_can_be_taken_away(browser, log, tmp_path, seen):
    with Served("replay", damaged(log, tmp_path, 0.3)) as viewer, phone(browser):
        if seen != "phone":
            browser.resize({"desktop": 1280, "tablet": 820}[seen], 720)
        show(browser, viewer.link)
        note = "document.querySelector('[data-note=damage]')"
        browser.wait(f"{note} !== null", 60)
        text = browser.run(f"{note}.querySelector('.note-text').textContent")
        assert text.startswith("This log is damaged, the rest of it can be seen: ") and text.count("can't be read") == 1
        assert browser.run(COVERED) == []
        browser.screenshot(SCREENSHOTS / f"damaged_{seen}.png")
        browser.wait("document.querySelector('#plots-progress').textContent === ''", 60)
        begin = float(text.split("seen: ")[1].split(" s")[0])
        x, y, width = browser.run("(() => { const b = document.querySelector('.marks').getBoundingClientRect(); return [b.x, b.y + 3, b.width]; })()")
        browser.mouse("mouseMoved", x + width * begin / browser.run("surefoot.last"), y)
        hint = "document.querySelector('.mark-hint:not([hidden])')"
        told = browser.wait(f"{hint}?.textContent")
        assert told.startswith(f"{begin:.4f} s to ") and told.count(f"{begin:.4f} s") == 1
        left, right = browser.run(f"(() => {{ const b = {hint}.getBoundingClientRect(); return [b.left, innerWidth - b.right]; }})()")
        assert min(left, right) >= 0
        tap(browser, "[data-note=damage] .close")
        browser.run("new Promise(done => setTimeout(done, 1000))")  # longer than the page waits to look again
        assert browser.run(note) is None


def test_the_key_stands_below_the_picture(browser, live):
    with phone(browser):
        show(browser, live.link)
        bottom, top, end, view = browser.run("""(() => {
          const box = query => document.querySelector(query).getBoundingClientRect();
          return [box('#canvas').bottom, box('#legend').top, box('#legend').bottom, box('#view').bottom];
        })()""")
        assert bottom <= top < end <= view
        browser.screenshot(SCREENSHOTS / "phone_key.png")


def test_the_head_keeps_its_line_when_the_connection_is_lost(browser):
    with phone(browser):
        with Served(*WALK) as walk:
            show(browser, walk.link)
        browser.wait("document.querySelector('#link-state').textContent === 'connection lost'", 30)
        browser.run("document.querySelector('#title').textContent = 'payload_step_down_without_limits, seed 12345'")
        tops = browser.run("[...document.querySelectorAll('#head > :is(h1, .badge:not(:empty), button)')].map(one => { const b = one.getBoundingClientRect(); return [b.top, b.bottom, b.right]; })")
        assert max(top for top, _, _ in tops) < min(bottom for _, bottom, _ in tops), "one line"
        assert max(right for _, _, right in tops) <= 390
        browser.screenshot(SCREENSHOTS / "phone_lost.png")
