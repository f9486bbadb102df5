"""Robots from Python: their dynamics, and what the doctor says of a description."""

import pathlib
import subprocess
import sys

import numpy as np
import pytest

import surefoot
from program import ROOT


@pytest.fixture(scope="module")
def robot():
    return surefoot.Robot("anymal_b")


def somewhere(robot, seed=1):
    """A state that nothing is special about."""
    random = np.random.default_rng(seed)
    q = np.array(robot.q_nominal) + random.uniform(-0.2, 0.2, len(robot.joint_names))
    q_WB = random.normal(size=4)
    return {"q": q, "u": random.normal(size=6 + len(q)), "p_WB": random.normal(size=3), "q_WB": q_WB / np.linalg.norm(q_WB)}


def turned(q_WB, angle_B):
    """A quaternion after a small turn in B."""
    w, v = q_WB[0], np.asarray(q_WB[1:])
    dw, dv = 1.0, 0.5 * angle_B
    q = np.concatenate([[w * dw - v @ dv], w * dv + dw * v + np.cross(v, dv)])
    return q / np.linalg.norm(q)


def moved(state, time):
    """The state after a short time, by its velocities."""
    u = state["u"]
    return state | {"q": state["q"] + time * u[6:], "p_WB": state["p_WB"] + time * u[:3], "q_WB": turned(state["q_WB"], time * u[3:6])}


def test_jacobians_of_links_and_feet_are_those_of_their_motion(robot):
    state, dt = somewhere(robot), 1e-6
    now, before, after = (robot.dynamics(**each) for each in (state, moved(state, -dt), moved(state, dt)))
    for find in (lambda d: d.frame("RH_SHANK").point, lambda d: d.feet["LF"], lambda d: d.hips["RF"], lambda d: d.com, lambda d: d.frame("base").point):
        np.testing.assert_allclose(find(now).v, (find(after).p - find(before).p) / (2 * dt), atol=1e-6)
        np.testing.assert_allclose(find(now).J @ state["u"], find(now).v, atol=1e-12)
    R = [each.frame("LH_THIGH").rotation.R for each in (before, now, after)]
    spin = (R[2] - R[0]) / (2 * dt) @ R[1].T
    rotation = now.frame("LH_THIGH").rotation
    np.testing.assert_allclose(rotation.w, [spin[2, 1], spin[0, 2], spin[1, 0]], atol=1e-6)
    np.testing.assert_allclose(rotation.J @ state["u"], rotation.w, atol=1e-12)


def test_h_at_rest_is_gravity_and_what_moves_keeps_its_energy(robot):
    state = somewhere(robot)
    now = robot.dynamics(**state)
    assert np.linalg.eigvalsh(now.M).min() > 0
    np.testing.assert_allclose(now.gravity[:3], [0, 0, 9.81 * robot.mass], atol=1e-9)
    still = robot.dynamics(**state | {"u": np.zeros(18)})
    np.testing.assert_allclose(still.h, now.gravity, atol=1e-9)
    # In free fall power goes from height into motion: u·h is half of u·Ṁu and what the weight takes.
    dt = 1e-6
    before, after = (robot.dynamics(**moved(state, time)) for time in (-dt, dt))
    rate = state["u"] @ ((after.M - before.M) / (2 * dt)) @ state["u"] / 2
    climb = robot.mass * 9.81 * now.com.v[2]
    assert state["u"] @ now.h == pytest.approx(rate + climb, abs=1e-4)


def test_a_state_of_a_controller_has_dynamics_and_arrays_are_views(robot):
    scenario = surefoot.load_scenario("walk_flat_ideal")
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    controller.step(plant.read(), scenario.user(0.0))
    dynamics = scenario.robot_model.dynamics(controller.state)
    np.testing.assert_allclose(dynamics.com.p, controller.model.p_WCom, atol=1e-12)
    dynamics.M[0, 0] = 7
    assert dynamics.M[0, 0] == 7 and robot.dynamics().M[0, 0] == pytest.approx(robot.mass)


@pytest.mark.parametrize("given, said", [
    ({"q": [1, 2]}, "q has 12 numbers, one for each joint from LF_HAA to RH_KFE; 2 were given"),
    ({"u": np.zeros(12)}, "u has 18 numbers, v_WB, w_WB_B and a rate for each joint; 12 were given"),
    ({"q": [float("nan")] * 12}, r"q\[0\] is nan; a finite number would be valid"),
    ({"q_WB": [1, 1, 0, 0]}, "q_WB has the length 1.41421; a quaternion w, x, y, z of length 1 would be valid"),
    ({"q_WB": [0, 0, 0]}, "q_WB has 4 numbers; 3 were given"),
    ({"terrain_normal": [0, 0, 0]}, "terrain_normal is zero"),
])  # fmt: skip
def test_what_is_no_state_is_refused(robot, given, said):
    with pytest.raises(surefoot.Error, match=said):
        robot.dynamics(**given)


def test_unknown_robots_and_links_are_told_with_those_that_there_are(robot):
    with pytest.raises(surefoot.UnknownNameError, match='unknown robot "anymal"; did you mean "anymal_b"?'):
        surefoot.Robot("anymal")
    with pytest.raises(surefoot.UnknownNameError, match='no frame "LF_FEET"; did you mean "LF_FOOT"'):
        robot.dynamics().frame("LF_FEET")
    assert "anymal_b" in surefoot.robots() and repr(robot) == "<robot anymal_b, 4 legs, 12 joints>"


@pytest.fixture(scope="module")
def marten(tmp_path_factory):
    """The URDF of docs/your_robot.md, as it is and mended."""
    text = subprocess.run([sys.executable, ROOT / "examples/marten.py"], capture_output=True, text=True, check=True).stdout
    sick, well = (tmp_path_factory.mktemp("marten") / name for name in ("sick.urdf", "marten.urdf"))
    sick.write_text(text)
    well.write_text(text.replace('"250"', '"0.25"').replace("0 -1 0", "0 1 0"))
    return sick, well


def test_the_doctor_tells_what_is_wrong_and_what_it_guessed(marten, tmp_path):
    sick, well = (surefoot.doctor(str(path)) for path in marten)
    assert not sick.can_walk or any(finding.severity == "error" for finding in sick.findings)
    assert sick.findings[0].severity == "error" and sick.findings[0].what and "LF_shank" in str(sick)
    assert well.can_walk and repr(well.robot) == "<robot marten, 4 legs, 12 joints>"
    picture = well.write(tmp_path / "marten.yaml")
    assert pathlib.Path(picture).suffix == ".svg" and "<svg" in well.picture
    with pytest.raises(surefoot.Error, match="marten.yaml"):
        well.write(tmp_path / "marten.yaml")


def test_a_description_alone_is_a_robot_that_a_controller_can_have(marten):
    robot = surefoot.Robot(str(marten[1]))
    assert robot.mass == pytest.approx(20, abs=3)
    for shown in (robot, surefoot.doctor(str(marten[1])).robot):
        run = surefoot.Robot(robot.file)
        for limit in ("torque_limit", "velocity_limit", "q_min", "q_max"):
            assert getattr(shown, limit) == getattr(run, limit), limit
        assert shown.torque_limit[0] != 40 and shown.velocity_limit[0] != 15
    scenario = surefoot.load_scenario("walk_flat", robot=robot, set=["duration=0.1"])
    assert scenario.robot == "marten" and surefoot.run(scenario)["fell"] is False
    with pytest.raises(surefoot.Error, match="none.urdf"):
        surefoot.Robot("none.urdf")
