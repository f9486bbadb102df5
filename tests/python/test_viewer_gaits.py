"""A live run with gaits, in the viewer's page: digits, buttons and a gamepad choose and steer them."""

import pytest

from live_page import Served
from viewer_page import SPY, show

WANTED = "surefoot.status?.command"


@pytest.fixture(scope="module")
def meadow():
    with Served("run", "meadow", "--view", "--set", "planner.calibration.duration=0") as viewer:
        yield viewer


def test_digits_and_buttons_change_the_gait_while_the_robot_walks(browser, meadow):
    show(browser, meadow.link)
    browser.click("#tab-drive")
    browser.press("4")
    browser.wait(f"{WANTED}.gait === 'flying_trot' && {WANTED}.by === 'operator'", 60)
    assert browser.run("document.querySelector('[data-gait=flying_trot]').getAttribute('aria-pressed')") == "true"
    browser.click("[data-gait=pace]")
    browser.wait(f"{WANTED}.gait === 'pace'", 60)
    browser.press("w")
    browser.wait(f"{WANTED}.velocity[0] > 0.44 && {WANTED}.gait === 'pace'", 60)


def test_a_gamepad_walks_turns_and_changes_the_gait(browser, meadow):
    show(browser, meadow.link)
    browser.run("""(() => {
      window.pad = { axes: [0, -1, 0.5, 0], buttons: [...Array(16)].map(() => ({ pressed: false })) };
      navigator.getGamepads = () => [pad];
    })()""")
    browser.wait(f"{WANTED}.velocity[0] > 1 && {WANTED}.yaw_rate < -0.5", 60)
    before = browser.run(f"{WANTED}.gait")
    browser.run("pad.buttons[5].pressed = true")
    browser.wait(f"{WANTED}.gait !== '{before}'", 60)
    browser.run("pad.axes = [0, 0, 0, 0]")
    browser.wait(f"{WANTED}.velocity[0] === 0 && {WANTED}.walk", 60)



def test_an_unknown_gait_is_refused_with_those_that_there_are(meadow):
    with meadow.page() as page:
        reply = page.ask("walk", walk=True, velocity=[0.1, 0.0], yaw_rate=0.0, height=0.0, gait="gallop")
        assert not reply["ok"]
        assert "gallop" in reply["error"] and "flying_trot" in reply["error"]
