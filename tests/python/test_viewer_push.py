"""What is done to the robot from the viewer's page is seen there: forces, limits, and that a run which has ended takes none."""

from live_page import WALK, Page, Served
from viewer_page import CONTROLS, SCREENSHOTS, channel, pause, show, step_until


def test_a_push_moves_the_robot_and_is_shown_with_its_force(browser):
    # It stands all the while: how a push ends that meets a walk depends on the moment.
    with Served(*WALK, "--set", "planner.gait.start_duration=600") as robot:
        show(browser, robot.link)
        browser.wait("surefoot.tick > 100", 60)
        browser.click("#tab-drive")
        browser.run("document.querySelector('#push-impulse').value = 55; document.querySelector('#push-duration').value = 0.35")
        pause(browser)  # tick by tick, so that there is a picture of the push on any machine
        before = channel(browser, "truth.v_SB")[1]
        browser.run("document.querySelector('#push').click()")
        pushed = "[...document.querySelectorAll('.label.push:not([hidden])')].some(one => /push 157 N/.test(one.textContent))"
        step_until(browser, pushed, "the push")
        browser.screenshot(SCREENSHOTS / "push.png")
        step_until(browser, f"!{pushed}", "its end")
        assert channel(browser, "truth.v_SB")[1] > before + 0.15  # 55 N·s on 30 kg, less what the feet take


def test_a_limit_that_becomes_active_is_seen_in_the_panel_by_words_and_colour(browser):
    with Served(*WALK) as walk:
        show(browser, walk.link)
        browser.wait("surefoot.tick > 500", 60)  # while it stands still little friction is enough
        pause(browser)
        browser.click("#tab-tune")
        browser.run("""(() => { const field = document.querySelector('#friction'); field.value = field.min;
          field.dispatchEvent(new Event('change')); })()""")
        browser.click("#tab-hierarchy")
        at_limit = "surefoot.levels().some(one => one.name === 'friction_cone' && one.active.length > 0)"
        step_until(browser, at_limit, "a limit", ticks=400)
        browser.wait("surefoot.levels().every(one => document.querySelector(`.level[data-level=${one.name}]`)"
                     ".dataset.status === one.status.replaceAll(' ', '-'))")
        cards = browser.run("[...document.querySelectorAll('.level')].map(one => "
                            "[one.dataset.status, one.textContent, getComputedStyle(one).borderLeftColor])")
        browser.screenshot(SCREENSHOTS / "limit.png")
        held = [card for card in cards if card[0] in ("at-limit", "gives-way")]
        assert held
        assert all("bound" in text or "gives way" in text for _, text, _ in held)
        assert {colour for *_, colour in held}.isdisjoint({colour for status, _, colour in cards if status == "met"})


def test_a_run_that_has_ended_can_only_be_begun_again(browser):
    with Served("run", "walk_flat_ideal", "--view", "--set", "duration=1") as short, Page(short) as hand:
        hand.do("pause")
        show(browser, short.link)
        browser.click("#tab-drive")
        hand.do("resume")
        browser.wait("surefoot.status.ended !== null && /The run has ended/.test(document.querySelector('#asked').textContent)", 60)
        assert browser.run(f"{CONTROLS}.every(one => one.matches(':disabled'))")
        browser.press("r")
        browser.wait(f"surefoot.status.ended === null && {CONTROLS}.every(one => !one.matches(':disabled'))", 60)
