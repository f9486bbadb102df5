"""`surefoot replay --verify` and `--stack` as their user sees them, on logs that are whole."""

import json
import math

import pytest
from conftest import record
from damaged_logs import changed, of_version
from log_file import attachment, messages, rows_of
from program import answer, complaint, of_json, surefoot


def test_verify_says_that_every_torque_is_the_same(log):
    found = of_json("replay", log, "--verify")
    assert found["same"] and found["ticks"] == 800 and found["different_ticks"] == 0 and not found["estimated"]
    assert found["different_messages"] == {}
    assert "800 ticks, 0.0000 s to 1.9975 s: every torque is the same to the bit." in answer("replay", log, "--verify")


def test_another_stack_is_asked_on_the_same_states(log, tmp_path):
    file = tmp_path / "ticks.csv"
    found = of_json("replay", log, "--stack", "regular", "--csv", file)
    assert found["compared"] == found["ticks"] == 800 and found["not_reproduced"] == {"ticks": 0}
    rows = rows_of(file)
    commands = messages(log, "/command")
    assert len(rows) == 800 and {"time[s]", "hierarchy.level.contact_force_minimisation.residual[N]"} <= rows[0].keys()
    assert float(rows[411]["command.torque.RF_HFE[N·m]"]) == commands[411]["torque"][4]
    differences = [float(row["other.command.torque.RF_HFE[N·m]"]) - float(row["command.torque.RF_HFE[N·m]"]) for row in rows]
    rms = (sum(d * d for d in differences) / len(differences)) ** 0.5
    assert found["torque_difference"]["RF_HFE"]["rms"] == pytest.approx(rms, rel=1e-9)
    assert abs(found["torque_difference"]["RF_HFE"]["largest"]) == pytest.approx(max(map(abs, differences)), rel=1e-9)
    residuals = [level["residual"] for h in messages(log, "/hierarchy") for level in h["levels"] if level["name"] == "contact_force_minimisation"]
    logged = next(level["logged"] for level in found["levels"] if level["name"] == "contact_force_minimisation")
    assert logged["largest"] == pytest.approx(max(residuals), rel=1e-9)
    assert logged["time"] == round(messages(log, "/state")[residuals.index(max(residuals))]["time"], 9)
    assert "walk_end" not in found
    assert "rms" in answer("replay", log, "--stack", "regular")
    for row in rows:
        assert row["time[s]"] == repr(round(float(row["time[s]"]), 9)).removesuffix(".0")
        for side in ("", "other."):
            assert (row[f"{side}command.mode"], row[f"{side}hierarchy.status"]) == ("optimal", "0")


# Unchecked, it falls and is not stopped for torques or an IMU that can't be.
UNCHECKED = ["guard.consistency.enabled=false", "guard.max_acceleration_step=1e4", "guard.sure_acceleration_step=1e4", "guard.max_gyro_step=1e3",
             "guard.sure_gyro_step=1e3", "guard.angle_margin=1", "guard.sure_angles=1", "guard.max_angles=1", "disturbances.pushes.lateral.time=0.5"]  # fmt: skip


# Which of them ends a walk how depends on the walk; together they end walks in every way.
HITS = [
    ["planner.calibration.duration=0", "sensors.faults.one={sensor: imu, kind: nan, time: 0.5}"],
    *([*UNCHECKED, f"disturbances.pushes.lateral.force={force}"] for force in ([130, 0, 0], [150, 0, 0], [0, 180, 0], [0, 300, 0], [0, 500, 0]))]


def test_what_another_stack_asks_behind_a_fall_or_a_stop_is_marked(tmp_path):
    ways = {check_marks(tmp_path / f"hit_{number}.mcap", changes) for number, changes in enumerate(HITS)}
    assert ways - {None} == {"its controller stopped for safety: ", "its torso came to the ground", "no foot touched the ground any more"}


def check_marks(file, changes):
    """How the walk ended, by its log; None: it went on to its end."""
    surefoot("run", "push", "--set", "duration=6", "--record", file, *(word for one in changes for word in ("--set", one)))
    found = of_json("replay", file, "--stack", "regular", "--csv", file.with_suffix(".csv"))
    rows = rows_of(file.with_suffix(".csv"))
    not_asked = found["not_asked"]["ticks"]
    assert [row["command.mode"] for row in rows] == [command["mode"] for command in messages(file, "/command")]
    assert [all(value == "" for name, value in row.items() if name.startswith("other.")) for row in rows].count(True) == not_asked
    truths = messages(file, "/truth")
    stood = [k for k, truth in enumerate(truths) if any(foot["touching"] for foot in truth["feet"].values())]
    ends = {
        "its controller stopped for safety: ": [command["time"] for command in messages(file, "/command") if command["cause"] != "none"],
        "its torso came to the ground": [truth["time"] for truth in truths if truth["torso_contact"]],
        "no foot touched the ground any more": [truth["time"] for truth in truths[stood[-1] + 1 :]],
    }
    first = {why: times[0] for why, times in ends.items() if times}
    assert ("walk_end" in found) == bool(first)
    if not first:
        return None
    end, why = found["walk_end"], min(first, key=first.get)
    assert end["why"].startswith(why)
    assert end["time"] == pytest.approx(first[why], abs=1e-9)
    text = answer("replay", file, "--stack", "regular")
    times = [level[side]["time"] for level in found["levels"] for side in ("logged", "other") if level.get(side, {}).get("largest", 0) >= 1e-6]
    times += [joint["time"] for joint in found["torque_difference"].values() if abs(joint["largest"]) >= 1e-6]
    marked = sum(time > end["time"] - 1e-9 for time in times)
    assert text.count(" s *") == marked
    assert f"\n{'* ' if marked else ''}From {end['time']:.4f} s on the run says nothing of its walk: {end['why']}." in text
    return why


def test_wrong_arguments_of_replay_are_said(log, tmp_path):
    assert "--json is for --verify and --stack" in complaint("replay", log, "--json")
    assert "is the log itself" in complaint("replay", log, "--stack", "regular", "--csv", log)
    assert 'did you mean "regular"?' in complaint("replay", log, "--stack", "regulr")
    assert "one at a time" in complaint("replay", log, "--verify", "--stack", "regular")
    assert "--csv" in complaint("replay", log, "--verify", "--csv", tmp_path / "a.csv")
    assert "there is no folder" in complaint("replay", log, "--stack", "regular", "--csv", tmp_path / "no/a.csv")


def test_verify_finds_a_torque_that_is_another_in_its_last_bit(log, tmp_path):
    before = messages(log, "/command")[345]["torque"][7]
    other = math.nextafter(before, math.inf)

    def change(command):
        command["torque"][7] = other

    file = changed(log, tmp_path, "/command", 345, change)
    found = of_json("replay", file, "--verify", status=1)
    assert (found["same"], found["different_ticks"]) == (False, 1)
    expected = {"tick": 345, "time": 0.8625, "joint": "LH_HFE", "logged": other, "computed": before}
    assert found["first"] == found["largest"] == expected
    assert found["different_messages"] == {"/command": {"ticks": 1, "first": 0.8625}}
    text = answer("replay", file, "--verify", status=1)
    assert f"tick 345, 0.8625 s, LH_HFE: {other:.17g} N·m in the log, {before:.17g} N·m now" in text
    assert "1 have another torque or mode" in text


def test_verify_compares_what_an_older_log_has_and_nothing_else(tmp_path):
    """A log before 2.8 does not say what was wrong with the sensor that stopped the robot."""
    fault = ["--set", "planner.calibration.duration=0", "--set", "sensors.faults.one={sensor: imu, kind: nan, time: 0.5}"]
    file = tmp_path / "stopped.mcap"
    assert surefoot("run", "walk_flat", "--set", "duration=1", "--record", file, *fault).returncode == 3
    assert messages(file, "/command")[-1]["fault"] == "not_a_number"
    old = of_version(file, tmp_path, "2.7", {"/command": ("fault", "joint")})
    found = of_json("replay", old, "--verify")
    assert found["same"] and found["different_messages"] == {}

    def change(command):
        command["cause"] = "encoders"

    found = of_json("replay", changed(old, tmp_path, "/command", 398, change), "--verify")
    assert found["different_messages"] == {"/command": {"ticks": 1, "first": 0.995}}
    now = json.loads(attachment(file, "header.json"))["log_version"]
    found = of_json("replay", of_version(file, tmp_path, now, {"/command": ("fault", "joint")}), "--verify")
    assert found["same"] and found["different_messages"]["/command"]["ticks"] > 50, "a log of today's version lacks nothing"


def test_verify_runs_the_runs_own_estimator_again(tmp_path):
    """With `estimation: sensors` the logged state is not asked: that it comes out again is a part of the answer."""
    file = record(tmp_path / "walk.mcap", "--set", "planner.calibration.duration=0", scenario="walk_flat", duration=1)
    found = of_json("replay", file, "--verify")
    assert found["same"] and found["estimated"]
    assert "Estimator and controller ran again" in answer("replay", file, "--verify")

    def change(state):
        state["p_WB"][0] += 1e-3

    found = of_json("replay", changed(file, tmp_path, "/state", 100, change), "--verify")
    assert found["same"] and found["different_messages"] == {"/state": {"ticks": 1, "first": 0.25}}

    def push(reading):
        reading["accelerometer"][0] += 0.5

    found = of_json("replay", changed(file, tmp_path, "/readings", 100, push), "--verify", status=1)
    assert found["first"]["tick"] in (100, 101) and found["different_ticks"] > 100
    assert found["different_messages"]["/state"]["first"] <= found["first"]["time"]
