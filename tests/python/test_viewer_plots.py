"""The plots of the viewer's page: any channel and any part of one, each plot whole, and lines that can be told apart."""

import numpy as np
import pytest

from browser import wait_for
from live_page import Served
from viewer_page import SCREENSHOTS, pixels, show

# Plots of which something is not to be seen, or whose × can't be pressed, once it is scrolled to.
CUT = """[...document.querySelectorAll('.plot')].filter(plot => {
  const figure = plot.getBoundingClientRect(), canvas = plot.querySelector('canvas').getBoundingClientRect();
  plot.scrollIntoView({ inline: 'nearest', block: 'nearest' });
  const close = plot.querySelector('figcaption button:last-child'), box = close.getBoundingClientRect();
  return canvas.right > figure.right + 1 || document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2) !== close;
}).map(plot => plot.querySelector('.plot-title').textContent)"""
TITLES = "[...document.querySelectorAll('.plot-title')].map(one => one.textContent)"
# Of the newest plot: name of each line, and how it is drawn.
LINES = """[...[...document.querySelectorAll('.plot')].at(-1).querySelectorAll('.legend .line')].map(one => {
  const path = one.querySelector('path');
  return [one.innerText.trim().split(/\\s/)[0], getComputedStyle(path).stroke, path.getAttribute('stroke-dasharray')];
})"""


@pytest.fixture
def replayed(browser, log):
    with Served("replay", log) as viewer:
        show(browser, viewer.link)
        browser.wait("document.querySelectorAll('.plot canvas').length === 2")
        yield browser
    browser.resize(1280, 720)
    browser.prefer("light")


def type_in_search(browser, text):
    browser.run("(() => { const field = document.querySelector('#channel-search'); field.focus(); field.value = ''; })()")
    browser.call("Input.insertText", text=text)
    browser.wait("!document.querySelector('.found').hidden")


def plot(browser, text):
    count = browser.run("document.querySelectorAll('.plot').length")
    type_in_search(browser, text)
    browser.press("Enter", text="\r")
    browser.wait(f"document.querySelectorAll('.plot').length === {count + 1} && document.querySelectorAll('.plot canvas').length === {count + 1}")
    browser.press("Escape")


def test_every_plot_is_whole_and_can_be_closed_however_many_there_are(replayed):
    for text in ("com.zmp", "readings.gyro", "truth.v_SCom"):
        plot(replayed, text)
        assert replayed.run("(() => { const row = document.querySelector('.plot-row'); return row.scrollLeft + row.clientWidth >= row.scrollWidth - 1; })()"), "the newest is in sight"
        for width, height in ((1280, 720), (1000, 720), (390, 844)):
            replayed.resize(width, height, mobile=width < 500)
            replayed.wait(f"innerWidth === {width}")
            wait_for(lambda: replayed.run(CUT) == [], f"whole plots at {width} × {height}")
        replayed.resize(1280, 720)
    for _ in range(5):
        replayed.run("document.querySelector('.plot figcaption button:last-child').click()")
    assert replayed.run(TITLES) == []


def test_a_single_joint_can_be_plotted_and_others_beside_it(replayed):
    plot(replayed, "command.torque.LF_KFE")
    assert replayed.run(TITLES)[-1] == "command.torque.LF_KFE [N·m]"
    assert len(replayed.run(LINES)) == 1
    replayed.run("[...document.querySelectorAll('.plot .more-lines')].at(-1).click()")
    type_in_search(replayed, "readings.torque")
    for name in ("LF_KFE", "RH_HFE"):
        replayed.run(f"[...document.querySelectorAll('.found .chip')].find(one => one.textContent === '{name}').click()")
    replayed.press("Escape")
    assert replayed.run(TITLES)[2:] == ["several channels [N·m]"], "one plot of all three"
    lines = replayed.run(LINES)
    assert [name for name, *_ in lines] == ["command.torque.LF_KFE", "readings.torque.LF_KFE", "readings.torque.RH_HFE"]
    assert len({tuple(style) for _, *style in lines}) == 3
    plot(replayed, "state.v_WB")
    assert len(replayed.run(TITLES)) == 4, "what is chosen later is a plot of its own"


def test_a_line_is_hidden_and_shown_again_by_a_press_on_its_name(replayed):
    replayed.run("document.querySelector('.legend .line').click()")
    assert replayed.run("document.querySelector('.legend .line').getAttribute('aria-pressed')") == "false"
    replayed.run("document.querySelector('.legend .line').click()")
    assert replayed.run("document.querySelector('.legend .line').getAttribute('aria-pressed')") == "true"


def test_twelve_lines_of_a_plot_are_told_apart_by_colours_of_the_legs_and_dashes(replayed):
    plot(replayed, "state.qd")
    for theme in ("light", "dark"):
        replayed.prefer(theme)
        replayed.wait(f"document.documentElement.dataset.theme === '{theme}'")
        lines = replayed.run(LINES)
        assert len(lines) == len({tuple(style) for _, *style in lines}) == 12
        assert all(len({colour for name, colour, _ in lines if name.startswith(leg)}) == 1 for leg in ("LF", "RF", "LH", "RH"))
        replayed.screenshot(SCREENSHOTS / f"plot_joints_{theme}.png")


def test_a_name_is_told_whole_in_as_many_lines_as_it_needs(replayed):
    for text in ("truth.v_SCom", "hierarchy.level.contact_force_minimisation.residual"):
        plot(replayed, text)
    title = "[...document.querySelectorAll('.plot-title')].at(-1)"
    assert replayed.run(f"{title}.textContent") == "hierarchy.level.contact_force_minimisation.residual [N]"
    cut = """[...document.querySelectorAll('.plot-title')].filter(one => one.scrollWidth > one.clientWidth
      || one.getBoundingClientRect().right > one.nextSibling.getBoundingClientRect().left + 1).map(one => one.textContent)"""
    assert replayed.run(cut) == []
    replayed.screenshot(SCREENSHOTS / "plot_names.png")


def test_the_picture_above_the_search_stays_as_it_was(replayed):
    """Chromium laid the list's ground over it where the processor draws."""
    replayed.wait("surefoot.atRest && surefoot.meshesLoading === 0 && surefoot.isDrawn")  # what moves is drawn coarser
    before = pixels(replayed.screenshot())
    type_in_search(replayed, "readings")
    left, top, right, list_top = replayed.run("""(() => {
      const picture = document.querySelector('#canvas').getBoundingClientRect(), list = document.querySelector('.found').getBoundingClientRect();
      return [list.left, picture.top, list.right, list.top].map(Math.round);
    })()""")
    assert list_top - top > 60
    replayed.run("new Promise(done => setTimeout(done, 500))")
    after = pixels(replayed.screenshot(SCREENSHOTS / "search_over_picture.png"))
    replayed.press("Escape")
    seen = (slice(top + 50, list_top - 30), slice(left + 8, right - 8))  # without the buttons and the list's shadow
    assert np.mean(np.abs(after[seen] - before[seen]).max(axis=2) > 24) < 0.05


def test_escape_leaves_the_search_and_gives_the_keys_back_to_the_page(replayed):
    type_in_search(replayed, "torque")
    replayed.press("Escape")
    assert replayed.run("document.querySelector('.found').hidden && document.activeElement === document.body")
    replayed.press("?")
    assert replayed.run("document.querySelector('#help').open && document.querySelector('#help').textContent.includes(\"leave the plots' search\")")
    replayed.press("Escape")


def test_channels_of_words_are_told_as_words(replayed):
    plot(replayed, "plan.feet.LF.phase")
    phases = next(one["values"] for one in replayed.run("fetch('/api/session').then(one => one.json()).then(one => one.channels)")
                  if one["name"] == "plan.feet.LF.phase")
    value = "[...document.querySelectorAll('.plot')].at(-1).querySelector('.legend output').textContent"
    replayed.wait(f"{phases}.includes({value})")
    replayed.screenshot(SCREENSHOTS / "plot_words.png")
