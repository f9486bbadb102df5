"""A robot from its URDF alone: the doctor tells what is wrong with it, and mended it walks. The URDF is that of docs/your_robot.md, which weighs
a shank in grams and has a knee that turns the other way."""

import pathlib
import subprocess
import sys
import tempfile

import numpy as np

import surefoot

folder = pathlib.Path(tempfile.mkdtemp())
text = subprocess.run([sys.executable, pathlib.Path(__file__).parent / "marten.py"], capture_output=True, text=True, check=True).stdout
(folder / "sick.urdf").write_text(text)
for finding in surefoot.doctor(str(folder / "sick.urdf")).findings[:2]:
    print(f"{finding.severity}, {finding.confidence}: {finding.subject} (line {finding.line}): {finding.what}\n  → {finding.remedy}")

(folder / "marten.urdf").write_text(text.replace('"250"', '"0.25"').replace("0 -1 0", "0 1 0"))
robot = surefoot.doctor(str(folder / "marten.urdf")).robot  # with guesses for what the URDF lacks
dynamics = robot.dynamics()
foot = dynamics.feet["LF"]
print(f"{robot}: {robot.mass:.1f} kg, its left front foot at {np.round(foot.p, 3)} m")
torque = -foot.J[:, 6:9].T @ [0, 0, robot.mass * 9.81 / 4]  # that holds a quarter of it, by its leg's own joints
print("joint torques for a quarter of the weight:", np.round(torque, 1), "N·m")

result = surefoot.run("walk_flat", robot=robot, set=["duration=8", "planner.calibration.duration=0", "criteria=none"])
print(f"{result}: {result['distance_m']:.2f} m")
assert not result["fell"] and dynamics.M.shape == (18, 18)
