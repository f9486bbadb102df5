"""tools/behaviour.py tells runs apart that command other torques, and no others."""

import subprocess
import sys

from program import PROGRAM, ROOT


def behaviour(*arguments):
    command = [sys.executable, str(ROOT / "tools/behaviour.py"), *map(str, arguments), "--program", PROGRAM]
    return subprocess.run(command, capture_output=True, text=True)


def test_a_gain_that_changes_torques_is_found_and_nothing_where_nothing_changed(tmp_path):
    scenario = tmp_path / "short.yaml"
    scenario.write_text("base: walk_flat.yaml\nduration: 0.1\n")
    kept = tmp_path / "before.json"
    assert behaviour("record", kept, scenario).returncode == 0

    same = behaviour("compare", kept)
    assert (same.returncode, same.stdout.splitlines()[-1]) == (0, "0 of 8 runs differ")

    scenario.write_text("base: walk_flat.yaml\nduration: 0.1\ntasks: {com_xy: {kp: 400}}\n")
    other = behaviour("compare", kept)
    assert (other.returncode, other.stdout.splitlines()[-1]) == (1, "8 of 8 runs differ")
    assert "torques_hash" in other.stdout
