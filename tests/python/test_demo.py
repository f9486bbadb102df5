"""The demo's experiments and its page. How it is interrupted: test_interrupts.py."""

import io
import re
import subprocess

from program import PROGRAM, SHORT, run_result
from surefoot_campaign.demo import Links, Row, headline, measured
from surefoot_campaign.demo_page import demo_page
from surefoot_campaign.experiments import EXPERIMENTS
from surefoot_campaign.program import Program
from surefoot_campaign.progress import Progress


def test_every_experiment_can_be_read_and_shows_metrics_that_exist():
    run = run_result("walk_flat", *SHORT)
    for experiment in EXPERIMENTS:
        assert Program(PROGRAM).about(experiment.words())["description"]
        assert experiment.shown and set(experiment.shown) <= set(run)
    assert len({experiment.name for experiment in EXPERIMENTS}) == len(EXPERIMENTS)


def test_those_over_seeds_have_something_to_draw_and_pair():
    drawn = [run_result(*experiment.words()[1:], "--seed=1", *SHORT)["drawn"] for experiment in EXPERIMENTS if experiment.seeds]
    assert len(drawn) > 1 and drawn[0] and all(one == drawn[0] for one in drawn)


def test_what_is_measured_stands_beside_what_is_asked():
    (walk,) = [experiment for experiment in EXPERIMENTS if experiment.name == "walk_flat"]
    run = {"com_error_max_m": 0.0004, "com_lateral_sway_m": 0.03, "speed_mps": 0.1,
           "criteria": [{"metric": "com_error_max_m", "max": 0.0005, "value": 0.0004, "passed": True}]}  # fmt: skip
    assert measured(walk, run) == "com_error_max_m 0.4 mm (≤ 0.5 mm ✓), com_lateral_sway_m 30 mm, speed_mps 0.1 m/s"
    assert measured(walk, {"crashed": True, "reason": "killed by SIGSEGV"}) == "killed by SIGSEGV"


def test_the_headline_is_the_first_metric_in_words_where_it_is_one():
    step, push = ([one for one in EXPERIMENTS if one.name == name][0] for name in ("step_down", "push"))
    assert [headline(step, {"goal_reached": reached})[0] for reached in (True, False)] == ["goal reached", "goal not reached"]
    assert headline(push, {"reason": "fell"}) == ("fell", "")
    assert headline(EXPERIMENTS[0], {"com_error_max_m": 0.0004}) == ("0.4 mm", "com_error_max_m")


def of_page(**more):
    row = {"name": "step <1>", "description": "a & b", "headline": "0.4 mm", "headline_metric": "com_error_max_m", "headline_paper": "≤ 3.4 mm",
           "measured": "much", "seeds": "3 of 4", "paper": "", "verdict": "✓", "report": "step/index.html", "picture": "step/strip.jpg"}  # fmt: skip
    return demo_page([Row(**(row | more))], "all of it")


def test_the_page_shows_picture_headline_and_paper_and_escapes():
    page = of_page()
    for part in ('<a href="step/index.html">step &lt;1&gt;</a>', "a &amp; b", "3 of 4", "✓ as it must be", '<p class="soft">all of it</p>',
                 'src="step/strip.jpg"', '0.4 mm <small title="com_error_max_m">', "paper: ≤ 3.4 mm", "1 as they must be; 0 show"):  # fmt: skip
        assert part in page
    assert "http" not in page and "<img" not in of_page(picture="")
    assert '<article class="bad">' in of_page(verdict="✗") and "0 as they must be, 1 not" in of_page(verdict="✗")
    assert '<article class="found">' in of_page(verdict="as found")


def test_its_figures_are_told_in_words_and_the_papers_experiment_stands_first():
    assert "↓</small>" in of_page() and "com_error_max_m</small>" not in of_page()
    rows = [Row(name, "", "", "", "", "", "", "", "✓", "") for name in ("walk_flat", "step_down")]
    page = demo_page(rows, "", first="step_down")
    assert page.index("<h2>step_down") < page.index("<h2>walk_flat")


def test_the_links_of_the_papers_experiment_come_first(tmp_path):
    links, row = Links(tmp_path), {"reason": "goal reached"}
    assert links("walk_flat", 0, row) == [] and links("push", 3, row) == []
    first, second = links("step_down", 0, row)
    assert first.startswith("step_down: goal reached file://") and second.startswith("walk_flat: ")
    assert [line.partition(":")[0] for line in links("push", 0, row)] == ["push"]


def test_it_says_how_long_it_will_take_before_anything_has_run(tmp_path):
    with subprocess.Popen([PROGRAM, "demo", "--out", tmp_path / "demo", "--seeds", "1"], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True) as demo:
        first = demo.stderr.readline()
        demo.terminate()
    assert re.match(rf"{len(EXPERIMENTS)} experiments of the paper in \d+ runs, 2 at a time: about \d+ (s|min), step_down first; reports go to ", first), first


def test_a_terminal_has_a_bar_before_the_first_run_has_ended():
    stream = io.StringIO()
    stream.isatty = lambda: True
    with Progress("experiments", 0, 45, stream=stream):
        assert "experiments ░" in stream.getvalue() and "0 of 45 runs" in stream.getvalue()
