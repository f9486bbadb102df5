"""Every scenario once, whole, as a user starts it: its criteria hold."""

import json

import pytest
from program import ROOT, surefoot

NAMES = sorted(path.stem for path in (ROOT / "scenarios").glob("*.yaml"))
# What these are about is how far they get.
AS_FOUND = {"push", "step_down_without_limits"}
# What is in the name is drawn at random.
DRAWN = {"walk_flat_mismatch"}
GROUNDS = ["step_down", "step_up", "stairs_down", "slope_any", "rough_boxes", "push_any_direction", "payload_step_up", "friction_patches"]

pytestmark = pytest.mark.slow


def run(name, *assignments, options=()):
    """Exit code and result of one run, or of several seeds."""
    sets = [word for assignment in assignments for word in ("--set", assignment)]
    done = surefoot("run", name, "--json", *options, *sets, cwd=ROOT, timeout=None)
    assert done.returncode in (0, 1, 4), done.stderr  # 4: shorter than the criteria need
    return done.returncode, json.loads(done.stdout)


@pytest.mark.parametrize("name", [name for name in NAMES if name not in AS_FOUND])
def test_the_criteria_of_a_scenario_hold(name):
    code, result = run(name, options=["--seed", "1"] if name in DRAWN else [])
    assert bool(result["drawn"]) == (name in DRAWN)
    assert result["succeeded"], result["criteria"]
    assert code == 0


@pytest.mark.parametrize("name", GROUNDS)
def test_robots_that_are_wrong_everywhere_walk_too(name):
    """One of a hundred fails (docs/results): of two both do once in ten thousand."""
    _, result = run(name, "randomise.include=mismatch", options=["--seed", "301", "--seeds", "2", "--jobs", "2"])
    assert all(run["drawn"]["actuators.joint_torque_gain.LF_HAA"] != 1.0 for run in result["runs"])
    assert any(run["succeeded"] for run in result["runs"]), [run["reason"] for run in result["runs"]]


def test_without_limits_on_the_legs_the_foot_is_taken_back_and_the_robot_stands():
    code, result = run("step_down_without_limits")
    assert code == 0 and not result["succeeded"] and not result["goal_reached"]
    assert not result["fell"] and not result["safety_stop"]
    assert result["no_ground_events"] > 0


def test_the_force_ramps_halve_the_torque_steps_at_least():
    _, ramps = run("torque_continuity", "duration=12")
    _, jumps = run("torque_continuity", "duration=12", "planner.force.ramps=false")
    assert ramps["torque_step_max_nm"] < 0.5 * jumps["torque_step_max_nm"]


def test_a_light_push_is_walked_through():
    _, result = run("push", "disturbances.pushes.lateral.force.y=8")
    assert not result["fell"]


@pytest.mark.parametrize("direction", [-2.36, -0.79, 0.0, 3.14])
def test_a_push_from_any_side_is_walked_through(direction):
    _, result = run("push_any_direction", f"disturbances.pushes.any.direction={direction}")
    assert not result["fell"]
    assert result["path_deviation_max_m"] < 0.1
