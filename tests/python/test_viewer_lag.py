"""What the viewer's page says where the machine can't follow."""

import contextlib
import os
import re
import signal
import threading
import time

from browser import Browser
from live_page import WALK, Served
from viewer_page import SCREENSHOTS, show

FACTS = "document.querySelector('#head-facts').textContent"


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
    with Served(*WALK) as viewer, Browser() as browser:
        show(browser, viewer.link)
        with halting(viewer.process, 0.8):
            browser.wait(f"/× of 1× asked: the program's machine is busy/.test({FACTS})", 60)
            said = browser.run(FACTS)
            browser.screenshot(SCREENSHOTS / "slow_run.png")
        assert 0 < float(re.match(r"([\d.]+)× of", said)[1]) < 0.9
        assert browser.run("document.querySelector('#head-facts').getBoundingClientRect().width") > 200
