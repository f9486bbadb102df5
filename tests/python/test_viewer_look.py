"""How the viewer's page looks to its reader: nothing covers, cuts or contradicts something else, and what is old says so."""

import math
import re
import time

import numpy as np
import pytest

from conftest import record
from damaged_logs import without_calls
from live_page import WALK, Served
from viewer_page import SCREENSHOTS, SIZES, channel, every_look, go_to, pause, pixels, scrub, show, step_until


def push_until_it_falls(browser):
    browser.click("#tab-drive")
    browser.run("document.querySelector('#push-impulse').value = 60; document.querySelector('#push-duration').value = 0.2;"
                "document.querySelector('#push').click()")
    browser.wait("surefoot.status.ended !== null", 120)


def test_after_a_fall_what_is_said_is_short_and_more_of_it_when_asked_for(browser):
    with Served(*WALK) as walk:
        show(browser, walk.link)
        browser.wait("surefoot.tick > 100", 60)
        push_until_it_falls(browser)
        browser.click("#tab-hierarchy")
        note = "document.querySelector('.note.error')"
        for look in every_look(browser, "fall"):
            for _ in range(4):
                browser.press("p")  # refused: the run has ended
            browser.wait(f"{note}?.textContent.includes('The run has ended')")
            heights = "[document.querySelector('#account'), document.querySelector('.note.error')].map(one => one.offsetHeight)"
            account, message = browser.run(heights)
            assert account < 48 and message < 84, look  # two lines, and four
            cut = "[...document.querySelectorAll('.account-line, .facts')].filter(one => one.scrollWidth > one.clientWidth || one.scrollHeight > one.clientHeight + 1)"
            assert browser.run(f"{cut}.map(one => one.textContent)") == [], look
        browser.press("p")
        browser.wait(f"{note} !== null")
        browser.run(f"{note}.querySelector('button').click()")
        words = f"{note}.querySelector('.note-text')"
        assert browser.run(f"{words}.scrollHeight <= {words}.clientHeight + 1"), "all of it"
        browser.run(f"{note}.querySelector('button').click()")
        browser.wait(f"{note} === null")


def test_what_a_message_tells_to_do_is_read_without_a_press(browser, log):
    with Served("replay", log) as replay:
        show(browser, replay.link)
    words = "document.querySelector('[data-note=server] .note-text')"
    for look in every_look(browser, "lost"):
        browser.wait(f"{words} !== null")
        assert browser.run(f"[{words}.scrollHeight <= {words}.clientHeight + 1, {words}.textContent.includes('surefoot replay')]") == [True, True], look


def test_no_label_of_the_picture_covers_another(browser, live):
    show(browser, live.link)
    browser.wait("surefoot.tick > 400", 60)
    browser.press("9")  # lengths of the legs, beside the forces
    browser.wait("document.querySelectorAll('.label.limb:not([hidden])').length > 2")
    covered = """(() => {
      const boxes = [...document.querySelectorAll('.label:not([hidden])')].map(one => [one.textContent, one.getBoundingClientRect()]);
      return boxes.flatMap(([text, a], k) => boxes.slice(k + 1).filter(([, b]) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom)
        .map(([other]) => [text, other]));
    })()"""
    for _ in range(8):  # of a walk, so that feet pass by each other
        picture = browser.run("surefoot.pictures")
        browser.wait(f"surefoot.pictures > {picture}")
        assert browser.run(covered) == []
    pause(browser)
    for look in every_look(browser, "labels"):
        assert browser.run(covered) == [], look
    browser.press(" ")


def test_names_of_the_levels_are_whole_and_all_levels_are_seen(browser, live):
    show(browser, live.link)
    browser.wait("document.querySelectorAll('.level').length === 11")
    cut = "[...document.querySelectorAll('.level-name')].filter(one => one.scrollWidth > one.clientWidth).map(one => one.textContent)"
    for look in every_look(browser, "levels"):
        assert browser.run(cut) == [], look
        if "desktop" in look:
            assert browser.run("(() => { const p = document.querySelector('#panels'); return p.scrollHeight - p.clientHeight; })()") <= 0, look
    heights = browser.run("[...document.querySelectorAll('.level:not(.held)')].map(one => one.offsetHeight)")
    assert len(set(heights)) == 1, "whatever a level says"
    held = "[...document.querySelectorAll('.held .brief')].filter(one => one.scrollWidth > one.clientWidth || one.scrollHeight > one.clientHeight + 1).map(one => one.textContent)"
    assert browser.run(held) == [], "who holds a level back is told whole"
    browser.run("document.querySelector('.level .level-name').click()")
    assert "degrees of freedom to the levels below" in browser.run("document.querySelector('.level.open').innerText")


def test_the_account_agrees_with_the_levels(browser, live):
    show(browser, live.link)
    said = """(() => [document.querySelector('#account').innerText, document.querySelector('#account').dataset.kind,
      [...document.querySelectorAll('.level:is(.held, [data-status=gives-way])')].map(one => one.innerText)])()"""
    for _ in range(10):
        picture = browser.run("surefoot.pictures")
        browser.wait(f"surefoot.pictures > {picture}")
        line, kind, held = browser.run(said)
        assert (kind == "good" and "Every level gets what it asks for" in line) == (held == []), (line, held)


def test_what_gives_way_is_told_whole(browser, log):
    """Whatever the line says, with the longest names of levels that there are."""
    line = "document.querySelector('.account-line')"
    with Served("replay", log) as replay:
        show(browser, replay.link)
        go_to(browser, 400)
        for look in every_look(browser, "account"):
            browser.run(f"{line}.textContent = 'contact force minimisation gives way to limb extension limits and joint position limits.'")
            whole = f"[{line}.scrollWidth <= {line}.clientWidth, {line}.scrollHeight <= {line}.clientHeight + 1, getComputedStyle({line}).textOverflow]"
            assert browser.run(whole) == [True, True, "clip"], look


def test_the_menu_of_overlays_is_whole_and_closes_by_escape_and_by_a_press_elsewhere(browser, live):
    show(browser, live.link)
    menu = "document.querySelector('#overlays')"
    is_open = f"({menu}.checkVisibility() && document.querySelector('#overlays-open').getAttribute('aria-expanded') === 'true')"
    for width, height in ((1280, 720), (1280, 400), (844, 390), (390, 844)):
        browser.resize(width, height)
        browser.wait(f"innerHeight === {height}")
        browser.click("#overlays-open")
        browser.wait(is_open)
        top, bottom, room, all_of_it = browser.run(f"(() => {{ const b = {menu}.getBoundingClientRect(); return [b.top, innerHeight - b.bottom, {menu}.clientHeight, {menu}.scrollHeight]; }})()")
        assert min(top, bottom) >= 0 and room >= min(all_of_it, 0.5 * height), (width, height)
        browser.run("document.querySelector('#overlays label:last-of-type').scrollIntoView()")
        hit = "(() => { const one = [...document.querySelectorAll('#overlays label')].at(-1), b = one.getBoundingClientRect(); return one.contains(document.elementFromPoint(b.x + 30, b.y + b.height / 2)); })()"
        assert browser.run(hit), (width, height)
        browser.screenshot(SCREENSHOTS / f"overlays_{width}x{height}.png")
        browser.press("Escape")
        browser.wait(f"!{is_open}")
        browser.click("#overlays-open")
        browser.wait(is_open)
        browser.click("#title")  # a press elsewhere
        browser.wait(f"!{is_open}")
        browser.click("#overlays-open")
        browser.wait(is_open)
        browser.click("#overlays-open")
        browser.wait(f"!{is_open}")
    browser.resize(*SIZES["desktop"])


def test_the_menu_of_overlays_leaves_the_robot_in_sight(browser, live):
    show(browser, live.link)
    browser.click("#overlays-open")
    box = "(name => { const b = document.querySelector(name).getBoundingClientRect(); return [b.right, b.bottom]; })"
    (right, bottom), (_, below) = browser.wait(f"document.querySelector('#overlays').checkVisibility() && ['#overlays', '#view'].map({box})")
    assert right < browser.run("surefoot.place(surefoot.position('base'))")[0] - 100 and bottom < below
    assert browser.run("[...document.querySelectorAll('.overlay-line')].every(one => one.title !== '')"), "what each of them is, is told to the pointer"
    browser.press("Escape")


def test_the_menu_of_overlays_changes_no_more_of_the_picture_than_it_covers(browser, log):
    """Chromium laid the menu's ground over the picture above it where the processor draws."""
    with Served("replay", log) as replay:
        show(browser, replay.link)
        browser.prefer("dark")
        try:
            go_to(browser, 400)
            browser.wait("surefoot.meshesLoading === 0", 60)
            time.sleep(2)  # the camera comes to rest
            before = pixels(browser.screenshot())
            browser.click("#overlays-open")
            browser.wait("document.querySelector('#overlays').checkVisibility()")
            time.sleep(0.5)
            after = pixels(browser.screenshot(SCREENSHOTS / "overlays_dark.png"))
            left, top, right, bottom = (round(one) for one in browser.run("(() => { const b = document.querySelector('#overlays').getBoundingClientRect(); return [b.left, b.top, b.right, b.bottom]; })()"))
            browser.press("Escape")
        finally:
            browser.prefer("light")
        changed = np.abs(after - before).max(axis=2) > 8
        above, view_top = changed[:, left + 240 : right + 60], browser.run("Math.round(document.querySelector('#view').getBoundingClientRect().top)")
        assert np.mean(above[view_top + 2 : top - 30]) < 0.05, "beside the buttons"


def test_no_label_lies_under_a_message(browser, live):
    show(browser, live.link)
    pause(browser)
    high = "(([x, y]) => x > 460 && y < 330)"
    middles = "[...document.querySelectorAll('.label:not([hidden])')].map(one => { const b = one.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })"
    step_until(browser, f"{middles}.some({high})", "a label there", 400)
    under = """(() => { const note = document.querySelector('#tall').getBoundingClientRect(); return [...document.querySelectorAll('.label:not([hidden])')].filter(one => {
      const b = one.getBoundingClientRect(); return b.left < note.right && note.left < b.right && b.top < note.bottom && note.top < b.bottom; }).map(one => one.textContent); })()"""
    browser.run("""(() => { const note = document.createElement('p'); note.id = 'tall'; note.className = 'note'; note.style.cssText = 'width: 420px; height: 290px';
      document.querySelector('#notes').append(note); })()""")
    picture = browser.run("surefoot.pictures")
    browser.press(".")
    browser.wait(f"surefoot.pictures > {picture} + 1")
    browser.wait(f"{under}.length === 0 && document.querySelectorAll('.label:not([hidden])').length > 0")
    browser.screenshot(SCREENSHOTS / "labels_and_message.png")
    browser.run("document.querySelector('#tall').remove()")
    browser.press(" ")


def test_a_panel_opens_at_its_top_and_one_that_was_left_where_it_was(browser, live):
    show(browser, live.link)
    browser.click("#tab-tune")
    scrolled = "document.querySelector('#panels').scrollTop"
    browser.run(f"{scrolled} = 300")
    browser.click("#tab-state")
    browser.wait(f"{scrolled} === 0")
    browser.click("#tab-tune")
    browser.wait(f"{scrolled} === 300")


def test_meshes_that_are_still_to_come_are_counted(browser, live):
    browser.open("about:blank")
    browser.open(live.link)
    text = browser.wait("document.querySelector('#loading')?.textContent || undefined", 60)
    here, count = map(int, re.fullmatch(r"Loading meshes: (\d+) of (\d+) are here", text).groups())
    assert 0 <= here < count
    browser.wait("surefoot.meshesLoading === 0 && document.querySelector('#loading').textContent === ''", 60)


def test_the_clock_of_a_log_ends_at_its_total(browser, log):
    with Served("replay", log) as replay:
        show(browser, replay.link)
        scrub(browser, "scrub.max")
        browser.wait("surefoot.time === surefoot.last")
        browser.wait("/^(\\d+\\.\\d+) \\/ \\1 s$/.test(document.querySelector('#clock').textContent)")


def test_a_log_whose_clock_begins_late_begins_there(browser, log, tmp_path):
    with Served("replay", without_calls(log, tmp_path, 200, -1)) as replay:
        session = replay.session()
        first, end = session["first_tick"], session["first_tick"] + session["ticks"]
        assert first == 200 and end > 600
        show(browser, replay.link)
        assert browser.run("[surefoot.first, surefoot.last]") == pytest.approx([0.0025 * first, 0.0025 * (end - 1)])
        assert browser.run("Number(document.querySelector('#scrub').min)") == pytest.approx(0.5)
        go_to(browser, first)
        go_to(browser, end - 1)


def test_friction_that_a_foot_lost_is_not_the_friction_that_was_asked_for(browser):
    with Served("run", "slippery", "--view", "--set", "duration=600") as slippery:
        show(browser, slippery.link)
        given = slippery.session()["friction"]
        browser.click("#tab-tune")
        least = "Math.min(...['LF', 'RF', 'LH', 'RH'].map(leg => surefoot.channel(`plan.feet.${leg}.friction`)[0]))"
        browser.wait(f"{least} < {given} - 0.02", 120)
        browser.wait("document.querySelector('#friction-belief').textContent.includes('after slips')")
        assert float(browser.run("document.querySelector('#friction').value")) == given
        pause(browser)
        for _ in every_look(browser, "tune"):
            pass


def test_what_is_old_is_grey_and_says_since_when(browser):
    with Served(*WALK) as walk:
        show(browser, walk.link)
        port = walk.port
        assert not browser.run("document.body.classList.contains('stale')")
    browser.wait("/^Nothing new for [1-9]\\d* s: all numbers are from \\d+\\.\\d+ s of the run\\.$/.test(document.querySelector('#stale').textContent)")
    scrub(browser, "0.5 * (surefoot.first + surefoot.last)")
    browser.wait("surefoot.drawn < surefoot.last - 0.01 && document.querySelector('#stale').textContent.includes(`from ${surefoot.drawn.toFixed(4)} s of`)")
    assert "grayscale" in browser.run("getComputedStyle(document.querySelector('#panel-hierarchy')).filter")
    for _ in every_look(browser, "stale"):
        pass
    with Served(*WALK, port=port):
        browser.wait("window.surefoot?.tick > 0 && !document.body.classList.contains('stale') && document.querySelector('#stale').hidden", 60)


@pytest.mark.parametrize("silent", ["window.fetch = () => new Promise(() => {})", "window.WebSocket = class {}"])
def test_a_program_that_has_not_answered_yet_is_told_at_once_and_then_what_to_look_at(browser, live, silent):
    script = browser.call("Page.addScriptToEvaluateOnNewDocument", source=silent)["identifier"]
    try:
        browser.open("about:blank")
        browser.open(live.link)
        browser.wait("document.querySelector('#link-state')?.textContent === 'connecting'")
        assert browser.run("document.querySelector('#stale:not([hidden])').textContent") == "Connecting to the program …"
        browser.wait("/^no answer for \\d+ s$/.test(document.querySelector('#link-state').textContent)")
        browser.wait("document.querySelector('#notes').textContent.includes('Look in its terminal')")
        browser.screenshot(SCREENSHOTS / "silent.png")
    finally:
        browser.call("Page.removeScriptToEvaluateOnNewDocument", identifier=script)


def test_numbers_are_never_newer_than_the_picture(browser, live):
    show(browser, live.link)
    browser.click("#tab-state")
    seen = browser.run("""new Promise(done => {
      const seen = [];
      const look = () => {
        const [state, clock] = ['#state dd', '#clock'].map(one => parseFloat(document.querySelector(one).textContent));
        seen.push([surefoot.drawn, state, clock]);
        if (seen.length < 60) setTimeout(look, 20); else done(seen);
      };
      look();
    })""")
    assert len({drawn for drawn, *_ in seen}) > 1, "it goes on"
    newer = [(drawn, told) for drawn, *both in seen for told in both if told > drawn + 6e-5]  # rounded
    assert newer == []
    browser.click("#tab-hierarchy")


def test_what_lies_on_the_believed_ground_is_seen_where_the_true_ground_is_higher(browser, tmp_path):
    log = record(tmp_path / "down.mcap", "--set", "estimation=truth", scenario="step_down", duration=16.5)
    with Served("replay", log) as viewer:
        show(browser, viewer.link)
        go_to(browser, 6400)  # a front foot is down, the others are above the edge
        browser.wait("surefoot.meshesLoading === 0", 60)
        time.sleep(2)  # the camera comes to rest
        contacts = [channel(browser, f"truth.feet.{leg}.point") for leg in ("LF", "RF", "LH", "RH")]
        middle = [sum(one) / 4 for one in zip(*contacts)]
        assert browser.run(f"surefoot.ground({middle[0]}, {middle[1]})") > middle[2] + 0.02, "it lies in the ground"
        for key, place in (("3", middle), ("5", planned_zmp(browser, viewer))):
            shown = pixels_about(browser, place)
            browser.press(key)
            time.sleep(1)
            hidden = pixels_about(browser, place)
            browser.press(key)
            changed = sum(math.dist(one, other) > 15 for one, other in zip(shown, hidden))
            assert changed >= 3, (key, shown, hidden)


def pixels_about(browser, place):
    """A mark is a line of a few pixels: where it lies to the pixel hangs on the camera."""
    x, y, z = place
    steps = [0.008 * k for k in range(-3, 4)]
    return [browser.run(f"surefoot.pixel([{x + dx}, {y + dy}, {z}])") for dx in steps for dy in steps]


def planned_zmp(browser, viewer):
    """The middle of its mark, where the controller believes what is true."""
    assert math.dist(channel(browser, "state.p_WB"), channel(browser, "truth.p_SB")) < 1e-3
    (x, y), R, point = (channel(browser, f"plan.{name}") for name in ("com.zmp", "R_WC", "terrain_point"))
    radius = viewer.session()["header"]["robot"]["foot_radius"]
    return [x, y, point[2] - (radius + R[2] * (x - point[0]) + R[5] * (y - point[1])) / R[8]]
