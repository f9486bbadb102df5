"""The viewer's page in a browser, as its user has it: opened, paused, looked at."""

import contextlib
import io
import os
import pathlib
import time

import numpy as np
from PIL import Image

from browser import wait_for

SCREENSHOTS = pathlib.Path(os.environ.get("SUREFOOT_SCREENSHOTS", pathlib.Path(__file__).resolve().parents[2] / "build/screenshots"))
# Keeps all that the page sends, in `window.sent`.
SPY = """(() => {
  window.sent = [];
  const send = WebSocket.prototype.send;
  WebSocket.prototype.send = function (text) { sent.push(JSON.parse(text)); return send.call(this, text); };
})()"""
# What changes the run, in the panel Drive, and that this page may only look.
CONTROLS = "[...document.querySelectorAll('#panel-drive :is(button, input)')]"
VIEW_ONLY = "document.querySelector('#panel-drive .view-only:not([hidden])')?.textContent.startsWith('This page can only look')"
SIZES = {"desktop": (1280, 720), "phone": (390, 844)}
THEMES = ("light", "dark")


def show(browser, link):
    """Opens the page anew and waits for its first picture."""
    browser.open("about:blank")
    browser.forget()
    browser.open(link)
    browser.wait("window.surefoot !== undefined && surefoot.pictures > 1", 60)
    return browser


def pause(browser):
    """Stops the run, if it isn't stopped; its newest tick is then in the picture."""
    wait_for(lambda: browser.run("surefoot.status"), "the run's state", 60)
    if not browser.run("surefoot.status.paused"):
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


def scrub(browser, moment):
    """Looks at another time of the run: a number, or a script that gives one."""
    browser.run(f"(() => {{ const scrub = document.querySelector('#scrub'); scrub.value = {moment}; scrub.dispatchEvent(new Event('input')); }})()")


def look_back(browser, seconds):
    """Shows what was so long ago; that time."""
    browser.wait(f"surefoot.last - surefoot.first > {seconds + 0.5}", 60)
    scrub(browser, f"surefoot.last - {seconds}")
    browser.wait("!surefoot.following")
    return browser.run("surefoot.time")


def go_to(browser, tick, period=0.0025):
    """Stops a log at a tick."""
    browser.run("surefoot.playing && document.querySelector('#play').click()")
    browser.wait("!surefoot.playing")
    scrub(browser, tick * period + 1e-4)
    browser.wait(f"surefoot.tick === {tick} && Math.abs(surefoot.drawn - {tick * period}) < 1e-6")


def step_until(browser, condition, what, ticks=200):
    """Of a paused run: tick by tick, so that a slow machine misses none."""
    for _ in range(ticks):
        newest = browser.run("surefoot.last")
        browser.press(".")
        wait_for(lambda: browser.run("surefoot.last") > newest, "the next tick")
        browser.wait("surefoot.time === surefoot.last")
        if browser.run(condition):
            return
    raise AssertionError(f"{ticks} ticks without {what}")


def pixels(png):
    """Red, green and blue of a screenshot, row by row."""
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB")).astype(int)


def channel(browser, name):
    return browser.run(f"surefoot.channel({name!r})")


def sent(browser, type):
    return [one for one in browser.run("sent") if one["type"] == type]


def every_look(browser, name):
    """Both themes at both sizes, with a screenshot; the desktop in light comes back."""
    try:
        for theme in THEMES:
            browser.prefer(theme)
            for size, (width, height) in SIZES.items():
                browser.resize(width, height, mobile=size == "phone")
                browser.wait(f"innerWidth === {width} && document.documentElement.dataset.theme === {theme!r}")
                browser.wait("window.surefoot === undefined || surefoot.isDrawn", 60)
                yield f"{name} {size} {theme}"
                browser.screenshot(SCREENSHOTS / f"{name}_{size}_{theme}.png")
    finally:
        browser.prefer("light")
        browser.resize(*SIZES["desktop"])


@contextlib.contextmanager
def phone(browser):
    """A phone's page, with fingers; afterwards a desktop's again."""
    browser.resize(390, 844, scale=2, mobile=True)
    browser.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
    try:
        yield browser
    finally:
        browser.call("Emulation.setTouchEmulationEnabled", enabled=False)
        browser.resize(1280, 720)


def tap(browser, selector):
    """Taps what is seen there, once the page holds still, until the page has heard of it: a busy browser loses taps, and a user taps again."""
    one = f"document.querySelector({selector!r})"
    browser.run(f"{one}.scrollIntoView({{ block: 'nearest' }})")
    browser.run(f"window.tapped = false; {one}.addEventListener('click', () => (window.tapped = true), {{ once: true, capture: true }})")
    place = f"(() => {{ const b = {one}.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; }})()"
    hit = f"(([x, y]) => {one}.contains(document.elementFromPoint(x, y)))({place})"

    def heard():
        browser.wait(hit)
        browser.tap(selector)
        with contextlib.suppress(AssertionError):
            return browser.wait("tapped", 3)
    wait_for(heard, f"a tap on {selector}", 60)
