"""The viewer's page in a real browser: what it shows is what the run says. Screenshots stay in build/screenshots."""

import functools
import http.server
import math
import threading
import time

import pytest

from browser import WITHOUT_PICTURE, Browser, wait_for
from live_page import WALK, Page, Served
from viewer_page import CONTROLS, SCREENSHOTS, VIEW_ONLY, channel, look_back, pause, show


@pytest.fixture(scope="module")
def replayed(log):
    with Served("replay", log) as viewer:
        yield viewer


def test_the_page_loads_without_a_complaint_and_asks_nobody_else(browser, live):
    show(browser, live.link)
    browser.wait("surefoot.meshesLoading === 0", 60)
    browser.screenshot(SCREENSHOTS / "live.png")
    assert [text for kind, text in browser.console if kind == "error"] == []
    strangers = [url for url in browser.requests if not url.startswith((live.address, "about:", "data:", "blob:"))]
    assert strangers == []


def test_the_robot_stands_in_the_scene_where_the_run_says(browser, live):
    show(browser, live.link)
    pause(browser)
    base, truth = browser.run("surefoot.position('base')"), channel(browser, "truth.p_SB")
    assert math.dist(base, truth) < 1e-5
    radius = live.session()["header"]["robot"]["foot_radius"]
    for leg in ("LF", "RF", "LH", "RH"):
        foot, true_foot = browser.run(f"surefoot.position('{leg}_FOOT')"), channel(browser, f"truth.p_SF.{leg}")
        assert math.dist(foot, true_foot) < radius  # the sphere's centre lies within the foot's own length
    browser.press(" ")


def test_the_robot_stands_in_the_picture_where_the_run_says(browser, live):
    show(browser, live.link)
    pause(browser)
    browser.wait("surefoot.meshesLoading === 0", 60)
    time.sleep(1.5)  # the camera comes to rest
    seen = browser.run("""(() => {
      const p = surefoot.channel('truth.p_SB');
      const pixel = (x, y, z) => surefoot.pixel([p[0] + x, p[1] + y, p[2] + z]);
      return [pixel(0, 0, 0.05), pixel(0, 0, 1.2), pixel(0, 2, -0.4)];
    })()""")
    difference = [max(abs(a - b) for a, b in zip(seen[0], other)) for other in seen[1:]]
    assert min(difference) > 25, seen  # the torso is no sky and no ground
    browser.press(" ")


def test_pause_stops_the_run_and_a_step_goes_on_by_one_tick(browser, live):
    show(browser, live.link)
    pause(browser)
    tick = browser.run("surefoot.tick")
    time.sleep(0.5)
    assert browser.run("surefoot.tick") == tick
    browser.press(".")
    browser.wait(f"surefoot.tick === {tick + 1}")
    browser.press(" ")
    browser.wait(f"surefoot.tick > {tick + 20}")


def test_scrubbing_shows_an_earlier_tick_while_the_run_goes_on(browser, live):
    show(browser, live.link)
    shown, last = look_back(browser, 1.5), browser.run("surefoot.last")
    assert last - shown > 1
    browser.wait(f"surefoot.last > {last} + 0.2")
    assert browser.run("surefoot.time") == shown
    browser.press("l")
    browser.wait("surefoot.following && surefoot.last - surefoot.time < 0.5")


def test_a_page_too_many_is_told_the_limit_and_gets_a_place_that_is_free(browser):
    with Served(*WALK, "--view-clients", 1) as walk:
        with Page(walk) as first:
            first.status()
            browser.open("about:blank")
            browser.open(walk.link)
            browser.wait("document.querySelector('#notes')?.textContent.includes('1 page watches already, the limit')", 60)
            assert browser.run("document.querySelector('#link-state').textContent") == "turned away"
            assert "1 page watches already" in browser.run("document.querySelector('#stale:not([hidden])').textContent"), "why the panels are empty"
            browser.screenshot(SCREENSHOTS / "turned_away.png")
        browser.wait("document.querySelector('#link-state')?.textContent === 'connected' && surefoot.tick > 0", 40)
        browser.wait("!document.querySelector('#notes').textContent.includes('limit')", 40)


def test_a_lost_connection_is_shown_and_recovers_by_itself(browser):
    fps = "document.querySelector('#head-facts').textContent.includes('fps')"
    with Served(*WALK) as first:
        show(browser, first.link)
        browser.wait(fps, 60)
        port = first.port
    browser.wait("document.querySelector('#link-state')?.textContent === 'connection lost'")
    browser.wait(f"!{fps}")
    told = browser.run("document.querySelector('#notes').textContent")
    assert "Look in its terminal" in told and "comes back by itself" in told
    browser.click("#tab-drive")
    assert browser.run(f"{CONTROLS}.every(one => one.matches(':disabled') && getComputedStyle(one).filter === 'grayscale(1)')")
    assert browser.run("document.querySelector('#panel-drive .view-only').hidden"), "its token is not refused"
    browser.screenshot(SCREENSHOTS / "lost.png")
    with Served(*WALK, port=port):
        browser.wait("document.querySelector('#link-state')?.textContent === 'connected'", 40)
        browser.wait("window.surefoot !== undefined && surefoot.tick > 0 && surefoot.following", 40)
        browser.wait("!document.querySelector('#notes').textContent.includes('lost')", 40)
        browser.wait(VIEW_ONLY, 40)  # another start has another token


def test_a_page_that_finds_another_run_loads_itself_anew(browser):
    with Served(*WALK) as first:
        show(browser, first.link)
        port = first.port
    browser.wait("document.querySelector('#link-state')?.textContent === 'connection lost'")
    browser.run("window.before = true")
    other = ["run", "step_down", "--view", "--set", "duration=600"]
    with Served(*other, port=port):
        browser.wait("window.before === undefined && window.surefoot !== undefined && surefoot.pictures > 1", 60)
        assert browser.run("document.querySelector('#title').textContent") == "step_down"
        browser.wait("surefoot.tick > 0 && surefoot.following", 40)
        assert browser.run("surefoot.levels().length") > 5


def test_a_page_of_a_run_that_finds_a_log_loads_itself_anew(browser, log):
    with Served(*WALK) as first:
        show(browser, first.link)
    browser.wait("document.querySelector('#link-state')?.textContent === 'connection lost'")
    browser.run("window.before = true")
    with Served("replay", log, port=first.port):
        browser.wait("window.before === undefined && window.surefoot !== undefined && surefoot.pictures > 0", 60)
        assert browser.run("document.querySelector('#mode').textContent") == "replay"
        assert browser.run("document.querySelector('#notes').textContent") == ""


def test_the_page_under_another_name_is_refused(live):
    with Browser(flags=[*WITHOUT_PICTURE, "--host-resolver-rules=MAP evil.example 127.0.0.1"]) as browser:
        browser.open(f"http://evil.example:{live.port}/")
        browser.wait("document.body?.textContent.includes('not the host that was asked for')")
        assert browser.run("document.querySelector('script') === null")


def test_a_page_of_another_origin_can_neither_watch_nor_read(live, tmp_path):
    (tmp_path / "index.html").write_text("<p>elsewhere</p>")
    handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=tmp_path)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as elsewhere, Browser(flags=WITHOUT_PICTURE) as browser:
        threading.Thread(target=elsewhere.serve_forever, daemon=True).start()
        browser.open(f"http://127.0.0.1:{elsewhere.server_port}/")
        browser.wait("document.body?.textContent.includes('elsewhere')")
        socket = f"new WebSocket('ws://127.0.0.1:{live.port}/api/live')"
        assert browser.run(f"new Promise(done => Object.assign({socket}, {{onopen: () => done('open'), onerror: () => done('refused')}}))") == "refused"
        for mode in ("cors", "no-cors"):
            assert browser.run(f"fetch('{live.address}api/session', {{mode: '{mode}'}}).then(() => 'read', () => 'refused')") == "refused"
        elsewhere.shutdown()


def test_a_wrong_token_can_change_nothing(browser, live):
    show(browser, live.address + "#token=0123456789abcdef0123456789abcdef")
    browser.wait(VIEW_ONLY)
    assert browser.run(f"{CONTROLS}.every(one => one.matches(':disabled'))")
    browser.press("p")
    browser.wait("document.querySelector('#notes').textContent.includes('token')")
    browser.press(" ")
    browser.wait("surefoot.status !== undefined")
    assert not browser.run("surefoot.status.paused")


def test_no_mesh_is_missing_and_pictures_come_in_time(browser, live):
    show(browser, live.link)
    browser.wait("surefoot.meshesLoading === 0", 60)
    assert browser.run("surefoot.meshesMissing") == []
    browser.wait("surefoot.frameTime > 0", 60)


def test_without_a_token_the_page_only_looks(browser, live):
    show(browser, live.address)
    assert browser.run(VIEW_ONLY)
    assert browser.run(f"{CONTROLS}.every(one => one.matches(':disabled'))")
    held = "['#reset', '#speed'].map(name => document.querySelector(name).matches(':disabled'))"
    browser.wait(f"{held}.join() === 'true,true' && document.querySelector('#reset').title.includes('#token=')")
    browser.press(" ")
    browser.wait(f"!surefoot.following && {held}.join() === 'true,false'")  # what was before goes as fast as one likes
    browser.press("l")


def test_the_time_bar_has_the_colours_of_the_page(browser, replayed):
    marks = "[...new Uint32Array(document.querySelector('.marks').getContext('2d').getImageData(0, 0, 2000, 30).data.buffer)]"
    colours = f"[...new Set({marks}.filter(one => one >>> 24 === 255))]"
    browser.prefer("light")
    show(browser, replayed.link)
    browser.run("surefoot.playing && document.querySelector('#play').click()")
    browser.wait(f"document.querySelector('#plots-progress').textContent === '' && {colours}.length > 0")
    time.sleep(0.5)
    try:
        light = browser.run(colours)
        for theme in ("dark", "light"):
            browser.prefer(theme)
            browser.wait(f"document.documentElement.dataset.theme === '{theme}'")
            browser.wait(f"{colours}.length > 0 && {colours}.some(one => {light}.includes(one)) === {str(theme == 'light').lower()}")
    finally:
        browser.prefer("light")


def test_the_menu_of_overlays_leaves_the_buttons_below_it_free(browser, replayed):
    show(browser, replayed.link)
    browser.click("#overlays-open")
    menu, bar = (browser.run(f"document.querySelector('{name}').getBoundingClientRect().{edge}") for name, edge in (("#overlays", "bottom"), ("#transport", "top")))
    assert menu <= bar


def test_a_press_in_a_plot_moves_the_picture_to_that_time(browser, replayed):
    show(browser, replayed.link)
    browser.wait("document.querySelector('.u-over')?.getBoundingClientRect().width > 50")
    x, y, width = browser.run("(() => { const b = document.querySelector('.u-over').getBoundingClientRect(); return [b.x, b.y + 10, b.width]; })()")
    browser.run("surefoot.playing && document.querySelector('#play').click()")
    browser.mouse("mousePressed", x + 0.5 * width, y)
    browser.mouse("mouseReleased", x + 0.5 * width, y)
    middle = browser.run("0.5 * (surefoot.first + surefoot.last)")
    wait_for(lambda: abs(browser.run("surefoot.time") - middle) < 0.1, "the time of the plot's middle")


def test_any_channel_is_found_and_plotted(browser, replayed):
    show(browser, replayed.link)
    plots = browser.run("document.querySelectorAll('.plot').length")
    browser.run("""(() => { const field = document.querySelector('#channel-search'); field.value = 'cone residual';
      field.dispatchEvent(new Event('input')); })()""")
    assert "hierarchy.level.friction_cone.residual" in browser.run("document.querySelector('.found').textContent")
    browser.run("document.querySelector('.found button').click()")
    browser.wait(f"document.querySelectorAll('.plot').length === {plots + 1}")
    header = replayed.session()["header"]
    unit = header["level_units"][header["level_names"].index("friction_cone")]
    assert browser.run("[...document.querySelectorAll('.plot-title')].at(-1).textContent") == f"hierarchy.level.friction_cone.residual [{unit}]"


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize(("name", "width", "height"), [("desktop", 1280, 720), ("phone", 390, 844)])
def test_nothing_is_wider_than_the_page(browser, replayed, theme, name, width, height):
    browser.prefer(theme)
    browser.resize(width, height, scale=2 if name == "phone" else 1, mobile=name == "phone")
    show(browser, replayed.link)
    browser.wait("surefoot.meshesLoading === 0", 60)
    time.sleep(1)
    browser.screenshot(SCREENSHOTS / f"replay_{name}_{theme}.png")
    assert browser.run("document.documentElement.scrollWidth") <= width
    cut = browser.run("[...document.querySelectorAll('button, select')].filter(one => one.offsetParent && "
                      f"(one.getBoundingClientRect().right > {width} || one.getBoundingClientRect().left < 0)).map(one => one.outerHTML)")
    assert cut == []
    browser.resize(1280, 720)


def test_without_webgl_the_page_says_so_and_its_panels_work(replayed):
    with Browser(flags=WITHOUT_PICTURE) as browser:
        browser.open(replayed.link)
        browser.wait("document.querySelectorAll('.level').length > 5", 60)
        browser.screenshot(SCREENSHOTS / "no_webgl.png")
        said = browser.run("document.querySelector('#view').innerText")
        assert said.startswith("There is no picture") and "hardware acceleration" in said and "THREE" not in said
        assert browser.run("document.querySelector('#notes').textContent") == ""
        assert browser.run("document.querySelector('#view').offsetHeight") < 100, "no empty box"
        browser.wait("surefoot.time > 0.3", 30)
