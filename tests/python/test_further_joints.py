"""Robots of tools/hexapod.py whose legs have four and five joints stand, walk blind and step down by the scenarios that ship."""

import json
import subprocess
import sys

import pytest
from program import PROGRAM, ROOT

FILE = """name: long_legs
urdf: robot.urdf
legs: {LF: {foot: LF_foot}, RF: {foot: RF_foot}, LH: {foot: LH_foot}, RH: {foot: RH_foot}}
foot: {radius: 0.03}
"""
SIX = FILE.replace("LH: {", "LM: {foot: LM_foot}, RM: {foot: RM_foot}, LH: {")


def run(folder, scenario, *assignments):
    arguments = [PROGRAM, "run", scenario, "--seed", "1", "--json", "--set", f"robot={folder}/robot.yaml", *assignments]
    return json.loads(subprocess.run(arguments, cwd=ROOT, capture_output=True, text=True).stdout)


def write_robot(folder, legs, *further):
    printed = subprocess.run([sys.executable, ROOT / "tools/hexapod.py", "--legs", str(legs), "--further", *further], capture_output=True, text=True, check=True)
    (folder / "robot.urdf").write_text(printed.stdout)
    (folder / "robot.yaml").write_text(FILE if legs == 4 else SIX)


@pytest.mark.slow
@pytest.mark.parametrize("legs, further", [(4, ["YAW"]), (4, ["TOE"]), (4, ["YAW", "TOE"]), (6, ["YAW"])], ids=str)
def test_legs_with_further_joints_walk_and_step_down(legs, further, tmp_path):
    write_robot(tmp_path, legs, *further)
    flat = run(tmp_path, "campaigns/robots/flat.yaml")
    assert flat["succeeded"], flat["reason"]
    assert flat["com_error_max_m"] < 0.0017
    down = run(tmp_path, "campaigns/robots/step_down_10.yaml")
    assert down["succeeded"] and not down["fell"], down["reason"]


@pytest.mark.slow
@pytest.mark.parametrize("scenario", ["lying_start", "lifted", "trot", "stairs_up"])
def test_a_hip_that_yaws_does_what_others_do(scenario, tmp_path):
    write_robot(tmp_path, 4, "YAW")
    assert run(tmp_path, scenario)["succeeded"]


def test_the_doctor_finds_such_legs_and_its_file_walks(tmp_path):
    write_robot(tmp_path, 4, "YAW", "TOE")
    found = subprocess.run([PROGRAM, "doctor", tmp_path / "robot.urdf", "--out", tmp_path / "found.yaml"], capture_output=True, text=True)
    assert found.returncode == 0, found.stdout + found.stderr
    assert "LF_HAA LF_HFE LF_KFE, held: LF_YAW LF_TOE" in found.stdout
    assert "the others are held at 0, or the limit next to it: LF_YAW LF_TOE RF_YAW" in found.stdout
    assert subprocess.run([PROGRAM, "doctor", tmp_path / "found.yaml"], capture_output=True).returncode == 0
    (tmp_path / "robot.yaml").write_text((tmp_path / "found.yaml").read_text())
    log = tmp_path / "run.mcap"
    set_up = ["--set", f"robot={tmp_path}/robot.yaml", "duration=16", "criteria=none"]
    walked = json.loads(subprocess.run([PROGRAM, "run", "walk_flat", "--json", "--record", log, *set_up], capture_output=True, text=True).stdout)
    assert walked["succeeded"] and not walked["fell"] and walked["distance_m"] > 0.1
    assert "every torque is the same to the bit" in subprocess.run([PROGRAM, "replay", log, "--verify"], capture_output=True, text=True).stdout
    assert "largest torque" in subprocess.run([PROGRAM, "explain", log, "--at", "12"], capture_output=True, text=True).stdout


@pytest.mark.parametrize("legs, further", [(4, ["TOE"]), (4, ["YAW", "TOE"]), (6, ["TOE"])], ids=str)
def test_the_doctor_finds_legs_of_which_the_hind_ones_alone_have_further_joints(legs, further, tmp_path):
    write_robot(tmp_path, legs, *further, "--of", "H")
    found = subprocess.run([PROGRAM, "doctor", tmp_path / "robot.urdf", "--out", tmp_path / "found.yaml"], capture_output=True, text=True)
    assert found.returncode == 0, found.stdout + found.stderr
    assert "LF_HAA LF_HFE LF_KFE\n" in found.stdout.replace(" \n", "\n")
    assert "LH_HAA LH_HFE LH_KFE, held: " + " ".join(f"LH_{joint}" for joint in further) in found.stdout
    assert "an arm begins here" not in found.stdout
    (tmp_path / "robot.yaml").write_text((tmp_path / "found.yaml").read_text())
    walked = run(tmp_path, "walk_flat", "duration=16", "criteria=none")
    assert walked["succeeded"] and not walked["fell"] and walked["distance_m"] > 0.1


def test_what_is_left_of_a_leg_of_two_joints_is_told(tmp_path):
    write_robot(tmp_path, 4)
    file = tmp_path / "robot.yaml"
    file.write_text(FILE.replace("LF_foot", "LF_thigh"))
    told = subprocess.run([PROGRAM, "run", "walk_flat", "--set", f"robot={file}"], capture_output=True, text=True)
    assert told.returncode == 2
    assert "a leg that walks has three, HAA, HFE and KFE, or more, as fewer can't place a foot in space" in told.stderr
