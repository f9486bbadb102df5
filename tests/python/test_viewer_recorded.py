"""The viewer's page of runs that are recorded, and of logs: any time of them is shown, and what can't be is told."""

import itertools
import json
import math
import time

from browser import wait_for
from damaged_logs import damaged, without_chunk
from live_page import WALK, Page, Served
from viewer_page import SCREENSHOTS, channel, go_to, pause, scrub, show


def recorded_base(path, tick):
    """Where the log says that the base is at a tick, in truth."""
    from mcap.reader import make_reader

    with open(path, "rb") as file:
        messages = make_reader(file).iter_messages(topics=["/truth"])
        return json.loads(next(itertools.islice(messages, tick, None))[2].data)["p_SB"]


def test_a_page_that_is_opened_late_scrubs_back_to_before_it_came(browser, tmp_path):
    with Served(*WALK, "--record", tmp_path / "run.mcap") as walk:
        with Page(walk) as first:  # eight times as fast, so that a minute has passed soon
            first.do("speed", factor=8.0)
            browser.open("about:blank")
            wait_for(lambda: first.status()["time"] > 60, "a minute of the run", 300)
            first.do("speed", factor=1.0)
        show(browser, walk.link)
        assert browser.run("surefoot.first") < 0.01
        begin = browser.run("surefoot.last")
        scrub(browser, begin - 50)
        browser.wait(f"Math.abs(surefoot.time - {begin - 50}) < 0.2 && surefoot.channel('truth.p_SB') !== undefined"
                     " && Math.abs(surefoot.drawn - surefoot.time) < 0.003", 30)
        tick, position, shown = browser.run("[surefoot.tick, surefoot.position('base'), surefoot.channel('truth.p_SB')]")
        browser.screenshot(SCREENSHOTS / "late.png")
        browser.press("l")
        browser.wait("surefoot.following && surefoot.last - surefoot.time < 0.5")
        pause(browser)
        complaints = [text for kind, text in browser.console if kind == "error"]
    assert math.dist(position, shown) < 1e-5
    assert abs(tick * 0.0025 - (begin - 50)) < 0.2
    assert math.dist(shown, recorded_base(tmp_path / "run.mcap.partial", tick)) < 1e-5
    assert complaints == [] and any(url.endswith("/api/events") for url in browser.requests)


def drawn_no_more(browser):
    """How many pictures there were, once none has come for three seconds."""
    before = browser.run("surefoot.pictures")
    time.sleep(3)
    return before if browser.run("surefoot.pictures") == before else None


def test_a_page_of_a_recorded_run_says_where_its_log_is(browser, tmp_path):
    log = "[...document.querySelectorAll('#panel-state dt')].find(one => one.textContent === 'Log')?.nextSibling.textContent"
    with Served(*WALK) as walk:
        show(browser, walk.link)
        browser.wait(f"{log} === 'none: run it with --record FILE to keep one'")
    kept = tmp_path / "kept.mcap"
    with Served("run", "walk_flat_ideal", "--view", "--set", "duration=1", "--record", kept) as recorded, Page(recorded) as hand:
        hand.do("pause")
        show(browser, recorded.address)
        browser.wait("document.querySelector('#head-facts').textContent.startsWith('recording kept.mcap')")
        browser.wait(f"{log} === 'goes into {kept}.partial, which is called {kept} when the run has ended'")
        browser.press(" ")
        browser.wait("!surefoot.following")  # the picture stands, whatever the run does
        browser.wait("surefoot.meshesLoading === 0", 60)
        shown = wait_for(lambda: drawn_no_more(browser), "a picture that is drawn no more", 120)
        hand.do("resume")
        browser.wait(f"{log} === 'recorded in {kept}'")
        assert browser.run("surefoot.pictures") == shown, "no picture has brought it"
        hand.do("reset")
        browser.wait(f"{log}.includes('{tmp_path / 'kept-2.mcap'}')")


def test_a_damaged_log_is_told_in_the_page_and_on_its_time_bar(browser, log, tmp_path):
    with Served("replay", damaged(log, tmp_path, 0.3)) as viewer:
        show(browser, viewer.link)
        browser.wait("document.querySelector('#notes').textContent.includes('This log is damaged')", 60)
        browser.screenshot(SCREENSHOTS / "damaged.png")


def test_a_tick_that_can_not_be_read_says_which_is_shown_and_steps_go_on_over_it(browser, log, tmp_path):
    path, begin, end = without_chunk(log, tmp_path, 1)
    with Served("replay", path) as viewer:
        show(browser, viewer.link)
        for tick in (799, round(begin / 0.0025) - 1):  # both pieces of the log are here then
            go_to(browser, tick)
        assert "can't be read: shown" not in browser.run("document.querySelector('#notes').textContent")
        scrub(browser, (begin + end) / 2)
        browser.wait("document.querySelector('[data-note=unreadable]')?.textContent.includes(`This tick can't be read: shown is ${surefoot.drawn.toFixed(4)} s.`)")
        browser.screenshot(SCREENSHOTS / "unreadable.png")
        browser.press(".")
        browser.wait(f"surefoot.drawn > {end} && document.querySelector('[data-note=unreadable]') === null")
        browser.press(",")
        browser.wait(f"surefoot.drawn <= {begin}")  # whose messages may lie in both pieces


def test_a_log_is_shown_at_any_time_of_it(browser, log):
    with Served("replay", log) as replay:
        show(browser, replay.link)
        ticks = replay.session()["ticks"]
        for share in (0.8, 0.1):
            go_to(browser, int(share * ticks))
            wait_for(lambda: math.dist(browser.run("surefoot.position('base')"), channel(browser, "truth.p_SB")) < 1e-5, "the picture")
        for key in "wp":
            browser.press(key)
        browser.wait("document.querySelector('#notes').textContent.includes('This is a log: only a run can be pushed')")
