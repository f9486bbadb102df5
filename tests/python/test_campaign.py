"""Campaigns: what is run, what is kept when something goes wrong, and that the machine makes no difference."""

import json
import os
import pathlib
import re
import shlex
import signal
import subprocess
import sys
import time
from types import SimpleNamespace

import pytest

from campaign_folder import CASES, SPEC, CampaignFolder, is_running
from log_file import rows_of
from program import PROGRAM, ROOT, answer, complaint, run_result, surefoot
from surefoot_campaign.results import Record
from surefoot_campaign.worst import worst


@pytest.fixture
def folder(tmp_path):
    return CampaignFolder(tmp_path).write()


def started_until(folder, count, *words):
    """A campaign that goes on, of which so many runs are finished."""
    process = folder.start(*words)
    while not (folder.out / "rows.jsonl").exists() or len(folder.rows()) < count:
        time.sleep(0.02)
    return process


def hanging(folder, *words):
    """A campaign whose program hangs, and the process of that."""
    process, pids = folder.start(*words), folder.path / "pids"
    while not pids.exists() or not pids.read_text():
        time.sleep(0.02)
    return process, int(pids.read_text().split()[0])


def table(folder):
    return rows_of(folder.out / "runs.csv")


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A campaign that came to its end, to look at; and its summary."""
    folder = CampaignFolder(tmp_path_factory.mktemp("finished"), plots=True).write()
    return folder, folder.result()


def test_every_point_runs_with_every_seed_once_and_stands_in_the_table(finished):
    folder, found = finished
    assert found["runs"]["planned"] == found["runs"]["finished"] == 8
    runs = [(seed, float(parameters["height"])) for _, seed, parameters in folder.started()]
    assert sorted(runs) == sorted((seed, height) for seed in range(1, 5) for height in (0.1, 0.3))
    rows = table(folder)
    assert [(float(row["height"]), int(row["seed"])) for row in rows] == [(h, s) for h in (0.1, 0.3) for s in range(1, 5)]
    for name in ["id", "version", "mass", "gait", "outcome", "reason", "com_error_max_m", "drawn.friction", "wall_time_s"]:
        assert all(row[name] for row in rows), name
    assert list(rows[0])[-2:] == ["tick_us.median", "wall_time_s"]  # what the clock decides stands last


def test_what_is_drawn_depends_on_the_seed_alone(finished):
    masses = {}
    for row in table(finished[0]):
        masses.setdefault(row["seed"], set()).add(row["mass"])
    assert all(len(of_seed) == 1 for of_seed in masses.values())
    assert len({mass for of_seed in masses.values() for mass in of_seed}) == 4


def test_csv_and_parquet_hold_the_same_beside_plots_and_the_worst(finished):
    """Plots for each parameter and each pair."""
    import pyarrow.parquet

    folder, _ = finished
    columns, rows = pyarrow.parquet.read_table(folder.out / "runs.parquet").to_pydict(), table(folder)
    assert list(columns) == list(rows[0])
    assert columns["id"] == [row["id"] for row in rows]
    assert columns["seed"] == [int(row["seed"]) for row in rows]
    assert columns["com_error_max_m"] == [float(row["com_error_max_m"]) for row in rows]
    assert columns["fell"] == [row["fell"] == "true" for row in rows]
    names = {file.name for file in (folder.out / "plots").iterdir()}
    assert names == {f"{name}.{form}" for name in ("height", "mass", "height__mass") for form in ("png", "svg")}
    assert f"The commands work in `{folder.path}`" in (folder.out / "worst.md").read_text()


def test_a_tool_makes_the_readmes_rows_of_the_table_and_keeps_the_runs_short(tmp_path):
    runs, kept = tmp_path / "runs.csv", tmp_path / "kept.csv"
    lines = ["scenario,seed,version,outcome,missed,reason,com_error_max_m,touchdown_latency_p95_s,touchdowns_noticed,touchdowns_late,false_touchdowns,steps_taken,torque_step_max_nm,more"]
    lines += [f"deep/walk.yaml,{seed},1.0,succeeded,,goal reached,0.00{seed},0.0{seed},500,{seed},0,600,{seed},0" for seed in (3, 2, 1)]
    runs.write_text("\n".join([*lines, "deep/walk.yaml,4,1.0,failed,fell,the controller stopped for safety at 1.5 s: IMU did not fit the rest,0.123456789,,0,0,1,200,,0"]))
    table = "| `walk` | 3 (30.1–95.4 %) | 2, 2.8, 3 | 1 of 2,000 | 2, 2.8, 3 |"

    def tool(*words):
        return subprocess.run([sys.executable, ROOT / "tools/campaign_table.py", *words], capture_output=True, text=True,
                              env={"PYTHONPATH": str(ROOT / "python")})

    def made(*words):
        done = tool(*words)
        assert done.returncode == 0, done.stderr
        return done.stdout

    printed = made(runs, "--keep", kept)
    assert "| `walk` | 20, 100 %, 99.6 % | – | – | – |" in printed
    assert table in printed and "walk, of 4 failed, in 1 a sensor was blamed: 4 (fell; the controller stopped for safety at 1.5 s: IMU did not fit the rest)" in printed
    assert made(kept) == printed and "Of 1.0 (4)" in printed
    twice = tool(runs, kept)
    assert twice.returncode == 1 and "walk with seed 1 stands there twice" in twice.stderr
    rows = [row.split(",") for row in kept.read_text().splitlines()]
    assert [row[1] for row in rows] == ["seed", "1", "2", "3", "4"]
    assert {row[0] for row in rows[1:]} == {"walk"}
    assert "more" not in rows[0] and "goal reached" not in rows[1] and "0.12346" in rows[4]

    cases = tmp_path / "cases.csv"
    cases.write_text("scenario,seed,version,case,outcome,missed,reason\n" +
                     "\n".join(f"walk,{seed},1.0,{case},succeeded,,ok" for case in ("soft", "stiff") for seed in (1, 2)))
    printed = made(cases, "--keep", kept)
    assert "| `walk, soft` | 2 (34.2–100 %)" in printed and "| `walk, stiff` | 2 (34.2–100 %)" in printed
    assert made(kept) == printed


def test_results_are_the_same_for_any_number_of_jobs(tmp_path):
    found = []
    for jobs in (1, 2):
        (tmp_path / str(jobs)).mkdir()
        folder = CampaignFolder(tmp_path / str(jobs), plots=True).write()
        summary = folder.result("--jobs", jobs)
        rows = [{k: v for k, v in row.items() if k not in ("tick_us.median", "wall_time_s")} for row in table(folder)]
        files = {file.name: file.read_bytes() for file in [folder.out / "rates.csv", *(folder.out / "plots").iterdir()]}
        found.append((summary, rows, files))
    assert found[0] == found[1]


def test_started_again_it_runs_nothing_twice_and_says_the_same_and_more_seeds_add_to_what_is_there(folder):
    first = folder.result()
    assert folder.result() == first
    assert len(folder.started()) == 8
    folder.write(SPEC.replace("count: 4", "count: 6")).result()
    assert len(folder.started()) == len(table(folder)) == 12


def contents(folder):
    return {file.name: file.read_bytes() for file in folder.out.iterdir()}


def test_a_campaign_of_another_name_does_not_take_the_place_of_what_is_there(folder):
    folder.write("name: first\n" + SPEC).result()
    (folder.out / "summary.json").unlink()  # as where it was killed
    before = contents(folder)
    folder.write("name: second\n" + SPEC.replace("count: 4", "count: 5"))
    for words in ([], ["--dry-run"]):
        done = folder.run(*words)
        assert done.returncode == 2 and done.stdout == "" and contents(folder) == before and len(folder.started()) == 8
        (line,) = done.stderr.splitlines()
        for word in (str(folder.out), '"first"', '"second"', "--out"):
            assert word in line


def test_killed_and_started_again_it_goes_on_where_it_was(folder):
    folder.write(SPEC.replace("set:", "set:\n  mode: slow").replace("count: 4", "count: 10"))
    process = started_until(folder, 3, "--jobs", 2)
    process.kill()
    process.communicate()
    kept = {row["id"] for row in folder.rows()}
    assert 3 <= len(kept) < 20
    begun = len(folder.started())
    again = folder.run("--jobs", 2, "--json")
    assert json.loads(again.stdout)["runs"]["finished"] == 20
    assert f"{len(kept)} of 20 runs are done already, {20 - len(kept)} to do\n" in again.stderr
    ids = [row["id"] for row in folder.rows()]
    assert len(ids) == len(set(ids)) == 20 and kept < set(ids)
    assert len(folder.started()) - begun == 20 - len(kept)


def test_runs_end_with_a_campaign_that_is_killed(folder):
    folder.write(SPEC.replace("set:", "set:\n  mode: hang"))
    process, program = hanging(folder, "--jobs", 1)
    process.kill()
    process.communicate()
    deadline = time.monotonic() + 5
    while is_running(program) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not is_running(program)


def test_a_torn_last_line_is_dropped_and_its_run_made_again(folder):
    first = folder.result()
    path = folder.out / "rows.jsonl"
    lines = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(b"".join(lines[:-1]) + lines[-1][:40])
    again = folder.run("--json")
    assert json.loads(again.stdout) == first
    assert "7 of 8 runs are done already, 1 to do; its last row was torn and is dropped\n" in again.stderr
    assert len(folder.rows()) == 8 and len(folder.started()) == 9


BROKEN = {
    "crash": ("crashed", "killed by SIGSEGV"),
    "abort": ("crashed", "killed by SIGABRT: assertion failed"),
    "hang": ("timed_out", "no end within 4 s of wall clock"),
    "babble": ("crashed", "exit code 0, but its output is no result"),
    "refuse": ("refused", "period: 0.3 s is not a whole multiple of the timestep"),
}


def test_what_breaks_is_a_row_with_its_reason_and_the_others_go_on(folder):
    folder.write(f"scenario: fake\nseeds: [1]\ngrid: {{mode: [{', '.join(BROKEN)}, walk]}}\ntimeout: 4\n")
    found = folder.result("--jobs", 2, status=1)
    rows = {row["mode"]: (row["outcome"], row["reason"]) for row in table(folder)}
    assert rows == BROKEN | {"walk": ("succeeded", "goal reached")}
    assert found["all"]["trials"] == 6 and found["runs"] == {
        "planned": 6, "finished": 6, "succeeded": 1, "failed": 0, "not_judged": 0, "crashed": 3, "timed_out": 1, "refused": 1
    }  # fmt: skip
    assert [entry["outcome"] for entry in found["worst"]][-1] == "succeeded"
    # It ends with all its processes.
    pids = [int(pid) for pid in (folder.path / "pids").read_text().split()]
    assert len(pids) == 2 and not any(map(is_running, pids))


def test_what_broke_is_made_again_only_where_it_is_asked_for(folder):
    folder.write("scenario: fake\nseeds: [1, 2]\nset: {mode: crash, broken_seed: 2}\n")
    folder.result(status=1)
    folder.result(status=1)
    assert len(folder.started()) == 2
    assert "1 of 2 runs crashed, took too long or were refused; --retry makes them again" in folder.run().stderr
    folder.result("--retry", status=1)
    assert len(folder.started()) == 3 and len(table(folder)) == 2


def test_a_run_that_was_ended_from_outside_has_no_row(folder):
    folder.write("scenario: fake\nseeds: [1, 2]\nset: {mode: interrupted, broken_seed: 2}\n")
    done = folder.run()
    assert done.returncode == 2 and "1 of 2 runs are finished and kept; to go on: " in done.stderr
    assert [row["seed"] for row in folder.rows()] == [1]


@pytest.mark.parametrize("which", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupt_keeps_what_is_finished_and_says_how_to_go_on(folder, which):
    folder.write(SPEC.replace("set:", "set:\n  mode: slow").replace("count: 4", "count: 200"))
    process = started_until(folder, 2, "--jobs", 2)
    process.send_signal(which)
    out, err = process.communicate(timeout=30)
    assert process.returncode == 2
    finished = len(folder.rows())
    assert f"surefoot: interrupted: {finished} of 400 runs are finished and kept; to go on: " in err.splitlines()[-1]
    assert err.rstrip().endswith(shlex.join(["campaign", *folder.command()[3:], "--jobs", "2"]))
    assert len(table(folder)) == finished and "succeeded" in out
    assert not (folder.out / "program").exists()


def test_two_campaigns_do_not_write_into_one_folder(folder):
    folder.write("scenario: fake\nseeds: [1]\nset: {mode: hang}\n")
    process, _ = hanging(folder)
    done = folder.run()
    process.terminate()
    process.communicate()
    assert done.returncode == 2 and "another campaign writes to" in done.stderr


def spoilt_meanwhile(folder, spoil):
    """The rows of a campaign whose scenario's file is spoilt after two of its twenty runs; that ends it."""
    (folder.path / "mine.yaml").write_text("before")
    folder.write("scenario: mine.yaml\nseeds: {count: 20}\nset: {mode: slow}\n")
    process = started_until(folder, 2, "--jobs", 1)
    spoil(folder.path / "mine.yaml")
    _, err = process.communicate(timeout=30)
    assert process.returncode == 2 and "changed while the campaign ran" in err
    return folder.rows()


def test_a_file_that_changes_while_the_campaign_runs_ends_it(folder):
    kept = len(spoilt_meanwhile(folder, lambda file: file.write_text("after")))
    found = folder.result()
    assert found["runs"]["finished"] == 20 and len(folder.rows()) == kept + 20  # no row of before counts


def test_a_file_that_is_no_scenario_any_more_ends_the_campaign_too(folder):
    rows = spoilt_meanwhile(folder, lambda file: file.unlink())
    assert {row["outcome"] for row in rows} <= {"succeeded", "failed"}


def test_a_dry_run_lists_what_would_run_and_writes_nothing(folder):
    done = folder.run("--dry-run")
    lines = done.stdout.splitlines()
    assert done.returncode == 0 and not folder.out.exists() and folder.started() == []
    assert len(lines) == 9 and all(line.startswith("to do ") for line in lines[:8])
    assert lines[-1].startswith("8 runs, 0 done, 8 to do")
    folder.result()
    folder.write(SPEC.replace("count: 4", "count: 5"))
    assert folder.run("--dry-run").stdout.splitlines()[-1].startswith("10 runs, 8 done, 2 to do")
    found = json.loads(folder.run("--dry-run", "--json").stdout)
    assert (found["planned"], found["done"], len(found["runs"])) == (10, 8, 10)


def test_a_table_goes_to_stdout_and_the_worst_tell_which_criteria_they_missed(folder):
    folder.write(SPEC.replace("count: 4", "count: 12"))
    done = folder.run()
    lines = done.stdout.splitlines()
    assert done.returncode == 0
    assert lines[0].split()[:3] == ["scenario", "height", "succeeded"] and len(lines[1].split()) > 5 and "digest" in lines[-1]
    (line,) = [line for line in lines if line.startswith("worst: ")]
    assert line.startswith("worst: failed: fell; missed: fell; com_error_max_m ") and line.endswith(" mm")
    assert re.search(r"1\. failed: fell; missed: fell; com_error_max_m [\d.]+ mm", (folder.out / "worst.md").read_text())


def test_the_worst_failed_first_and_then_by_the_metric_that_the_spec_names(folder):
    folder.write(SPEC.replace("count: 4", "count: 12") + "judge: speed_mps\n")
    found = folder.result()
    order = [entry["outcome"] == "succeeded" for entry in found["worst"]]
    assert len(order) == 10 and order == sorted(order)
    folder.write(SPEC.replace("count: 4", "count: 12"))
    failed = [entry["com_error_max_m"] for entry in folder.result()["worst"] if entry["outcome"] == "failed"]
    assert len(failed) > 1 and failed == sorted(failed, reverse=True)


def test_a_fall_a_stop_or_a_crash_is_worse_than_any_missed_criterion():
    results = [("crashed", {}), ("failed", {"safety_stop": True, "com_error_max_m": 0.2}), ("failed", {"fell": True, "com_error_max_m": 0.1}),
               ("failed", {"safety_stop": False}), ("failed", {"com_error_max_m": 9.0}), ("succeeded", {"com_error_max_m": 10.0})]  # fmt: skip
    records = [Record(None, {"outcome": outcome, "result": result or None}) for outcome, result in results]
    plan = SimpleNamespace(spec=SimpleNamespace(judge="com_error_max_m"), metrics={"com_error_max_m": {"worst": "greatest"}})
    assert worst(plan, [records[place] for place in (4, 3, 5, 2, 1, 0)]) == records


def test_cases_are_compared_with_the_first_seed_by_seed(tmp_path):
    folder = CampaignFolder(tmp_path, plots=True).write(CASES)
    found = folder.result(status=1)
    of_seed = {(row["scenario"], row["case"], row["seed"]): row for row in table(folder)}
    assert len(of_seed) == 2 * 3 * 8
    assert {row["mass"] for (_, case, _), row in of_seed.items() if case == "as it is"} == {""}
    assert [(point["scenario"], point["parameters"]["case"]) for point in found["pairs"]] == [
        (scenario, case) for scenario in ("fake", "other") for case in ("heavy", "one crashes")
    ]
    for point in found["pairs"]:
        couples = [[of_seed[point["scenario"], case, str(seed)] for case in ("as it is", point["parameters"]["case"])]
                   for seed in range(1, 9)]  # fmt: skip
        won = [[row["outcome"] == "succeeded" for row in couple] for couple in couples]
        assert (point["seeds"], point["mended"], point["broken"]) == (8, won.count([False, True]), won.count([True, False]))
    crashed = found["pairs"][1]
    assert crashed["broken"] == 1 and crashed["difference"]["median"] == 0.0
    assert {"case.png", "case.svg"} <= {file.name for file in (folder.out / "plots").iterdir()}
    text = folder.run().stdout
    assert 'seed by seed against "as it is":' in text and "heavy" in text


def test_the_help_tells_the_form_of_a_spec():
    folder = CampaignFolder(pathlib.Path("/tmp"))
    done = subprocess.run([*folder.command()[:3], "--help"], capture_output=True, text=True, env=folder.environment())
    assert done.returncode == 0
    for word in ["SPEC.yaml", "--jobs", "--dry-run", "seeds:", "grid:", "draw:", "timeout:", "Exit codes", "Examples"]:
        assert word in done.stdout, word


def test_the_program_lists_campaigns_and_says_what_they_need():
    assert "campaign" in surefoot("--help").stdout
    alone = {key: value for key, value in os.environ.items() if key != "SUREFOOT_PYTHON"}
    assert "use the `surefoot` of `pip install`, or bin/surefoot" in complaint("campaign", "x.yaml", "--jobs", 2, env=alone)


REAL = """\
scenario: step_down
seeds: {first: 1, count: 2}
grid: {terrain.elements.ground.height: [-0.10, -0.14]}
draw: {terrain.friction: [0.4, 1.0]}
set: {duration: 0.5, goal: null, planner.calibration.duration: 0}
"""


def test_with_the_real_program_a_replay_gives_the_same_numbers(tmp_path):
    folder = CampaignFolder(tmp_path, PROGRAM).write(REAL)
    found = folder.result("--jobs", 2)
    assert found["runs"]["finished"] == 4
    by_id = {row["id"]: row for row in table(folder)}
    worst = found["worst"][0]
    replay = subprocess.run([*shlex.split(worst["command"]), "--json"], capture_output=True, text=True)
    result = json.loads(replay.stdout)
    row = by_id[worst["id"]]
    assert result["com_error_max_m"] == worst["com_error_max_m"] == float(row["com_error_max_m"])
    assert result["seed"] == int(row["seed"]) and result["duration_s"] == 0.5
    compared = {k: v for k, v in result.items() if isinstance(v, float) and k not in ("realtime_factor",)}
    assert compared and all(float(row[key]) == value for key, value in compared.items())


MASS = "randomise.disturbances.payload.mass: [-5, 5]"
RANGES = {
    "set:\n  randomise.terrain.friction: [1.0, 0.4]": "set: randomise.terrain.friction=[1.0, 0.4]: randomise.terrain.friction: min, 1, must not be above max, which is 0.4",
    f"set:\n  {MASS}": 'set: randomise.disturbances.payload.mass=[-5, 5]: .*disturbances.payload.mass: "-5" is not a number from 0 to 200 kg',
    f"cases:\n  heavy: {{{MASS}}}\n  as it is: {{}}": 'cases.heavy: randomise.disturbances.payload.mass=[-5, 5]: .*"-5" is not a number from 0 to 200 kg',
}


@pytest.mark.parametrize("text", RANGES)
def test_a_range_that_makes_no_sense_or_goes_beyond_its_keys_limits_is_told_with_its_line_wherever_it_stands(tmp_path, text):
    said = CampaignFolder(tmp_path, PROGRAM).write(f"scenario: walk_flat\nseeds: [1]\n{text}\n").complaint("--dry-run")
    assert re.match("spec.yaml:4: " + RANGES[text].replace("[", r"\["), said), said


def test_a_draw_of_a_key_of_whole_numbers_is_told_where_it_belongs(tmp_path):
    draw = "draw: {actuators.delay_ticks: [1, 3]}"
    said = CampaignFolder(tmp_path, PROGRAM).write(f"scenario: walk_flat\nseeds: [1]\n{draw}\n").complaint("--dry-run")
    assert "spec.yaml:3: draw: actuators.delay_ticks=1.0: " in said
    (advice,) = re.findall(r"let the program draw, (set: \{.*?\]\})", said)
    assert CampaignFolder(tmp_path, PROGRAM).write(f"scenario: walk_flat\nseeds: [1]\n{advice}\n").run("--dry-run").returncode == 0


def test_a_draw_is_that_of_a_scenario_that_randomises_the_same(tmp_path):
    """step_down draws its friction itself, from [0.4, 1.0]."""
    folder = CampaignFolder(tmp_path, PROGRAM).write(REAL.replace("count: 2", "count: 1"))
    folder.result()
    row = table(folder)[0]
    assert float(row["terrain.friction"]) == run_result("step_down", "--seed", 1, "--set", "duration=0.1")["drawn"]["terrain.friction"]
    assert "drawn.terrain.friction" not in row  # the campaign's takes its place


def test_campaigns_that_ship_are_taken_by_the_program(tmp_path):
    folder = CampaignFolder(tmp_path, PROGRAM)
    specs = sorted((ROOT / "campaigns").glob("*.yaml"))
    assert len(specs) >= 8
    for spec in specs:
        folder.spec = spec
        assert folder.run("--dry-run").returncode == 0, spec


def test_the_hash_of_a_scenario_is_that_of_every_file_it_is_made_from(tmp_path):
    files = {
        "scenario.yaml": "base: below.yaml\nstack: stack.yaml\n",
        "below.yaml": "base: walk_flat\nduration: 3\n",
        "stack.yaml": "name: mine\nbase: lower.yaml\n",
        "lower.yaml": "name: lower\nbase: terrain_adaptation\n",
    }
    for name, text in files.items():
        (tmp_path / name).write_text(text)

    def sources_hash():
        return run_result("scenario.yaml", "--check", cwd=tmp_path)["sources_hash"]

    found = [sources_hash(), sources_hash()]
    assert found[0] == found[1]
    for name, text in files.items():
        (tmp_path / name).write_text(text + "# changed\n")
        found.append(sources_hash())
    assert len(set(found)) == 1 + len(files)


def test_a_check_tells_what_a_run_would_and_runs_nothing():
    assert answer("run", "walk_flat", "--check")
    wrong = ["run", "walk_flat", "--set", "terrain.frction=1"]
    assert complaint(*wrong, "--check") == complaint(*wrong)


def test_what_nothing_comes_of_is_told_once_before_anything_runs(tmp_path):
    text = "scenario: push\nseeds: [1, 2]\ncases: {whole: {}, short: {duration: 2}}\ngrid: {terrain.friction: [0.7, 0.8]}\n"
    folder = CampaignFolder(tmp_path, PROGRAM).write(text)
    warnings = folder.run("--dry-run").stderr.splitlines()
    assert len(warnings) == 1
    assert re.fullmatch(r"surefoot: warning: push \(short\): disturbances\.pushes\.\w+ begins at .* s; the run ends at 2 s", warnings[0])


def test_a_run_whose_campaign_ended_before_it_could_ask_for_that_does_not_begin(tmp_path):
    from surefoot_campaign.scheduler import TIED_TO_PARENT

    for parent, runs in ((os.getpid(), True), (1, False)):
        made = tmp_path / str(parent)
        done = subprocess.run([*TIED_TO_PARENT, str(parent), "touch", made], check=False)
        assert (done.returncode == 0) == made.exists() == runs
