"""The controller's world and the simulator's: they don't mix, and what aligns them is there."""

import json

import numpy as np
import pytest
import surefoot
from conftest import record
from damaged_logs import of_version, rewritten
from log_file import attachment
from surefoot_log.worlds import WorldError

ELSEWHERE = ["initial.x=3", "initial.yaw=2"]  # where the robot begins in S; in W it begins at the origin
SET = [word for assignment in ELSEWHERE for word in ("--set", assignment)]


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    return record(tmp_path_factory.mktemp("worlds") / "run.mcap", "--set", "planner.calibration.duration=0", *SET, scenario="walk_flat", duration=3)


@pytest.fixture(scope="module")
def run(file):
    return surefoot.read(file)


def test_numbers_of_both_worlds_do_not_mix(run):
    for expression in (lambda: run["truth.p_SCom"][:, :2] - run["plan.com.p"], lambda: run["state.p_WB.x"] + run["truth.p_SB.x"],
                       lambda: np.hypot(run["truth.p_SB.x"], run["state.p_WB.x"]), lambda: np.subtract(run["state.p_WB"], run["truth.p_SB"])):  # fmt: skip
        with pytest.raises(surefoot.WorldError, match="in W, the controller's world, the other in S.*aligned_error") as raised:
            expression()
        assert isinstance(raised.value, surefoot.Error) and isinstance(raised.value, WorldError)
    here = run["state.p_WB"]
    here -= here[0]
    assert here.world == "W" and (2 * run["model.p_WCom"] - run["state.p_WB"]).world == "W"
    assert np.asarray(run["truth.p_SB"]).shape == run["truth.p_SB"].shape and not hasattr(run["command.torque.LF_KFE"], "world")
    assert np.asarray(here).mean() == here.mean()


def test_the_aligned_error_of_the_plan_is_that_of_the_metric(run, file):
    metrics = json.loads(attachment(file, "summary.json"))["metrics"]
    error = np.linalg.norm(run.aligned_error("com"), axis=1)
    assert error.max() == pytest.approx(metrics["com_error_max_m"], rel=1e-9)
    assert np.sqrt(np.mean(error**2)) == pytest.approx(metrics["com_error_rms_m"], rel=1e-9)
    assert np.abs(np.asarray(run["truth.p_SCom"])[:, :2] - np.asarray(run["plan.com.p"])).max() > 2, "unaligned they are metres apart"
    assert np.linalg.norm(run.aligned_error("base"), axis=1)[-1] == pytest.approx(metrics["position_drift_m"], rel=1e-9)
    assert abs(run.aligned_error("heading")[-1]) == pytest.approx(metrics["heading_drift_rad"], rel=1e-9)
    with pytest.raises(KeyError, match="there is no aligned error con; did you mean"):
        run.aligned_error("con")


def test_the_transform_takes_the_truth_to_where_the_plan_is(run):
    error = run.in_W("truth.p_SCom")[:, :2] - run["plan.com.p"]
    np.testing.assert_allclose(np.asarray(error), run.aligned_error("com"), atol=1e-12)
    X, p = run.X_WS("start"), np.asarray(run["truth.p_SB"])
    there = np.einsum("nij,nj->ni", X[:, :3, :3], p) + X[:, :3, 3]
    np.testing.assert_allclose(np.asarray(run["state.p_WB"]) - there, run.aligned_error("base"), atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(run.in_W("truth.v_SCom"), axis=1), np.linalg.norm(np.asarray(run["truth.v_SCom"]), axis=1))
    for wrong, said in {"state.p_WB": "is not in S", "truth.p_SB.x": "is a part of one", "truth.torque": "is not in S",
                        "truth.p_SF": "is 4 of them: truth.p_SF.LF, truth.p_SF.RF"}.items():  # fmt: skip
        with pytest.raises(KeyError, match=f"{said}.*; one vector in S, .* would be valid"):
            run.in_W(wrong)


def test_a_loop_of_ones_own_has_the_numbers_of_the_log(run):
    scenario = surefoot.load_scenario("walk_flat", set=["planner.calibration.duration=0", *ELSEWHERE])
    plant, aligner = surefoot.Plant(scenario), surefoot.Aligner()
    controller = surefoot.Controller(scenario, plant)
    for tick in range(300):
        command = controller.step(plant.read(), scenario.user(plant.time))
        found = aligner.update(plant, controller)
        assert np.array_equal(found.com_error, run.aligned_error("com")[tick], equal_nan=True)
        plant.write(command)
    assert np.array_equal(found.feet.p_WS, np.asarray(run["alignment.feet.p_WS"])[tick])


def test_state_and_truth_of_a_running_robot_do_not_mix():
    scenario = surefoot.load_scenario("walk_flat", set=ELSEWHERE)
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario)
    plant.write(controller.step(plant.read(), scenario.user(0)))
    state, truth = controller.state, plant.truth
    for expression in (lambda: state.p_WB - truth.p_SB, lambda: np.stack([controller.plan.feet["LF"].p_WF, truth.p_SF[0]]),
                       lambda: np.concatenate((state.p_WB, truth.p_SB)), lambda: np.linalg.norm(controller.model.p_WCom - truth.p_SCom)):  # fmt: skip
        with pytest.raises(WorldError, match="in W, the controller's world, the other in S.*Aligner"):
            expression()
    assert np.stack([state.p_WB, state.v_WB]).world == "W" and not hasattr(state.q, "world")
    state.p_WB[0] = 7.0
    state.p_WB += [1, 0, 0]
    assert state.p_WB[0] == 8.0 and np.shares_memory(state.p_WB, state.p_WB)


def seen_by_parts(scenario):
    """A controller after some ticks with its plant, and the dynamics that its planner, its own task and its own gait were given."""
    given = {}

    class Plans(surefoot.Planner):
        def update(self, user, state, dynamics, last):
            given["planner"] = dynamics
            return super().update(user, state, dynamics, last)

    class Looks(surefoot.OwnTask):
        max_rows = 1

        def rows(self, tick):
            given["task"] = tick.dynamics

    class Stands(surefoot.Gait):
        def com(self, now):
            given["gait"] = now.dynamics
            return now.com

    user = "user=[{time: 0, walk: true, gait: mine}]"
    words = ["planner.calibration.duration=0", user, *ELSEWHERE]
    scenario = surefoot.load_scenario(scenario, gaits={"mine": Stands}, stack=surefoot.Stack("terrain_adaptation").last(Looks("looks")), set=words)
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant, planner=Plans(scenario))
    while plant.time < 0.5:
        plant.write(controller.step(plant.read(), scenario.user(plant.time)))
    assert controller.fault == "" and len(given) == 3
    return plant, controller, given


def test_points_of_dynamics_are_in_the_controllers_world():
    plant, controller, given = seen_by_parts("walk_flat_ideal")
    truth = plant.truth
    of_state = surefoot.Robot("anymal_b").dynamics(controller.state)
    for dynamics in (controller.dynamics, of_state, *given.values()):
        frame, foot = dynamics.frame("LF_FOOT"), dynamics.feet["LF"]
        assert dynamics.world == foot.world == frame.rotation.world == "W"
        for expression in (lambda: dynamics.com.p - truth.p_SCom, lambda: foot.p - truth.p_SF[0], lambda: dynamics.base.v - truth.v_SB,
                           lambda: dynamics.hips["RF"].J @ np.ones(18) - truth.v_SB, lambda: dynamics.base_rotation.R @ truth.v_SB,
                           lambda: frame.point.p - truth.p_SF[0], lambda: frame.rotation.w - truth.v_SB, lambda: dynamics.contacts["RH"].Jdot_u + truth.v_SB):  # fmt: skip
            with pytest.raises(WorldError, match="in W, the controller's world, the other in S"):
                expression()
        assert (dynamics.com.p[:2] - controller.plan.com.p).world == "W" and not hasattr(dynamics.M, "world")


def test_what_is_relative_to_the_base_is_in_neither_world():
    _, controller, _ = seen_by_parts("walk_flat_ideal")
    frame = controller.dynamics.frame("LF_FOOT", relative_to="base")
    assert frame.point.world == frame.rotation.world == ""
    for array in (frame.point.p, frame.point.v, frame.point.J, frame.point.Jdot_u, frame.rotation.R, frame.rotation.w):
        assert type(array) is np.ndarray


def test_dynamics_of_a_robot_are_in_the_world_of_the_arrays_that_they_are_of():
    plant, controller, _ = seen_by_parts("walk_flat_ideal")
    robot, truth, state = surefoot.Robot("anymal_b"), plant.truth, controller.state
    true = robot.dynamics(truth.qpos[7:], p_WB=truth.p_SB, q_WB=truth.qpos[3:7])
    assert true.world == "S" and np.linalg.norm(true.com.p - truth.p_SCom) < 0.01
    with pytest.raises(WorldError, match="in W, the controller's world, the other in S"):
        true.com.p - state.p_WB
    believed = robot.dynamics(state.q, p_WB=state.p_WB, q_WB=state.q_WB)
    assert believed.world == "W" and np.allclose(believed.com.p, controller.dynamics.com.p)
    with pytest.raises(WorldError, match="Robot.dynamics of both means nothing"):
        robot.dynamics(state.q, p_WB=truth.p_SB, q_WB=state.q_WB)
    with pytest.raises(WorldError, match="world is 'W', and an array is in S"):
        robot.dynamics(p_WB=truth.p_SB, world="W")
    alone = robot.dynamics(p_WB=[1, 2, 3])
    assert alone.world == "" and type(alone.com.p) is np.ndarray and robot.dynamics(p_WB=[1, 2, 3], world="S").base.p.world == "S"
    with pytest.raises(surefoot.UnknownNameError, match='world is "B"; valid are: W, the controller\'s, S, the simulator\'s, and "", none of them'):
        robot.dynamics(world="B")


def test_an_axis_of_a_plot_takes_one_world_and_is_named_by_it(run):
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots()
    axes.plot(run.time, run["state.p_WB.x"])
    axes.plot(run.time, run.aligned_error("heading"))
    assert axes.get_ylabel() == "in W"
    with pytest.raises(WorldError, match="this axis has numbers in W, and these are in S"):
        axes.plot(run.time, run["truth.p_SB.x"])
    axes.set_ylabel("x [m]")
    axes.plot(run.time, run.in_W("truth.p_SB")[:, 0])
    figure.canvas.draw()
    assert axes.get_ylabel() == "x [m]"
    plt.close(figure)


def test_a_log_without_the_alignment_says_so(file, tmp_path):
    old = rewritten(file, tmp_path / "old.mcap", lambda channel, _, data: None if channel.topic == "/alignment" else data)
    with pytest.raises(surefoot.Error, match="has no /alignment: .* logs have it from 3.0 on; record the run anew"):
        surefoot.read(old).aligned_error("com")


def test_an_old_log_in_which_both_worlds_were_called_W_keeps_them_apart_too(file, tmp_path):
    old = surefoot.read(of_version(file, tmp_path, "2.13"))
    with pytest.raises(WorldError):
        old["truth.p_SB"] - old["state.p_WB"]
