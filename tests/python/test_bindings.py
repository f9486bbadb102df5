"""The Python module: the loop that its README shows, what it reads and writes, and its errors."""

import gc
import json
import math
import pathlib
import pickle
import re

import numpy as np
import pytest
import surefoot
from program import ROOT, answer, complaint, run_result


@pytest.fixture(scope="module")
def scenario():
    return surefoot.load_scenario("walk_flat_ideal", set=["duration=1"])


def walked(scenario, ticks):
    """Plant and controller after so many ticks."""
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    for _ in range(ticks):
        plant.write(controller.step(plant.read(), scenario.user(plant.time)))
    return plant, controller


def python_blocks(file):
    return re.findall(r"```python\n(.*?)```", file.read_text(), re.DOTALL)


def test_the_readmes_run_as_they_stand_and_the_loop_has_nine_lines(capsys):
    (top,), (loop, stack, hierarchy) = (python_blocks(ROOT / file) for file in ("README.md", "python/README.md"))

    def run(block):
        names = {}  # each block stands alone
        exec(block, names)
        return names, capsys.readouterr().out

    names, _ = run(loop)
    assert len(loop.splitlines()) == 9
    assert names["plant"].truth.p_SB[0] > 0.3
    names, printed = run(stack)
    assert "kinova_position: frame_position kd=20 kp=100" in printed
    levels = [name for name in names["controller"].level_names if name != "arm_rest"]  # which a robot with an arm gets
    assert levels == names["stack"].level_names and names["weighted"].level_names[-1] == "weighted"
    names, printed = run(top)
    assert names["plant"].time == pytest.approx(15)
    assert [line.split("'")[1] for line in printed.splitlines()] == names["controller"].level_names
    _, printed = run(hierarchy)
    assert printed.splitlines()[-1] == re.search(r"# (\[.*)", hierarchy)[1]


def test_the_loop_is_bit_for_bit_that_of_the_program():
    program = run_result("walk_flat_sea", "--seed", 3, "--set", "duration=1.5")
    scenario = surefoot.load_scenario("walk_flat_sea", seed=3, set=["duration=1.5"])
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    torques = [np.zeros(12)]
    while plant.time < scenario.duration:
        command = controller.step(plant.read(), scenario.user(plant.time))
        torques.append(command.torque)
        plant.write(command)
    assert program["torque_command_max_nm"] == np.abs(torques).max()
    assert program["torque_step_max_nm"] == np.abs(np.diff(torques[1:], axis=0)).max()


def test_version_and_scenarios_are_those_of_the_program():
    assert all(name in answer("list", "scenarios") for name in surefoot.scenarios())
    assert f"VERSION {surefoot.__version__} " in (ROOT / "CMakeLists.txt").read_text()


def test_a_scenario_is_loaded_with_seed_and_assignments():
    scenario = surefoot.load_scenario("step_down", seed=7, set=["duration=3.5", "robot=anymal_b"])
    assert (scenario.name, scenario.seed, scenario.duration, scenario.robot) == ("step_down", 7, 3.5, "anymal_b")
    assert scenario.joint_names[3] == "RF_HAA" and len(scenario.joint_names) == 12
    assert scenario.drawn == surefoot.load_scenario("step_down", seed=7).drawn != {}
    assert json.loads(scenario.options_json)["duration"] == 3.5
    assert scenario.period == 0.0025
    assert scenario.torque_limit.shape == (12,) and (scenario.torque_limit > 0).all()


SCENARIOS = [
    (["walk_flatt"], {}, "walk_flatt.*walk_flat"),
    (["/no/where.yaml"], {}, "/no/where.yaml"),
    (["walk_flat"], {"seed": -1}, "seed is -1; valid is a whole number from 0 to 999999999"),
    (["walk_flat"], {"seed": 10**25}, "seed is 10000000000000000000000000; valid"),
    (["walk_flat"], {"set": ["duratoin=1"]}, "duratoin.*duration"),
    (["walk_flat"], {"set": ["duration"]}, "duration"),
]
ONE = {"A": [[1]], "b": [1]}
LEVELS = [
    ([], "no unknowns"),
    ([3], "level 1: is 3; expected a dict"),
    ([{"A": [[1]], "B": [1]}], "level 1: unknown key \"B\".*valid"),
    ([ONE | {"lowr": [0]}], "unknown key \"lowr\"; did you mean \"lower\""),
    ([{"A": [[1]]}], r"level 1: A goes with b \(A x = b\); given are: A$"),
    ([{"A": [[1]], "lower": [0], "upper": [1]}],
     "level 1: rows with bounds are those of D, lower ≤ D x ≤ f; write D instead of A, and f instead of upper; given are: A, lower, upper$"),
    ([{"A": [[1]], "lower": [0]}], "level 1: rows with bounds are those of D"),
    ([{"A": [[1]], "D": [[1]], "lower": [0]}], "level 1: A goes with b"),
    ([{"lower": [1]}], "level 1: D goes with lower, f or both .* given are: lower$"),
    ([{"D": [[1]]}], "level 1: D goes with lower, f or both .* given are: D$"),
    ([{"A": [1, 2], "b": [1]}], r"level 1: A has the shape \(2,\); expected \(rows, unknowns\)$"),
    ([{"A": [[1]], "b": 1}], r"b has the shape \(\); expected \(rows,\)$"),
    ([{"A": [[1, 2], [3]], "b": [1, 2]}], r"level 1: A: .*inhomogeneous.*; expected numbers of shape \(rows, unknowns\)$"),
    ([{"A": [["x"]], "b": [1]}], "level 1: A: .*'x'; expected numbers"),
    ([{"A": [[1]], "b": [1, 2]}], "b has 2 elements, A has 1 row"),
    ([{"A": [[1]], "b": [np.nan]}], r"level 1: b\[0\] is nan; expected a number"),
    ([{"A": [[1]], "b": [None]}], r"level 1: b\[0\] is nan; expected a number"),
    ([{"A": [[1]], "b": [np.inf]}], r"A\[0\] has the bounds inf and inf"),
    ([{"A": [[1]], "b": [1e120]}], r"level 1: b\[0\] is 1e[+]120, too large .* expected at most 1e100"),
    ([{"A": np.eye(1) * 1j, "b": [1]}], "level 1: A is complex; expected real"),
    ([{"A": [[1]], "b": [1 + 2j]}], "level 1: b is complex; expected real"),
    ([{}, {"A": [[-1e200]], "b": [1]}], r"level 2: A\[0, 0\] is -1e[+]200, too large .* expected at most 1e100"),
    ([{"A": [[1, 2], [1e-300, 0]], "b": [1, 2]}], r"level 1: A\[1\] has nothing larger than 1e-300, too small .* at least 1e-100, or zeros only"),
    ([{"D": [[1, 2], [3, np.inf]], "f": [1, 2]}], r"level 1: D\[1, 1\] is inf; expected a finite number"),
    ([{"D": [[1]], "lower": [2], "f": [1e-9]}], r"level 1: D\[0\] has the bounds 2.0 and 1e-09, which nothing can meet; expected lower ≤ upper"),
    ([{"D": [[1]], "f": [1], "D_names": ["a", "b"]}], "level 1: D_names has 2 elements, D has 1 row"),
    ([{"D": [[1]], "f": [1], "D_names": [3]}], r"level 1: D_names is \[3\]; expected a list of texts"),
    ([ONE | {"D_ids": [1]}], "level 1: D_ids goes with D; given"),
    ([ONE, {"D": [[1, 2]], "f": [1]}], "level 2: D has 2 columns; the rows before it have 1"),
    ([ONE | {"name": 3}], "level 1: name is 3; expected a text"),
    ([ONE | {"A_weights": [0]}], r"level 1: A_weights\[0\] is 0.0; expected a number above 0, at most 1e100"),
    ([{"D": [[1]], "f": [1], "D_weights": [np.inf]}], r"D_weights\[0\] is inf; expected"),
    ([{"D": [[1]], "f": [1], "D_weights": [1, 2]}], "level 1: D_weights has 2 elements, D has 1 row; expected one element for each row"),
    ([ONE | {"D_weights": [1]}], "level 1: D_weights goes with D; given"),
    ([{"A": [[1]], "b": [1e60], "A_weights": [1e60]}], r"A_weights\[0\] makes a number that is .*, too large"),
    ([{"A": [[1e-60]], "b": [0], "A_weights": [1e-60]}], r"A_weights\[0\] makes a row that has nothing larger than 1e-120, too small"),
    ([{"A": [[1], [1e-90]], "b": [0, 0], "A_weights": [1, 1e-250]}], r"A_weights\[1\] is 1e-250 and makes zeros of A\[1\], too small"),
    ([ONE | {"damping": 0}], "level 1: damping is 0; expected a number above 0"),
    ([ONE | {"damping": "much"}], "level 1: damping is 'much'; expected"),
]
REFERENCES = [([1, 2], "x_ref has 2 elements; expected 1, one for each unknown"), ([np.nan], r"x_ref\[0\] is nan; expected a finite"),
              ([1e120], r"x_ref\[0\] is 1e[+]120, too large"), ("near", "x_ref: .*near")]  # fmt: skip
METHODS = [({"method": "simplex"}, "there are: lexicographic, cascade"), ({"method": "cascade", "budget": 1e3}, "the cascade has no budget")]
FAR = {"A": [[1e-100]], "b": [1e100]}
CALLS = [*((surefoot.load_scenario, *call) for call in SCENARIOS), *((surefoot.solve, [levels], {}, told) for levels, told in LEVELS),
         *((surefoot.solve, [[ONE]], {"x_ref": x_ref}, told) for x_ref, told in REFERENCES),
         *((surefoot.solve, [[ONE]], options, told) for options, told in METHODS),
         *((surefoot.solve, [[FAR]], {"method": method}, "beyond the range of doubles") for method in ("lexicographic", "cascade"))]  # fmt: skip


@pytest.mark.parametrize("call, arguments, options, message", CALLS)
def test_wrong_input_raises_and_says_what_would_be_valid(call, arguments, options, message):
    with pytest.raises(surefoot.Error, match=message) as raised:
        call(*arguments, **options)
    assert isinstance(raised.value, ValueError) and isinstance(raised.value, surefoot.UnknownNameError) == (arguments in (["walk_flatt"], ["/no/where.yaml"]))


def test_the_message_is_the_programs():
    with pytest.raises(surefoot.Error) as raised:
        surefoot.load_scenario("walk_flat", set=["planner.gait.ordr=1"])
    place, _, message = str(raised.value).partition(": ")
    assert place == "set has 'planner.gait.ordr=1'" and message in complaint("run", "walk_flat", "--set", "planner.gait.ordr=1")


def test_a_scenario_is_not_changed(scenario):
    with pytest.raises(surefoot.Error, match=r"^duration of a scenario can't be set; load_scenario\('walk_flat\w*', set=\{'duration': …\}\) reads one with another$"):
        scenario.duration = 3.0
    for name, said in [("seed", r"walk_flat_ideal', seed=…\) reads one"), ("joint_names", r"set=\{…\}\) reads one with another, by the keys that `surefoot list options` has")]:
        with pytest.raises(surefoot.Error, match=said):
            setattr(scenario, name, 1)
    with pytest.raises(surefoot.Error, match=r"a Plant has no friction to set; push\(\) and fail\(\) change what it does"):
        surefoot.Plant(scenario).friction = 1.0
    with pytest.raises(surefoot.Error, match="mass of a Robot can't be set; a robot file with another one would be valid .anymal_b is this robot's."):
        scenario.robot_model.mass = 10.0


def test_arrays_have_the_shapes_that_their_help_says(scenario):
    plant, controller = walked(scenario, 2)
    plan = controller.plan
    for owner in (plant.read(), plant.truth, controller.state, plan, plan.com, plan.torso, controller.model):
        for name in dir(owner):
            value = getattr(owner, name)
            if isinstance(value, np.ndarray) and name not in ("qpos", "qvel", "ctrl", "xfrc_applied", "joints"):
                help_text = getattr(type(owner), name).__doc__
                shape = str(value.shape).replace("12", "number of joints").replace("(4", "(number of legs")
                assert f"shape {shape}" in help_text or f"shape {value.shape}" in help_text  # (4,): a quaternion
                assert value.dtype == np.float64
                is_quaternion = name in ("q_WB", "q_SB")
                assert value.flags.writeable != is_quaternion
    assert plan.joints.shape == (0,), "no task follows them"
    plan.joints = [0.1] * 12
    assert plan.joints.shape == (12,)


def test_what_is_read_is_what_the_simulator_knows(scenario):
    plant, controller = walked(scenario, 40)
    truth, reading, state = plant.truth, plant.read(), controller.state
    w, x, y, z = truth.q_SB
    assert plant.time == truth.time == reading.time == pytest.approx(0.1)
    np.testing.assert_array_equal(truth.p_SB, truth.qpos[:3])
    np.testing.assert_array_equal([w, x, y, z], truth.qpos[3:7])
    assert len(truth.xfrc_applied) % 6 == 0 and len(truth.xfrc_applied) > 0 and not any(truth.xfrc_applied)
    np.testing.assert_array_equal(sorted(truth.q), sorted(truth.qpos[7:]))
    assert np.linalg.norm(truth.p_SCom - np.asarray(controller.model.p_WCom)) < 1e-3
    assert np.isnan(reading.foot_force).all()
    assert state.foot_force.shape == (4, 3) and state.foot_force[:, 2].min() > 20
    assert set(truth.feet) == {"LF", "RF", "LH", "RH"}
    assert all(foot.touching and foot.force[2] > 20 for foot in truth.feet.values())
    assert plant.terrain_height(0, 0) == pytest.approx(0)
    assert "<mujoco" in plant.model_xml()


def test_a_control_frame_is_a_rotation_matrix_row_by_row():
    _, controller = walked(surefoot.load_scenario("slope_up", set=["duration=2"]), 3)
    R_WC = controller.plan.R_WC
    np.testing.assert_allclose(R_WC @ R_WC.T, np.eye(3), atol=1e-12)
    assert R_WC[0, 2] != R_WC[2, 0] or R_WC[0, 2] == 0


def test_snapshots_do_not_change_and_arrays_outlive_their_object(scenario):
    plant, controller = walked(scenario, 1)
    before, array = plant.truth, plant.truth.qpos
    command = controller.step(plant.read(), scenario.user(0.0))
    kept = before.qpos.copy(), command.torque.copy()
    walked_on = [plant.write(controller.step(plant.read(), scenario.user(plant.time))) for _ in range(5)]
    gc.collect()
    assert len(walked_on) == 5
    np.testing.assert_array_equal(before.qpos, kept[0])
    np.testing.assert_array_equal(array, kept[0])
    np.testing.assert_array_equal(command.torque, kept[1])


def test_a_controller_keeps_its_plant_alive(scenario):
    controller = surefoot.Controller(scenario, surefoot.Plant(scenario))
    reading = surefoot.Plant(scenario).read()
    gc.collect()
    assert np.isfinite(controller.step(reading, surefoot.UserCommand()).torque).all()


def test_a_reading_has_the_joints_of_a_robot_with_an_arm():
    scenario = surefoot.load_scenario("reach")
    assert scenario.arms == ["kinova"]
    reading = surefoot.SensorReading(num_joints=len(scenario.joint_names))
    assert reading.q.shape == reading.torque.shape == (18,)
    assert np.isnan(reading.q).all()
    with pytest.raises(surefoot.Error, match="num_joints is 33; a robot has 1 to 32 joints"):
        surefoot.SensorReading(num_joints=33)
    with pytest.raises(surefoot.Error, match="num_legs is 12; a robot has 2, 4 or 6 legs"):
        surefoot.MotionPlan(num_legs=12)


@pytest.mark.parametrize("num_legs", [2, 4, 6])
def test_a_reading_has_the_foot_sensors_of_a_robot_with_any_legs(num_legs):
    reading = surefoot.SensorReading(3 * num_legs, num_legs)
    assert reading.foot_force.shape == (num_legs,) and np.isnan(reading.foot_force).all()
    reading.foot_force = 50.0 + np.arange(num_legs)
    reading.foot_force[1] = np.nan
    again = pickle.loads(pickle.dumps(reading))
    np.testing.assert_array_equal(again.foot_force, [50.0, np.nan, *range(52, 50 + num_legs)])
    with pytest.raises(surefoot.Error, match=f"foot_force has {num_legs} numbers; 3 were given"):
        reading.foot_force = [1, 2, 3]
    with pytest.raises(surefoot.Error, match="num_legs is 3; a robot has 2, 4 or 6 legs"):
        surefoot.SensorReading(9, num_legs=3)


def test_torques_of_ones_own_are_applied(scenario):
    torque = np.linspace(-3, 3, 12)
    plants = [surefoot.Plant(scenario) for _ in range(3)]
    command = surefoot.JointCommand()
    command.torque[:] = torque
    for _ in range(4):
        plants[0].write(torque)
        plants[1].write(command)
        plants[2].write(surefoot.JointCommand(list(torque)))
    np.testing.assert_array_equal(plants[0].truth.torque, torque)
    np.testing.assert_array_equal(plants[0].truth.qpos, plants[1].truth.qpos)
    np.testing.assert_array_equal(plants[0].truth.qpos, plants[2].truth.qpos)
    with pytest.raises(surefoot.Error, match="the command has 11 torques, but the robot has 12 joints"):
        plants[0].write(torque[:11])


def test_readings_that_are_spoilt_are_marked_and_bridged_for_20_ms_then_the_command_is_a_safe_one(scenario):
    plant, controller = walked(scenario, 5)
    before, modes = controller.health, []
    for _ in range(12):
        reading = plant.read()
        reading.q[3] = np.nan
        command = controller.step(reading, surefoot.UserCommand(walk=True, velocity=(0.1, 0.0), yaw_rate=0.1))
        assert np.isfinite(command.torque).all()
        modes.append(command.mode)
        plant.write(command)
    assert modes == ["optimal"] * 8 + ["sit"] * 4
    assert before.encoders.fault == "none" and before.encoders.age == 0 and controller.health.imu.fault == "none"
    assert controller.health.encoders.fault == "not_a_number" and controller.health.encoders.joint == 3


def test_user_commands_hold_what_they_were_made_from(scenario):
    user = surefoot.UserCommand(walk=True, velocity=[0.1, -0.05], yaw_rate=0.2, height=0.03)
    assert (user.walk, user.yaw_rate, user.height) == (True, 0.2, 0.03)
    np.testing.assert_array_equal(user.velocity, [0.1, -0.05])
    assert not scenario.user(0.0).walk and scenario.user(0.9).walk


def test_levels_come_in_order_and_leave_less_and_less_freedom(scenario):
    plant, controller = walked(scenario, 40)
    levels = controller.levels()
    assert [level.name for level in levels] == controller.level_names
    assert levels[0].residual < 1e-6 and levels[0].num_rows >= 6
    freedom = [level.degrees_of_freedom_left for level in levels]
    assert freedom == sorted(freedom, reverse=True)
    assert repr(levels[0]).startswith(f"Level('{levels[0].name}', residual=")
    assert surefoot.Controller(scenario, plant).levels() == []


def test_phases_events_and_the_limits_of_a_leg_about_to_lift_are_named(scenario):
    plant, controller = walked(scenario, 1)
    assert {leg: foot.phase for leg, foot in controller.plan.feet.items()} == dict.fromkeys(("LF", "RF", "LH", "RH"), "stance")
    timing = controller.timing
    assert timing.total >= timing.solve > 0
    assert repr(timing).startswith(f"TickTiming(time={timing.time!r} s, estimate={timing.estimate!r} µs, ") and repr(plant) == "<plant after 0.0025 s>"
    with pytest.raises(surefoot.Error, match="friction is -1;"):
        controller.set_friction(-1)
    seen, events = set(), set()
    while plant.time < 3.0:
        plant.write(controller.step(plant.read(), scenario.user(plant.time)))
        events |= {(event.event, event.name, event.leg in ("LF", "RF", "LH", "RH")) for event in controller.plan.events}
        assert controller.timing.time == controller.state.time
        leaving = [leg for leg, foot in controller.plan.feet.items() if foot.phase == "unloading"]
        active = [found for level in controller.levels() for found in level.active]
        assert {state for _, state in active} <= {"at lower", "at upper", "below lower", "above upper"}
        seen |= {(f"{leg} normal force", "at upper") for leg in leaving} & set(active)
    assert seen and {(1, "lift-off", True), (2, "touchdown", True)} <= events


def test_the_stub_beside_the_module_is_python_and_names_everything():
    stub = (pathlib.Path(surefoot.__file__).parent / "_core.pyi").read_text()
    compile(stub, "_core.pyi", "exec")
    assert all(re.search(rf"^(class|def) {name}\b", stub, re.MULTILINE) for name in dir(surefoot._core) if name[0] != "_")


def test_vectors_of_a_command_are_assigned_and_wrong_ones_refused():
    user = surefoot.UserCommand()
    user.velocity = [0.1, 0]
    assert list(user.velocity) == [0.1, 0]
    with pytest.raises(surefoot.Error, match="velocity has 2 numbers; 3 were given"):
        user.velocity = [0.1, 0, 0]
    with pytest.raises(surefoot.Error, match="velocity has 2 numbers; 1 were given"):
        surefoot.UserCommand(velocity=[0.1])
    with pytest.raises(surefoot.Error, match=r"velocity\[1\] is nan; a finite number would be valid"):
        user.velocity = np.array([0, np.nan])
    with pytest.raises(surefoot.Error, match="height is inf"):
        user.height = math.inf
    with pytest.raises(surefoot.Error, match=r"torque\[4\] is nan"):
        surefoot.JointCommand([0, 0, 0, 0, math.nan])
    assert list(user.velocity) == [0.1, 0] and user.height == 0


def test_objects_print_what_they_hold(scenario):
    assert repr(surefoot.UserCommand(walk=True, velocity=[0.1, 0])).startswith("UserCommand(walk=True, velocity=[0.1 0. ], ")
    plant, controller = walked(scenario, 2)
    assert repr(scenario) == "<scenario walk_flat_ideal of anymal_b, seed 0>"
    assert repr(plant).startswith("<plant after 0.005") and repr(controller).startswith("<controller of anymal_b, 6 levels")
    assert "p_WB=[" in repr(controller.state) and "FootPlan(" in repr(controller.plan)


def test_a_log_is_read_channel_by_channel(log):
    run = surefoot.read(log)
    assert run["state.p_WB"].shape == (len(run.time), 3)
    assert np.array_equal(run["state.p_WB.x"], run["state.p_WB"][:, 0])
    assert run.channels["state.p_WB.x"] == "m" and "walk_flat_ideal" in repr(run)
    assert np.array_equal(run["time"], run.time)
    with pytest.raises(KeyError, match=r'has no channel state.p_WX; did you mean "state.p_WB"'):
        run["state.p_WX"]
    with pytest.raises(KeyError, match=r'has no topic stat; did you mean "state"'):
        run["stat.p_WB"]
    with pytest.raises(surefoot.Error, match="none.mcap"):
        surefoot.read("none.mcap")
