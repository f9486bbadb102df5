"""Several seeds: what their rows come to, as JSON and as a table, and runs that break, with a fake program."""

import json
import os
import subprocess
import sys

import pytest

from campaign_folder import FAKE, ROOT
from program import complaint
from surefoot_campaign.seeds import all_the_same, enough_succeeded, seeds_json, seeds_line, seeds_table
from surefoot_campaign.text import aligned, asked_of, pretty, printable

ABOUT = {
    "scenario": "trial", "robot": "fake", "stack": "walk", "estimation": "sensors", "foot_force_sensor": False, "version": "1", "description": "",
    "has_goal": False, "success_rate": 1.0, "paper": {"com_error_max_m": "≤ 3.4 mm"},
    "metrics": {"com_error_max_m": {"worst": "greatest"}, "speed_mps": {"worst": "least"}, "tick_us.p99": {"worst": "greatest"}},
}  # fmt: skip


def row(succeeded=True, com_error=0.001, speed=0.2, **more):
    return {"seed": 1, "succeeded": succeeded, "fell": not succeeded, "com_error_max_m": com_error, "speed_mps": speed,
            "reason": "why", "criteria": [], "goal_reached": None, "events": []} | more  # fmt: skip


CRASH = {"seed": 7, "succeeded": False, "crashed": True, "reason": "killed by SIGSEGV"}
FOUR = [row(True, 0.001, 0.2), row(True, 0.004, 0.1), row(True, 0.002, 0.3), CRASH]


def test_every_rate_has_wilsons_interval_and_a_crash_is_a_row():
    found = seeds_json(ABOUT, FOUR)
    assert found["rates"]["succeeded"] == {"successes": 3, "trials": 4, "rate": 0.75, "interval": pytest.approx([0.3006, 0.9544], abs=1e-4)}
    assert found["rates"]["crashed"]["successes"] == 1 and "goal_reached" not in found["rates"]
    assert found["runs"][3] == CRASH
    reached = seeds_json(ABOUT | {"has_goal": True}, [row(goal_reached=True), CRASH])
    assert reached["rates"]["goal_reached"]["successes"] == 1


def test_the_worst_error_is_the_largest_and_the_worst_speed_the_smallest():
    metrics = seeds_json(ABOUT, FOUR)["metrics"]
    assert metrics == {"com_error_max_m": {"median": 0.002, "worst": 0.004}, "speed_mps": {"median": 0.2, "worst": 0.1}}
    assert seeds_json(ABOUT, FOUR[:2])["metrics"]["com_error_max_m"]["median"] == 0.0025
    timed = seeds_json(ABOUT, [row(tick_us={"p99": 300}), row(tick_us={"p99": 100})])["metrics"]
    assert timed["tick_us.p99"] == {"median": 200.0, "worst": 300.0}


def test_enough_succeed_or_they_do_not():
    for rate, enough in ((0.75, True), (0.76, False), (0.0, True)):
        assert enough_succeeded(ABOUT | {"success_rate": rate}, FOUR) == enough


def event(name, count, leg="LF"):
    return {"event": name, "leg": leg, "count": count, "first_s": 5.25}


def test_events_are_summed_up_over_legs_and_runs():
    rows = [row(events=[event("slip", 3), event("slip", 1, "RF")]), row(events=[event("edge", 1)]), row(), CRASH]
    found = seeds_json(ABOUT, rows)
    assert found["events"] == [{"event": "slip", "runs": 1, "count": 4}, {"event": "edge", "runs": 1, "count": 1}]
    assert "slip   in 1 of 4 runs   4 times in all\nedge   in 1 of 4 runs   once in all\n" in seeds_table(ABOUT, found)


def test_runs_that_differ_in_seed_and_time_alone_are_the_same():
    one, two, other = row(realtime_factor=1.0), row(seed=2, realtime_factor=2.0), row(seed=2, com_error=0.1)
    assert all_the_same([one, two])
    assert not all_the_same([one, other]) and not all_the_same([one]) and not all_the_same([CRASH, CRASH])


def test_the_table_tells_why_runs_failed_and_what_the_metrics_come_to_also_one_that_is_asked_for_and_has_no_value():
    missed = [{"metric": "com_error_max_m", "max": 0.0005, "value": 0.0006, "passed": False}, {"metric": "fell", "equals": False, "value": True, "passed": False},
              {"metric": "tick_us.p99", "max": 300.0, "value": None, "passed": False},
              {"metric": "speed_mps", "min": 0.1, "max": 0.3, "value": 0.2, "passed": True}]  # fmt: skip
    about = ABOUT | {"foot_force_sensor": True, "description": "a walk"}
    rows = [row(False, 0.0006, criteria=missed), CRASH]
    assert seeds_table(about, seeds_json(about, rows)).splitlines() == [
        "trial, robot fake, stack walk, estimation sensors, foot force sensors: a walk",
        "",
        "seed 1   why; com_error_max_m 0.6 mm, must be ≤ 0.5 mm ✗; fell must be no ✗; tick_us.p99 –, must be ≤ 300 µs ✗",
        "seed 7   killed by SIGSEGV",
        "",
        "succeeded     0 of 2 (95 %: 0 … 66 %)",
        "fell          1 of 2 (95 %: 9 … 91 %)",
        "safety_stop   0 of 2 (95 %: 0 … 66 %)",
        "crashed       1 of 2 (95 %: 9 … 91 %)",
        "",
        "                  median    worst         paper",
        "com_error_max_m   0.6 mm    0.6 mm    ↓   ≤ 3.4 mm",
        "speed_mps         0.2 m/s   0.2 m/s   ↑",
        "tick_us.p99       –         –         ↓",
        "↓ smaller is better, ↑ larger; `surefoot list metrics` says what each is",
    ]
    assert asked_of(rows[0], "speed_mps") == "≥ 0.1 m/s, ≤ 0.3 m/s ✓" and asked_of(rows[0], "distance_m") == ""
    assert seeds_line(about, seeds_json(about, rows)) == "succeeded 0 of 2 (95 %: 0 … 66 %), fell 1"


PRETTY = [("com_error_max_m", 0.00012, "0.12 mm"), ("distance_m", 1.85, "1.85 m"), ("torque_max_nm", 40, "40 N·m"), ("speed_mps", 0.08, "0.08 m/s"),
          ("duration_s", 24, "24 s"), ("steps_taken", 30, "30"), ("fell", False, "no"), ("com_error_max_m", None, "–"), ("reason", "fell", "fell"),
          ("com_lateral_sway_m", 0.139, "139 mm"), ("com_lateral_sway_m", 0.0317, "31.7 mm"), ("distance_m", 0.0317, "0.0317 m"), ("max_tilt_rad", 0.1, "5.73°"),
          ("tick_us", {"median": 40.0, "p99": 60.0, "max": 90.0}, "median 40 µs, 99 % 60 µs, max 90 µs")]  # fmt: skip


@pytest.mark.parametrize("metric, value, text", PRETTY)
def test_a_metric_is_written_in_one_unit_whatever_its_value(metric, value, text):
    assert pretty(metric, value) == text


def test_columns_start_together_and_nothing_moves_the_cursor():
    assert aligned([["µ", "x"], ["abc"]]) == "µ     x\nabc\n"
    assert printable("a\x1b[2J\x9b\nb") == "a\\u001b[2J\\u009b\nb"


def seeds(*words, cwd=None):
    """As the program hands its arguments over."""
    environment = os.environ | {"PYTHONPATH": str(ROOT / "python"), "SUREFOOT_PROGRAM": str(FAKE)}
    command = [sys.executable, "-m", "surefoot_campaign.seeds", "fake", "--first=1", *words]
    return subprocess.run(command, capture_output=True, text=True, env=environment, cwd=cwd, timeout=120)


def test_a_run_that_crashes_is_a_row_and_the_others_go_on():
    done = seeds("--seeds=3", "--jobs=2", "--set=mode=crash", "--set=broken_seed=2", "--json")
    found = json.loads(done.stdout)
    assert [run["seed"] for run in found["runs"]] == [1, 2, 3]
    assert found["runs"][1] == {"seed": 2, "succeeded": False, "crashed": True, "reason": "killed by SIGSEGV"}
    assert done.returncode == 1 and "seed 2: did not succeed, killed by SIGSEGV" in done.stderr.splitlines()


def test_runs_that_were_not_judged_are_in_no_rate_and_leave_the_verdict_open():
    rows = [row(), row(succeeded=None), row(succeeded=None)]
    found = seeds_json(ABOUT, rows)
    assert (found["rates"]["succeeded"]["successes"], found["rates"]["succeeded"]["trials"]) == (1, 1)
    assert "seed" not in seeds_table(ABOUT, found)
    assert not enough_succeeded(ABOUT, rows) and enough_succeeded(ABOUT, rows, also=None) and not enough_succeeded(ABOUT, [*rows, row(False)], also=None)


def test_notes_of_the_scenario_are_told_once_and_complaints_of_a_run_each_time():
    lines = seeds("--seeds=2", "--jobs=1", "--set=noted=1").stderr.splitlines()
    assert lines.count("surefoot: warning: a note") == 1 and lines.count("surefoot: warning: x.mp4 was not filmed") == 2


def test_what_the_program_refuses_is_told_before_any_run():
    done = seeds("--seeds=2", "--jobs=1", "--set=hieght=3")
    assert (done.returncode, done.stdout) == (2, "") and done.stderr.startswith("surefoot: --set hieght=3: hieght: unknown key; ")


def test_without_python_one_sentence_says_what_seeds_need():
    alone = {key: value for key, value in os.environ.items() if key != "SUREFOOT_PYTHON"}
    assert complaint("run", "walk_flat", "--seeds", 2, env=alone) == (
        "surefoot: --seeds: Python does this, and the program was started without it: "
        "use the `surefoot` of `pip install`, or bin/surefoot of the source tree"
    )
