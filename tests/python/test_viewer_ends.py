"""How a run ended is told whole, live and in its log, and marked on the time bar."""

import time

from conftest import HIT
from live_page import WALK, Page, Served
from viewer_page import SPY, every_look, scrub, sent, show

FACTS = "document.querySelector('#head-facts')"
MODE = "document.querySelector('#mode').textContent"
ENDED = "[...document.querySelectorAll('#panel-state dt')].find(one => one.textContent === 'Ended')?.nextSibling.textContent"
HINT = "document.querySelector('.mark-hint:not([hidden])')?.textContent ?? ''"


def point_at_the_end(browser):
    x, y, width = browser.run("(() => { const b = document.querySelector('.marks').getBoundingClientRect(); return [b.x, b.y + 5, b.width]; })()")
    browser.mouse("mouseMoved", x + width - 1, y)


def test_why_a_live_run_has_ended_is_told_whole(browser):
    with Served("run", "push", "--view", "--set", "duration=6", *HIT) as viewer, Page(viewer) as page:
        show(browser, viewer.link)
        why = page.status(lambda status: status["ended"] is not None, 120)["ended"]
        browser.wait(f"document.querySelector('#mode').textContent === 'ended' && {FACTS}.textContent.includes('ended: {why}')", 60)
        browser.wait(f"{FACTS}.title === {FACTS}.textContent && {ENDED} === '{why}'")
        assert browser.run(f"{FACTS}.scrollHeight <= {FACTS}.clientHeight + 1"), "at 1280 pixels all of it is seen"
        point_at_the_end(browser)
        browser.wait(f"({HINT}).includes('ended: {why}')")
        browser.click("#tab-hierarchy")
        for _ in every_look(browser, "ended"):
            pass
        browser.press("r")
        browser.wait(f"surefoot.status.ended === null && {ENDED} === 'not yet'", 60)


def test_a_log_tells_how_its_run_ended_and_marks_a_stop(browser, stopped, log):
    with Served("replay", stopped) as replay:
        why = replay.session()["ended"]
        assert why.startswith("the controller stopped for safety at ")
        show(browser, replay.link)
        browser.wait(f"{FACTS}.textContent.includes('ended: {why}') && {ENDED} === '{why}'")
        assert browser.run(f"[...{FACTS}.querySelectorAll('strong')].map(one => [one.textContent, one.dataset.weight])") == [[f"ended: {why}", "grave"]]
        browser.wait("document.querySelector('#plots-progress').textContent === ''", 60)
        point_at_the_end(browser)
        browser.wait(f"({HINT}).includes('ended: {why}')")
        for _ in every_look(browser, "log_of_a_stop"):
            pass
    with Served("replay", log) as replay:
        show(browser, replay.link)
        browser.wait(f"{ENDED} === 'ran to its end'")


def test_a_stop_for_safety_is_no_good_news(browser, stopped):
    with Served("replay", stopped) as replay:
        show(browser, replay.link)
        scrub(browser, "scrub.max")
        account = "No hierarchy was solved: \\w+, because "
        browser.wait(f"surefoot.channel('command.mode')[0] > 1 && /^{account}/.test(document.querySelector('#account').innerText)", 30)
        browser.wait("document.querySelector('#account').dataset.kind === 'bad'")


def test_a_run_that_has_ended_has_nothing_to_pause_and_stays_ended_when_its_program_is_gone(browser):
    with Served("run", "push", "--view", "--set", "duration=2") as viewer, Page(viewer) as page:
        show(browser, viewer.link)
        browser.run(SPY)
        why = page.status(lambda status: status["ended"] is not None, 120)["ended"]
        browser.wait(f"{MODE} === 'ended' && document.querySelector('#play').disabled && document.querySelector('#play').title.startsWith('the run has ended')", 60)
        assert browser.run("document.querySelector('#go-live').textContent") == "The end"
        for key in " .":
            browser.press(key)
        browser.wait("document.querySelector('#notes').textContent.includes('nothing to pause')")
        assert [one for kind in ("pause", "resume", "step") for one in sent(browser, kind)] == []
        viewer.process.kill()
        browser.wait("document.querySelector('#link-state').textContent === 'connection lost'", 60)
        time.sleep(0.5)
        assert browser.run(f"[{MODE}, {ENDED}]") == ["ended", why]


def test_of_a_run_that_has_not_ended_nobody_knows_how_it_goes_on_when_its_program_is_gone(browser):
    with Served(*WALK) as viewer:
        show(browser, viewer.link)
        browser.wait(f"{MODE} === 'live' && {ENDED} === 'not yet'")
        viewer.process.kill()
        browser.wait(f"{MODE} === 'not known' && {ENDED} === 'not known'", 60)
        browser.wait("document.querySelector('#play').disabled && document.querySelector('#play').title.startsWith('the program says nothing')")
        assert browser.run("document.querySelector('#go-live').textContent") == "Newest"
        for look in every_look(browser, "lost"):
            assert browser.run("document.querySelector('#mode').getBoundingClientRect().right <= innerWidth && document.documentElement.scrollWidth <= innerWidth"), look
