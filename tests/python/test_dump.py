"""`surefoot dump` as its user sees it: what it writes is what `solve` reads."""

import json
import re

from program import complaint, surefoot

WALK = ["dump", "walk_flat", "--set", "duration=0.2"]


def tick():
    result = surefoot(*WALK, "--to", 0.0025)
    assert (result.returncode, result.stderr) == (0, "")
    return result.stdout


def test_a_row_between_two_bounds_stays_one_row_and_rows_have_names_and_ids():
    levels = {level["name"]: level for level in json.loads(tick())["levels"]}
    for level in levels.values():
        assert all(len(level[block]) == len(level[f"{block}_names"]) == len(level[f"{block}_ids"]) for block in "AD")
    torques = levels["torque_limits"]
    assert len(torques["D_names"]) == len(set(torques["D_names"])) == 12
    assert all(low == -high for low, high in zip(torques["lower"], torques["f"]))
    assert len(set(levels["friction_cone"]["D_ids"])) == len(levels["friction_cone"]["D"]) > 0


def test_solve_explains_a_dump_by_the_names_of_its_rows(tmp_path):
    file, problem = tmp_path / "tick.jsonl", json.loads(tick())
    limits = next(level for level in problem["levels"] if level["name"] == "torque_limits")
    weak = limits["D_names"][2]
    limits["lower"][2], limits["f"][2] = -1e-3, 1e-3  # less than standing takes
    file.write_text(json.dumps(problem))
    text = surefoot("solve", file, "--explain").stdout
    assert "torque_limits" in text and f"{weak} (" in text and "D 3" not in text


def test_help_says_when_the_first_foot_is_lifted():
    words = " ".join(surefoot("dump", "--help").stdout.split())
    for scenario in ["walk_flat", "walk_flat_sea"]:
        lifted = float(re.search(r"([0-9.]+) s into " + scenario + r"\b", words)[1])
        for time, feet in [(lifted - 0.05, 4), (lifted + 0.05, 3)]:
            line = surefoot("dump", scenario, "--from", time, "--to", time + 0.0025).stdout.splitlines()[0]
            friction = next(level for level in json.loads(line)["levels"] if level["name"] == "friction_cone")
            assert len({name[:2] for name in friction["D_names"]}) == feet, (scenario, time)


def test_errors_are_one_line_and_leave_nothing(tmp_path):
    assert "no tick" in complaint(*WALK, "--from", 7, "--out", tmp_path / "ticks.jsonl")
    assert "--every" in complaint(*WALK, "--every", 0)
    assert list(tmp_path.iterdir()) == []
