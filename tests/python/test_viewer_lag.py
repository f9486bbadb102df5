"""What the viewer's page says where the machine can't follow."""

import contextlib
import os
import re
import signal
import threading
import time

from browser import Browser
from viewer import Viewer
from viewer_page import SCREENSHOTS, WALK, show

FACTS = "document.querySelector('#head-facts').textContent"
# What the program says comes to the page `window.late` milliseconds later.
LATE = """(() => {
  window.late = 0;
  const given = Object.getOwnPropertyDescriptor(WebSocket.prototype, 'onmessage');
  Object.defineProperty(WebSocket.prototype, 'onmessage', {
    get: given.get,
    set(call) { given.set.call(this, (event) => (late > 0 ? setTimeout(() => call.call(this, event), late) : call.call(this, event))); },
  });
})()"""


@contextlib.contextmanager
def halting(process, share, period=0.2):
    """The process stands still for a share of the time."""
    ends = threading.Event()

    def halt():
        while not ends.is_set():
            os.kill(process.pid, signal.SIGSTOP)
            time.sleep(share * period)
            os.kill(process.pid, signal.SIGCONT)
            time.sleep((1 - share) * period)

    thread = threading.Thread(target=halt)
    thread.start()
    try:
        yield
    finally:
        ends.set()
        thread.join()


def test_a_run_that_is_slower_than_asked_for_says_how_fast_it_is_and_why():
    with Viewer(*WALK) as viewer, Browser() as browser:
        show(browser, viewer.link)
        with halting(viewer.process, 0.8):
            browser.wait(f"/× of 1× asked: the program's machine is busy/.test({FACTS})", 60)
            said = browser.run(FACTS)
            browser.screenshot(SCREENSHOTS / "slow_run.png")
        assert 0 < float(re.match(r"([\d.]+)× of", said)[1]) < 0.9
        assert browser.run("document.querySelector('#head-facts').getBoundingClientRect().width") > 200


def test_a_page_that_hears_late_says_how_old_its_picture_is_while_the_run_goes_on():
    with Viewer(*WALK) as viewer, Browser() as browser:
        browser.call("Page.addScriptToEvaluateOnNewDocument", source=LATE)
        show(browser, viewer.link)
        time.sleep(1)
        browser.run("late = 1500")
        browser.wait(f"/the picture is 1\\.[5-9] s old/.test({FACTS})", 60)
        browser.press(" ")  # a run that stands has no picture that ages
        browser.wait(f"surefoot.status.paused && !/old/.test({FACTS})", 60)
