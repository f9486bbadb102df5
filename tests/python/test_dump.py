"""`surefoot dump` as its user sees it: what it writes is what `solve` reads, and errors are one line."""

import json
import re

from program import complaint, surefoot

WALK = ["dump", "walk_flat", "--set", "duration=0.2"]


def test_what_is_dumped_is_what_solve_reads(tmp_path):
    file = tmp_path / "ticks.jsonl"
    result = surefoot(*WALK, "--from", 0.1, "--to", 0.15, "--every", 5, "--out", file)
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")
    problems = [json.loads(line) for line in file.read_text().splitlines()]
    assert len(problems) == 4
    for level in problems[0]["levels"]:
        assert len(level["A"]) == len(level["b"]) == len(level["A_names"])
        assert len(level["D"]) == len(level["f"]) == len(level["D_names"])
        assert [len(level[f"{block}_ids"]) for block in "AD"] == [len(level["A"]), len(level["D"])]
    answers = surefoot("solve", file, "--certify")
    assert answers.returncode == 0, answers.stderr
    assert len(answers.stdout.splitlines()) == 4


def test_a_row_between_two_bounds_stays_one_row():
    levels = {level["name"]: level for level in json.loads(tick())["levels"]}
    torques = levels["torque_limits"]
    assert len(torques["D_names"]) == len(set(torques["D_names"])) == 12
    assert all(low == -high for low, high in zip(torques["lower"], torques["f"]))
    assert len(set(levels["friction_cone"]["D_ids"])) == len(levels["friction_cone"]["D"]) > 0


def test_solve_explains_a_dump_by_the_names_of_its_rows(tmp_path):
    file = tmp_path / "tick.jsonl"
    problem = json.loads(tick())
    limits = next(level for level in problem["levels"] if level["name"] == "torque_limits")
    weak = limits["D_names"][2]
    limits["lower"][2], limits["f"][2] = -1e-3, 1e-3  # less than standing takes
    file.write_text(json.dumps(problem))
    text = surefoot("solve", file, "--explain").stdout
    assert "torque_limits" in text and f"{weak} (" in text
    assert "D 3" not in text


def tick():
    result = surefoot(*WALK, "--to", 0.0025)
    assert result.returncode == 0, result.stderr
    return result.stdout


def test_help_says_when_the_first_foot_is_lifted():
    words = " ".join(surefoot("dump", "--help").stdout.split())
    for scenario in ["walk_flat", "walk_flat_sea"]:
        lifted = float(re.search(r"([0-9.]+) s into " + scenario + r"\b", words)[1])
        for time, feet in [(lifted - 0.05, 4), (lifted + 0.05, 3)]:
            line = surefoot("dump", scenario, "--from", time, "--to", time + 0.0025).stdout.splitlines()[0]
            friction = next(level for level in json.loads(line)["levels"] if level["name"] == "friction_cone")
            assert len({name[:2] for name in friction["D_names"]}) == feet, (scenario, time)


def test_without_a_file_it_writes_to_standard_output():
    result = surefoot(*WALK, "--to", 0.005)
    assert result.returncode == 0, result.stderr
    assert len(result.stdout.splitlines()) == 2


def test_a_log_gives_the_ticks_of_its_run(log, tmp_path):
    result = surefoot("dump", log, "--from", 1, "--to", 1.01)
    assert (result.returncode, result.stderr) == (0, "")
    assert len(result.stdout.splitlines()) == 4


def test_errors_are_one_line_and_leave_nothing(tmp_path):
    file = tmp_path / "ticks.jsonl"
    assert "no tick" in complaint(*WALK, "--from", 7, "--out", file)
    assert "--from is nan" in complaint(*WALK, "--from", "nan")
    assert "--to is 1;" in complaint(*WALK, "--from", 2, "--to", 1)
    assert "--every" in complaint(*WALK, "--every", 0)
    assert "no_such_scenario" in complaint("dump", "no_such_scenario")
    assert "missing.mcap" in complaint("dump", tmp_path / "missing.mcap")
    assert "ticks.jsonl" in complaint(*WALK, "--out", tmp_path / "no/ticks.jsonl")
    assert list(tmp_path.iterdir()) == []
