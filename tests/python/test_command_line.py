"""The program as its user sees it: exit codes, what is on stdout and stderr, what is left behind."""

import json
import os
import pathlib
import signal
import subprocess
import time

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("SUREFOOT_PROGRAM", str(ROOT / "build/release/app/surefoot"))
SHORT = ["--set", "duration=0.1"]


def surefoot(*arguments, cwd=None):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=cwd, timeout=120)


def complaint(*arguments, cwd=None):
    """The one line on stderr of a call whose input is wrong."""
    result = surefoot(*arguments, cwd=cwd)
    assert result.returncode == 2, result
    assert result.stdout == ""
    lines = result.stderr.strip().splitlines()
    assert len(lines) == 1, result.stderr
    assert lines[0].startswith("surefoot: ")
    return lines[0]


@pytest.fixture
def scenario(tmp_path):
    """Makes a scenario file over walk_flat."""

    def write(text, name="trial.yaml"):
        file = tmp_path / name
        file.write_text("base: walk_flat\n" + text)
        return file

    return write


@pytest.fixture
def robot(tmp_path):
    """Makes a scenario with ANYmal B, after changes to the robot's file and to its URDF."""

    def write(robot_change=("", ""), urdf_change=("", ""), urdf="robot.urdf"):
        text = (ROOT / "robots/anymal_b.yaml").read_text()
        line = next(line for line in text.splitlines() if line.startswith("urdf:"))
        listed = surefoot("list", "robots").stdout.splitlines()
        original = next(row.split()[1] for row in listed if row.startswith("anymal_b "))
        urdf_text = pathlib.Path(original).read_text()
        assert robot_change[0] in text and urdf_change[0] in urdf_text
        text = text.replace(line, "urdf: " + urdf).replace(*robot_change)
        (tmp_path / "robot.yaml").write_text(text)
        (tmp_path / "robot.urdf").write_text(urdf_text.replace(*urdf_change))
        file = tmp_path / "trial.yaml"
        file.write_text("base: walk_flat\nrobot: robot.yaml\n")
        return file

    return write


# What works


def test_help_version_and_lists_are_on_stdout():
    assert "run" in surefoot("--help").stdout
    assert "Exit codes" in surefoot("--help").stdout
    assert "--seeds" in surefoot("run", "--help").stdout
    assert surefoot("--version").stdout.strip().count(".") == 2
    for what, name in [("robots", "anymal_b"), ("stacks", "walk"), ("scenarios", "step_down"), ("tasks", "com_xy")]:
        result = surefoot("list", what)
        assert result.returncode == 0 and name in result.stdout


def test_the_help_of_a_command_is_its_own():
    helps = {command: surefoot(command, "--help").stdout for command in ["run", "list", "report", "demo"]}
    for command, text in helps.items():
        others = [other for other in ["run", "list", "solve", "demo"] if other != command and command != "report"]
        examples = text[text.index("Example") :]
        assert f"surefoot {command} " in examples
        assert not any(f"surefoot {other} " in examples for other in others), command
    assert "controller stopped for safety" in helps["run"]
    assert "controller stopped" not in helps["demo"] + helps["list"] + helps["report"]
    for part in ["step_down_regular_stack", "minutes", "1 one did not"]:
        assert part in helps["demo"]


@pytest.mark.parametrize("words", [["--set", "duration=0.1", "terrain.friction=0.7"], [*SHORT, "--set", "terrain.friction=0.7"]])
def test_several_keys_are_set_behind_one_option_or_behind_each_its_own(words):
    run = json.loads(surefoot("run", "walk_flat", "--json", *words).stdout)
    assert run["duration_s"] == pytest.approx(0.1) and run["friction_margin_min"] <= 0.7


def test_a_foot_that_finds_no_ground_is_told_when_the_run_is_over():
    words = "no ground within reach: foot taken back"
    arguments = ["run", "step_down_regular_stack", "--seed", 2, "--set", "duration=16"]
    assert words in surefoot(*arguments).stdout
    events = json.loads(surefoot(*arguments, "--json").stdout)["events"]
    events = [event for event in events if event["event"] == words]
    assert {event["leg"] for event in events} == {"LF", "RF"}
    assert all(event["count"] >= 1 and 0 < event["first_s"] < 16 for event in events)


def test_seeds_that_change_nothing_are_warned_of(scenario):
    same = scenario("duration: 0.1\nrandomise:\n  initial.yaw:\n  planner.gait.start_duration:\n")
    result = surefoot("run", same, "--seeds", 2, "--jobs", 2, "--json")
    (warning,) = [line for line in result.stderr.splitlines() if "warning" in line]
    assert "draws nothing at random" in warning
    assert "warning" not in surefoot("run", "step_down", "--seeds", 2, "--jobs", 2, *SHORT).stderr


def test_json_is_exactly_one_object_on_stdout():
    result = surefoot("run", "walk_flat", "--json", *SHORT)
    run = json.loads(result.stdout)
    for metric in """succeeded fell duration_s distance_m speed_mps com_error_max_m com_error_rms_m edge_landings
            base_height_error_rms_m orientation_error_rms_rad torque_max_nm torque_step_max_nm friction_margin_min
            foot_slip_max_m limb_extension_max_m penetration_max_m realtime_factor seed version""".split():
        assert metric in run
    assert set(run["tick_us"]) == set(run["solve_us"]) == {"median", "p99", "max"}


def test_exit_code_says_whether_the_criteria_hold(scenario):
    passes = scenario("duration: 0.1\n")
    assert surefoot("run", passes, "--json").returncode == 0
    fails = scenario("duration: 0.1\ncriteria: {distance_m: {min: 100}}\n")
    result = surefoot("run", fails)
    assert result.returncode == 1
    assert "✗" in result.stdout and "missed: distance_m" in result.stdout


@pytest.mark.parametrize("rate, stop, code", [(1, False, 1), (1, True, 3), (0, False, 0), (0, True, 0)])
def test_one_run_and_several_seeds_end_by_the_same_rule(scenario, rate, stop, code):
    safety = "safety: {max_tilt: 1.0e-9}\n" if stop else ""
    text = f"duration: 0.1\n{safety}success_rate: {rate}\ncriteria: {{distance_m: {{min: 100}}}}\n"
    file = scenario(text)
    for arguments in [[], ["--seed", 1], ["--seeds", 2]]:
        result = surefoot("run", file, "--json", *arguments)
        assert result.returncode == code
        run = json.loads(result.stdout)
        assert not any(row["succeeded"] for row in run.get("runs", [run]))


def test_a_safety_stop_has_its_own_exit_code():
    # A tilt that nobody could keep below stops the controller at once.
    result = surefoot("run", "walk_flat", "--json", "--set", "safety.max_tilt=1e-9", "--set", "duration=1.5")
    assert result.returncode == 3
    run = json.loads(result.stdout)
    assert run["safety_stop"] and not run["succeeded"]


def test_several_seeds_give_one_object_with_runs_and_rates():
    result = surefoot("run", "step_down", "--seeds", 3, "--jobs", 2, "--json", *SHORT)
    assert result.returncode == 1
    seeds = json.loads(result.stdout)
    assert [run["seed"] for run in seeds["runs"]] == [1, 2, 3]
    assert len({run["drawn"]["initial.x"] for run in seeds["runs"]}) == 3
    for rate in ["succeeded", "fell"]:
        low, high = seeds["rates"][rate]["interval"]
        assert seeds["rates"][rate]["successes"] == 0 and seeds["rates"][rate]["trials"] == 3
        # Wilson's interval of 0 out of 3.
        assert low == pytest.approx(0, abs=1e-12) and high == pytest.approx(0.5615, abs=1e-3)
    assert "worst" in seeds["metrics"]["com_error_max_m"]


def test_the_same_seed_gives_the_same_results_alone_and_among_others():
    measured = ["com_error_max_m", "torque_max_nm", "drawn"]
    alone = json.loads(surefoot("run", "step_down", "--seed", 2, "--json", *SHORT).stdout)
    among = json.loads(surefoot("run", "step_down", "--seeds", 2, "--jobs", 2, "--json", *SHORT).stdout)["runs"][1]
    assert [alone[name] for name in measured] == [among[name] for name in measured]


def test_report_and_log_are_written_and_the_log_gives_the_report_again(tmp_path):
    result = surefoot("run", "walk_flat", "--report", tmp_path / "out", "--record", tmp_path / "run.mcap", *SHORT)
    assert (tmp_path / "out/index.html").stat().st_size > 1000, result
    assert surefoot("report", tmp_path / "run.mcap", "--out", tmp_path / "again").returncode == 0
    assert (tmp_path / "again/index.html").exists()


def test_progress_is_not_on_stdout_and_without_a_terminal_draws_no_bar():
    result = surefoot("run", "walk_flat", "--seeds", 2, "--json", *SHORT)
    json.loads(result.stdout)
    assert "seed 1" in result.stderr
    assert "█" not in result.stderr and "\r" not in result.stderr


# Bad input


@pytest.mark.parametrize(
    "text, expected",
    [
        ("duratoin: 3\n", ["trial.yaml:2", "duratoin", 'did you mean "duration"?']),
        ("planner:\n  swing: {apx: 1}\n", ["trial.yaml:3", "planner.swing.apx", "touchdown_speed"]),
        ("duration: -3\n", ["trial.yaml:2", "duration", '"-3"', "above 0"]),
        ("terrain: {friction: .nan}\n", ["trial.yaml:2", "terrain.friction", ".nan"]),
        ("stack: nosuch\n", ["trial.yaml:2", 'unknown stack "nosuch"', "terrain_adaptation"]),
        ("robot: nosuch\n", ["trial.yaml:2", 'unknown robot "nosuch"', "anymal_b"]),
        ("estimation: magic\n", ["trial.yaml:2", "estimation", "truth"]),
        ("criteria: {nosuch: {max: 1}}\n", ["trial.yaml:2", "criteria.nosuch", "com_error_max_m"]),
        ("a: [1, 2\nb: }{", ["trial.yaml", "not YAML"]),
        ("disturbances: {payload: {mass: -1}}\n", ["trial.yaml:2", "disturbances.payload.mass"]),
    ],
)
def test_a_scenario_that_is_wrong_gives_one_message_that_helps(scenario, text, expected):
    message = complaint("run", scenario(text))
    for part in expected:
        assert part in message


def test_a_binary_file_is_not_yaml(tmp_path):
    file = tmp_path / "trial.yaml"
    file.write_bytes(bytes(range(256)))
    assert "trial.yaml" in complaint("run", file)


def test_an_unknown_scenario_lists_those_that_exist():
    message = complaint("run", "step_dwn")
    assert 'did you mean "step_down"?' in message and "walk_flat" in message


@pytest.mark.parametrize("assignment", ["planner.swing.apx=1", "duration=nan", "duration", "duration.x=1", "duration=[1"])
def test_a_wrong_assignment_is_named(assignment):
    assert assignment.split("=")[0].split(".x")[0] in complaint("run", "walk_flat", "--set", assignment)


def test_an_unknown_frame_in_a_robot_file_is_told_with_its_line(robot):
    message = complaint("run", robot(robot_change=("foot: RF_FOOT", "foot: RF_FOT")))
    assert "robot.yaml:7: legs.RF.foot" in message and 'did you mean "RF_FOOT"?' in message


def test_a_missing_urdf_is_named(robot):
    assert "nowhere.urdf" in complaint("run", robot(urdf="nowhere.urdf"))


def test_a_broken_urdf_is_named_with_its_line(robot):
    assert "robot.urdf:" in complaint("run", robot(urdf_change=("</robot>", "")))


def test_a_negative_mass_is_told_with_its_line(robot):
    message = complaint("run", robot(urdf_change=('mass value="1.42462064"', 'mass value="-1.42462064"')))
    assert "robot.urdf:" in message and "-1.42462064" in message


def test_an_inertia_that_physics_refuses_is_told_in_one_line(robot):
    message = complaint("run", robot(urdf_change=('ixx="0.0120367944369"', 'ixx="5"')))
    assert "robot.urdf" in message and "LF_THIGH" in message


@pytest.mark.parametrize(
    "arguments",
    [
        ["run"],
        ["run", "walk_flat", "--sede", "3"],
        ["run", "walk_flat", "--seed", "many"],
        ["run", "walk_flat", "--seed", "-1"],
        ["run", "walk_flat", "--seeds", "0"],
        ["list", "planets"],
        ["dance"],
        [],
        ["report", "nowhere.mcap", "--out", "out"],
        ["solve", "nowhere.jsonl"],
    ],
)
def test_a_wrong_call_gives_one_line_and_exit_code_2(arguments, tmp_path):
    complaint(*arguments, cwd=tmp_path)


def test_an_output_that_can_not_be_written_is_told_before_the_run(tmp_path):
    (tmp_path / "file").write_text("in the way")
    start = time.monotonic()
    for option, place in [
        ("--record", tmp_path / "none/run.mcap"),
        ("--record", tmp_path),
        ("--report", tmp_path / "file/report"),
        ("--report", "/proc/report"),
        ("--record", "/proc/run.mcap"),
    ]:
        assert str(place) in complaint("run", "walk_flat", option, place)
    assert time.monotonic() - start < 5
    assert [entry.name for entry in tmp_path.iterdir()] == ["file"]


# Bad lines of solve

GOOD = '{"levels":[{"A":[[1]],"b":[3]}]}'


@pytest.mark.parametrize(
    "line, message",
    [
        ("levels: 3", "is not JSON"),
        ("\x00\x01", "is not JSON"),
        ("[" * 100000, "is nested deeper than 64"),
        ("[]", 'has no array "levels"'),
        ('{"levels":[]}', "has no unknowns"),
        ('{"levels":[{},{"A":[],"b":[]}]}', "has no unknowns"),
        ('{"levels":[{"A":[[1]],"b":[1]},{"A":[[1],[1,2]],"b":[1,2]}]}', "level 2: A: row 2: has 2 elements"),
        ('{"levels":[{"A":[[1]],"b":[1]},{"D":[[1]],"f":[1,2]}]}', "level 2: f has 2 elements, D has 1 row"),
        ('{"levels":[{},{"A":[[1,2],[NaN,1]],"b":[1,2]}]}', 'level 2: A: row 2: element 1 is "NaN"'),
        ('{"levels":[{"D":[[1]],"f":[-Infinity]}]}', 'level 1: f: element 1 is "-Infinity"'),
        ('{"levels":[{"A":[[1e999]],"b":[1]}]}', 'level 1: A: row 1: element 1 is "1e999"'),
        ('{"levels":[{"A":[[1e200]],"b":[1]}]}', "level 1: A: row 1: element 1 is 1e+200, too large"),
        (json.dumps({"levels": [{"A": [[1] * 501], "b": [1]}]}), "has 501 unknowns; expected at most 500"),
        (
            json.dumps({"levels": [{"A": [[1]], "b": [1]}, {"A": [[1]] * 6000, "b": [1] * 6000}]}),
            "level 2: row 5000 is one too many; expected at most 500 unknowns and 5000 rows",
        ),
    ],
)
def test_a_bad_line_is_named_and_the_lines_around_it_are_solved(line, message, tmp_path):
    (tmp_path / "lines.jsonl").write_text(f"{GOOD}\n\n{line}\n{GOOD}\n")
    done = subprocess.run([PROGRAM, "solve", "lines.jsonl"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 2
    assert done.stderr.startswith("lines.jsonl:3: ") and message in done.stderr
    assert len(done.stderr.splitlines()) == 1
    assert [json.loads(answer)["x"] for answer in done.stdout.splitlines()] == [[3.0], [3.0]]


def test_a_level_without_rows_is_met_by_any_x(tmp_path):
    (tmp_path / "lines.jsonl").write_text('{"levels":[{"A":[],"b":[]},{"A":[[2]],"b":[4]},{}]}\n')
    done = subprocess.run([PROGRAM, "solve", "--certify", "lines.jsonl"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0
    assert [level["residual"] for level in json.loads(done.stdout)["levels"]] == [0, 0, 0]


# Interrupts


def interrupt(arguments, after, which=signal.SIGINT):
    process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    time.sleep(after)
    process.send_signal(which)
    out, err = process.communicate(timeout=60)
    return process.returncode, out, err


@pytest.mark.parametrize("which", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupt_closes_the_log_and_leaves_no_results(tmp_path, which):
    from mcap.reader import make_reader

    log = tmp_path / "run.mcap"
    (tmp_path / "out").mkdir()
    (tmp_path / "out/index.html").write_text("of an earlier run")
    code, out, err = interrupt(
        ["run", "walk_flat", "--json", "--record", log, "--report", tmp_path / "out", "--set", "duration=1000"], 1.5, which
    )
    assert code == 2
    assert out == ""
    assert [line for line in err.splitlines() if line.startswith("surefoot: ")] == err.splitlines()[-1:]
    partial = pathlib.Path(f"{log}.partial")
    assert "interrupted" in err and str(partial) in err
    assert not log.exists()
    with partial.open("rb") as stream:
        assert sum(1 for _ in make_reader(stream).iter_messages(topics=["/command"])) > 10
    assert list((tmp_path / "out").iterdir()) == []


def earlier_results(folder, *names):
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("of an earlier run")


def left_of(folder):
    """Files that still are of an earlier run."""
    return sorted(
        str(file.relative_to(folder))
        for file in folder.rglob("*")
        if file.is_file() and file.read_bytes() == b"of an earlier run"
    )


@pytest.mark.parametrize(
    "arguments, outdated, others",
    [
        (["run", "walk_flat", "--report"], ["index.html", "run.mcap"], ["notes.txt"]),
        (
            ["run", "walk_flat", "--seeds", 3, "--report"],
            ["seed1/index.html", "seed3/index.html", "run-seed3.mcap"],
            ["seed4/index.html"],
        ),
        (["demo", "--out"], ["index.html", "walk_flat/index.html", "push/index.html", "push/run.mcap"], ["notes.txt"]),
    ],
)
def test_an_interrupt_leaves_no_page_of_an_earlier_run_beside_a_new_log(tmp_path, arguments, outdated, others):
    earlier_results(tmp_path, *outdated, *others)
    long = ["--set", "duration=1000"] if arguments[0] == "run" else []
    interrupt([*arguments, tmp_path, *long], 1.5)
    assert left_of(tmp_path) == others


def test_a_wrong_scenario_leaves_an_earlier_report_as_it_is(tmp_path):
    earlier_results(tmp_path, "index.html", "run.mcap", "seed1/index.html", "run-seed1.mcap")
    before = left_of(tmp_path)
    for wrong in [["--set", "duration=never"], ["--set", "period=0.0007"]]:
        complaint("run", "walk_flat", "--report", tmp_path, *wrong)
        complaint("run", "walk_flat", "--report", tmp_path, "--seeds", 2, *wrong)
    complaint("run", "walk_flat", "--report", tmp_path / "new", "--set", "duration=never")
    assert left_of(tmp_path) == before
    assert not (tmp_path / "new").exists()


def test_a_log_with_a_name_of_its_own_is_kept_until_the_new_one_is_whole(tmp_path):
    (tmp_path / "run.mcap").write_text("of an earlier run")
    process = subprocess.Popen(
        [PROGRAM, "run", "walk_flat", "--set", "duration=1000", "--record", tmp_path / "run.mcap", "--report", tmp_path],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    time.sleep(1.5)
    process.kill()
    process.wait()
    assert left_of(tmp_path) == ["run.mcap"]


def test_an_interrupt_of_several_seeds_ends_all_of_them(tmp_path):
    code, out, err = interrupt(
        ["run", "walk_flat", "--json", "--seeds", 8, "--jobs", 2, "--set", "duration=1000"], 1.5, signal.SIGTERM
    )
    assert code == 2
    assert out == ""
    assert err.strip().splitlines()[-1].startswith("surefoot: interrupted")


@pytest.mark.parametrize("arguments", [[], ["--seeds", 2, "--jobs", 2]])
def test_an_interrupt_leaves_no_report_folder_that_was_made_for_nothing(tmp_path, arguments):
    log = tmp_path / "run.mcap"
    folder = tmp_path / "out"
    code, _, err = interrupt(
        ["run", "walk_flat", *arguments, "--report", folder, "--record", log, "--set", "duration=1000"], 1.5
    )
    assert code == 2 and not folder.exists()
    left = sorted(file.name for file in tmp_path.iterdir())
    assert left and all(name.endswith(".mcap.partial") for name in left)
    assert all(name in err.splitlines()[-1] for name in left)


def interrupt_after(words, arguments):
    """Sends ^C as soon as a line on stderr begins with these words."""
    process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    for line in process.stderr:
        if line.startswith(words):
            break
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=120)
    return process.returncode, out, err


def test_an_interrupt_shows_the_seeds_that_are_finished_and_no_cut_log_looks_whole(tmp_path):
    code, out, err = interrupt_after(
        "seed ",
        ["run", "walk_flat_sea", "--seeds", 100, "--jobs", 2, "--json", "--set", "duration=2", "--record", tmp_path / "m.mcap"],
    )
    assert code == 2
    result = json.loads(out)
    finished = {run["seed"] for run in result["runs"]}
    assert result["interrupted"] and 0 < len(finished) < 100
    assert not any(run["reason"] == "interrupted" for run in result["runs"])
    assert result["rates"]["succeeded"]["trials"] == len(finished)
    message = err.splitlines()[-1]
    assert f"interrupted: {len(finished)} of 100 seeds are finished" in message
    whole = {f"m-seed{seed}.mcap" for seed in finished}
    left = {file.name for file in tmp_path.iterdir()}
    assert whole <= left
    cut = left - whole
    assert all(name.endswith(".partial") and name in message for name in cut)


def test_an_interrupted_demo_leaves_whole_experiments_and_their_index(tmp_path):
    out = tmp_path / "demo"
    code, printed, err = interrupt_after("walk_flat: ", ["demo", "--out", out, "--seeds", 1, "--jobs", 2])
    assert code == 2 and "experiments are whole" in err.splitlines()[-1]
    folders = {entry.name for entry in out.iterdir() if entry.is_dir()}
    index = (out / "index.html").read_text()
    assert "walk_flat" in folders and "interrupted" in index
    for folder in folders:
        assert f'href="{folder}/index.html"' in index and (out / folder / "index.html").exists()
        assert {file.name for file in (out / folder).iterdir()} == {"index.html", "run.mcap"}
    assert index.count("href=") == len(folders) < 15


def test_a_demo_interrupted_at_once_leaves_nothing(tmp_path):
    code, printed, err = interrupt(["demo", "--out", tmp_path / "demo"], 0.5)
    assert code == 2 and printed == ""
    assert not (tmp_path / "demo").exists()
