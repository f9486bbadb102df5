"""The viewer's page in a browser, as its user has it: opened, paused, looked at."""

import os
import pathlib
import time

from browser import wait_for

SCREENSHOTS = pathlib.Path(os.environ.get("SUREFOOT_SCREENSHOTS", pathlib.Path(__file__).resolve().parents[2] / "build/screenshots"))
# Keeps all that the page sends, in `window.sent`.
SPY = """(() => {
  window.sent = [];
  const send = WebSocket.prototype.send;
  WebSocket.prototype.send = function (text) { sent.push(JSON.parse(text)); return send.call(this, text); };
})()"""
WALK = ["run", "walk_flat_ideal", "--view", "--set", "duration=600", "--set", "stack=terrain_adaptation"]


def show(browser, link):
    """Opens the page anew and waits for its first picture."""
    browser.open("about:blank")
    browser.forget()
    browser.open(link)
    browser.wait("window.surefoot !== undefined && surefoot.pictures > 1", 60)
    return browser


def pause(browser):
    """Stops the run; its newest tick is then in the picture."""
    browser.press(" ")
    wait_for(lambda: browser.run("surefoot.status?.paused"), "the run to pause", 60)
    # What it says comes before the frames that are still on the way.
    newest = "[surefoot.tick, surefoot.status.tick - 1, surefoot.drawn === surefoot.last]"
    wait_for(lambda: still(browser, newest), "the newest picture", 60)


def still(browser, script):
    """Whether the picture is that of the run's newest tick, and stays so."""
    shown = browser.run(script)
    time.sleep(0.5)
    return shown == browser.run(script) and shown[0] == shown[1] and shown[2]


def channel(browser, name):
    return browser.run(f"surefoot.channel({name!r})")


def sent(browser, type):
    return [one for one in browser.run("sent") if one["type"] == type]


def tap_until(browser, selector, condition):
    """A browser that is busy loses taps which come close behind a drag; a user taps again."""
    def tapped():
        browser.tap(selector)
        time.sleep(0.5)
        return browser.run(condition)
    wait_for(tapped, condition, 60)
