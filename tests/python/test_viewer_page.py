"""The viewer's page in a real browser: what it shows is what the run says. Screenshots stay in build/screenshots."""

import functools
import http.server
import itertools
import json
import math
import threading
import time

import pytest

from browser import WITHOUT_PICTURE, Browser, wait_for
from damaged_logs import damaged, without_chunk
from live_page import Page
from viewer import Viewer
from viewer_page import SCREENSHOTS, WALK, channel, go_to, pause, show

# What changes the run, in the panel Drive.
CONTROLS = "[...document.querySelectorAll('#panel-drive :is(button, input)')]"
VIEW_ONLY = "document.querySelector('#panel-drive .view-only:not([hidden])')?.textContent.startsWith('This page can only look')"


@pytest.fixture(scope="module")
def live():
    with Viewer(*WALK) as viewer:
        yield viewer


@pytest.fixture(scope="module")
def replayed(log):
    with Viewer("replay", log) as viewer:
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
    base, truth = browser.run("surefoot.position('base')"), channel(browser, "truth.p_WB")
    assert math.dist(base, truth) < 1e-5
    radius = live.json("api/session")["header"]["robot"]["foot_radius"]
    for leg in ("LF", "RF", "LH", "RH"):
        foot, true_foot = browser.run(f"surefoot.position('{leg}_FOOT')"), channel(browser, f"truth.p_WF.{leg}")
        assert math.dist(foot, true_foot) < radius  # the sphere's centre lies within the foot's own length
    browser.press(" ")


def test_the_robot_stands_in_the_picture_where_the_run_says(browser, live):
    show(browser, live.link)
    pause(browser)
    browser.wait("surefoot.meshesLoading === 0", 60)
    time.sleep(1.5)  # the camera comes to rest
    seen = browser.run("""(() => {
      const p = surefoot.channel('truth.p_WB');
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
    browser.wait("surefoot.last - surefoot.first > 2", 60)
    browser.run("""(() => { const scrub = document.querySelector('#scrub'); scrub.value = Number(scrub.min) + 0.5;
      scrub.dispatchEvent(new Event('input')); })()""")
    browser.wait("!surefoot.following")
    shown, last = browser.run("surefoot.time"), browser.run("surefoot.last")
    assert last - shown > 1
    browser.wait(f"surefoot.last > {last} + 0.2")
    assert browser.run("surefoot.time") == shown
    browser.press("l")
    browser.wait("surefoot.following && surefoot.last - surefoot.time < 0.5")


def recorded_base(path, tick):
    """Where the log says that the base is at a tick, in truth."""
    from mcap.reader import make_reader

    with open(path, "rb") as file:
        messages = make_reader(file).iter_messages(topics=["/truth"])
        return json.loads(next(itertools.islice(messages, tick, None))[2].data)["p_WB"]


def test_a_page_that_is_opened_late_scrubs_back_to_before_it_came(browser, tmp_path):
    with Viewer(*WALK, "--record", tmp_path / "run.mcap") as walk:
        with Page(walk) as first:  # eight times as fast, so that a minute has passed soon
            first.do("speed", factor=8.0)
            browser.open("about:blank")
            # The browser is heard meanwhile: it is left where it gets no answer to its pings.
            wait_for(lambda: browser.run("true") and first.status()["time"] > 60, "a minute of the run", 300)
            first.do("speed", factor=1.0)
        show(browser, walk.link)
        assert browser.run("surefoot.first") < 0.01
        begin = browser.run("surefoot.last")
        browser.run(f"""(() => {{ const scrub = document.querySelector('#scrub'); scrub.value = {begin - 50};
          scrub.dispatchEvent(new Event('input')); }})()""")
        browser.wait(f"Math.abs(surefoot.time - {begin - 50}) < 0.2 && surefoot.channel('truth.p_WB') !== undefined"
                     " && Math.abs(surefoot.drawn - surefoot.time) < 0.003", 30)
        tick, position, shown = browser.run("[surefoot.tick, surefoot.position('base'), surefoot.channel('truth.p_WB')]")
        browser.screenshot(SCREENSHOTS / "late.png")
        browser.press("l")
        browser.wait("surefoot.following && surefoot.last - surefoot.time < 0.5")
        pause(browser)
        complaints = [text for kind, text in browser.console if kind == "error"]
    assert math.dist(position, shown) < 1e-5
    assert abs(tick * 0.0025 - (begin - 50)) < 0.2
    assert math.dist(shown, recorded_base(tmp_path / "run.mcap.partial", tick)) < 1e-5
    assert complaints == [] and any(url.endswith("/api/events") for url in browser.requests)


def test_a_page_too_many_is_told_the_limit_and_gets_a_place_that_is_free(browser):
    with Viewer(*WALK, "--view-clients", 1) as walk:
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


def test_a_push_moves_the_robot_and_is_shown_with_its_force(browser):
    # It stands all the while: how a push ends that meets a walk depends on the moment.
    with Viewer(*WALK, "--set", "planner.gait.start_duration=600") as robot:
        show(browser, robot.link)
        browser.wait("surefoot.tick > 100", 60)
        browser.click("#tab-drive")
        browser.run("document.querySelector('#push-impulse').value = 55; document.querySelector('#push-duration').value = 0.35")
        pause(browser)  # tick by tick, so that there is a picture of the push on any machine
        before = channel(browser, "truth.v_WB")[1]
        browser.run("document.querySelector('#push').click()")
        pushed = "[...document.querySelectorAll('.label.push:not([hidden])')].some(one => /push 157 N/.test(one.textContent))"
        step_until(browser, pushed, "the push")
        browser.screenshot(SCREENSHOTS / "push.png")
        step_until(browser, f"!{pushed}", "its end")
        assert channel(browser, "truth.v_WB")[1] > before + 0.15  # 55 N·s on 30 kg, less what the feet take
        assert "N" in browser.run("document.querySelector('.changes').textContent")


def test_a_limit_that_becomes_active_is_seen_in_the_panel_by_words_and_colour(browser):
    with Viewer(*WALK) as walk:
        show(browser, walk.link)
        browser.wait("surefoot.tick > 100", 60)
        pause(browser)
        browser.click("#tab-tune")
        browser.run("""(() => { const field = document.querySelector('#friction'); field.value = field.min;
          field.dispatchEvent(new Event('change')); })()""")
        browser.click("#tab-hierarchy")
        at_limit = "surefoot.levels().some(one => one.name === 'friction_cone' && one.active.length > 0)"
        step_until(browser, at_limit, "a limit")
        browser.wait("surefoot.levels().every(one => document.querySelector(`.level[data-level=${one.name}]`)"
                     ".dataset.status === one.status.replaceAll(' ', '-'))")
        cards = browser.run("[...document.querySelectorAll('.level')].map(one => "
                            "[one.dataset.status, one.textContent, getComputedStyle(one).borderLeftColor])")
        browser.screenshot(SCREENSHOTS / "limit.png")
        held = [card for card in cards if card[0] in ("at-limit", "gives-way")]
        assert held
        assert all("bound" in text or "gives way" in text for _, text, _ in held)
        assert {colour for *_, colour in held}.isdisjoint({colour for status, _, colour in cards if status == "met"})


def test_a_pull_that_still_acts_ends_with_the_run_and_nothing_can_be_pushed_after_it(browser):
    with Viewer("run", "walk_flat_ideal", "--view", "--set", "duration=1") as short, Page(short) as hand:
        hand.do("pause")
        show(browser, short.link)
        browser.click("#tab-drive")
        hand.do("resume")
        while hand.status()["ended"] is None:
            hand.ask("pull", body="base", point=[0, 0, 0], force=[0, 30, 0])
        browser.wait("surefoot.status.ended !== null")
        browser.wait("/the pull ends after/.test(document.querySelector('.changes').textContent)")
        browser.wait("surefoot.status.pull === null && /The run has ended/.test(document.querySelector('#asked').textContent)")
        assert browser.run(f"{CONTROLS}.every(one => one.matches(':disabled'))")
        browser.press("r")
        browser.wait(f"surefoot.status.ended === null && {CONTROLS}.every(one => !one.matches(':disabled'))", 60)


def test_a_lost_connection_is_shown_and_recovers_by_itself(browser):
    with Viewer(*WALK) as first:
        show(browser, first.link)
        port = first.port
    browser.wait("document.querySelector('#link-state')?.textContent === 'connection lost'")
    told = browser.run("document.querySelector('#notes').textContent")
    assert "Look in its terminal" in told and "comes back by itself" in told
    browser.click("#tab-drive")
    assert browser.run(f"{CONTROLS}.every(one => one.matches(':disabled') && getComputedStyle(one).filter === 'grayscale(1)')")
    assert browser.run("document.querySelector('#panel-drive .view-only').hidden"), "its token is not refused"
    browser.screenshot(SCREENSHOTS / "lost.png")
    with Viewer(*WALK, port=port):
        browser.wait("document.querySelector('#link-state')?.textContent === 'connected'", 40)
        browser.wait("window.surefoot !== undefined && surefoot.tick > 0 && surefoot.following", 40)
        browser.wait("!document.querySelector('#notes').textContent.includes('lost')", 40)
        browser.wait(VIEW_ONLY, 40)  # another start has another token


def test_a_page_that_finds_another_run_loads_itself_anew(browser):
    with Viewer(*WALK) as first:
        show(browser, first.link)
        port = first.port
    browser.wait("document.querySelector('#link-state')?.textContent === 'connection lost'")
    browser.run("window.before = true")
    other = ["run", "step_down", "--view", "--set", "duration=600"]
    with Viewer(*other, port=port):
        browser.wait("window.before === undefined && window.surefoot !== undefined && surefoot.pictures > 1", 60)
        assert browser.run("document.querySelector('#title').textContent") == "step_down"
        browser.wait("surefoot.tick > 0 && surefoot.following", 40)
        assert browser.run("surefoot.levels().length") > 5


def test_a_page_of_a_run_that_finds_a_log_loads_itself_anew(browser, log):
    with Viewer(*WALK) as first:
        show(browser, first.link)
    browser.wait("document.querySelector('#link-state')?.textContent === 'connection lost'")
    browser.run("window.before = true")
    with Viewer("replay", log, port=first.port):
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


def test_a_damaged_log_is_told_in_the_page_and_on_its_time_bar(browser, log, tmp_path):
    with Viewer("replay", damaged(log, tmp_path, 0.3)) as viewer:
        show(browser, viewer.link)
        browser.wait("document.querySelector('#notes').textContent.includes('This log is damaged')", 60)
        browser.screenshot(SCREENSHOTS / "damaged.png")


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


def test_a_page_of_a_recorded_run_says_where_its_log_is(browser, live, tmp_path):
    log = "[...document.querySelectorAll('#panel-state dt')].find(one => one.textContent === 'Log')?.nextSibling.textContent"
    show(browser, live.link)
    browser.wait(f"{log} === 'none: run it with --record FILE to keep one'")
    kept = tmp_path / "kept.mcap"
    with Viewer("run", "walk_flat_ideal", "--view", "--set", "duration=1", "--record", kept) as recorded, Page(recorded) as hand:
        hand.do("pause")
        show(browser, recorded.address)
        browser.wait("document.querySelector('#head-facts').textContent.startsWith('recording kept.mcap')")
        browser.wait(f"{log} === 'goes into {kept}.partial, which is called {kept} when the run has ended'")
        browser.press(" ")
        browser.wait("!surefoot.following")  # the picture stands, whatever the run does
        hand.do("resume")
        browser.wait(f"{log} === 'recorded in {kept}'")
        hand.do("reset")
        browser.wait(f"{log}.includes('{tmp_path / 'kept-2.mcap'}')")


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


def test_a_log_is_shown_at_any_time_of_it(browser, replayed):
    show(browser, replayed.link)
    session = replayed.json("api/session")
    browser.run("surefoot.playing && document.querySelector('#play').click()")
    browser.wait("!surefoot.playing")
    for share in (0.8, 0.1):
        tick = int(share * session["ticks"])
        browser.run(f"""(() => {{ const scrub = document.querySelector('#scrub'); scrub.value = {tick * session["period"] + 1e-4};
          scrub.dispatchEvent(new Event('input')); }})()""")
        browser.wait(f"Math.abs(surefoot.tick - {tick}) <= 1 && Math.abs(surefoot.time - surefoot.tick * {session['period']}) < {session['period']}")
        wait_for(lambda: math.dist(browser.run("surefoot.position('base')"), channel(browser, "truth.p_WB")) < 1e-5, "the picture")


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
    header = replayed.json("api/session")["header"]
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
        assert "no WebGL" in browser.run("document.querySelector('#notes').textContent")
        browser.wait("surefoot.time > 0.3", 30)


def test_a_tick_that_can_not_be_read_says_which_is_shown_and_steps_go_on_over_it(browser, log, tmp_path):
    path, begin, end = without_chunk(log, tmp_path, 1)
    with Viewer("replay", path) as viewer:
        show(browser, viewer.link)
        for tick in (799, round(begin / 0.0025) - 1):  # both pieces of the log are here then
            go_to(browser, tick)
        assert "can't be read: shown" not in browser.run("document.querySelector('#notes').textContent")
        browser.run(f"(() => {{ const scrub = document.querySelector('#scrub'); scrub.value = {(begin + end) / 2}; scrub.dispatchEvent(new Event('input')); }})()")
        browser.wait("document.querySelector('[data-note=unreadable]')?.textContent.includes(`This tick can't be read: shown is ${surefoot.drawn.toFixed(4)} s.`)")
        browser.screenshot(SCREENSHOTS / "unreadable.png")
        browser.press(".")
        browser.wait(f"surefoot.drawn > {end} && document.querySelector('[data-note=unreadable]') === null")
        browser.press(",")
        browser.wait(f"surefoot.drawn < {begin}")
