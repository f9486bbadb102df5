"""Tasks, planners and estimators written in Python, and what becomes of a walk when they go wrong."""

import copy
import re
import time

import numpy as np
import pytest

import surefoot
from surefoot import OwnTask, Stack, tasks


class Height(OwnTask):
    """The library's torso_height, in Python."""

    max_rows, unit, row_names = 1, "m/s²", ["height"]
    kp, kd, max_error = 200.0, 28.0, 0.02

    def rows(self, tick):
        base, torso = tick.dynamics.base, tick.plan.torso
        error = np.clip(torso.height - base.p[2], -self.max_error, self.max_error)
        b = torso.height_acceleration + self.kd * (torso.height_rate - base.v[2]) + self.kp * error - base.Jdot_u[2]
        return base.J[2:3], [b]


def standing(task, duration=1.5):
    stack = Stack("terrain_adaptation").replace("torso_height", task)
    return surefoot.load_scenario("walk_flat_ideal", stack=stack, set=[f"duration={duration}"])


def test_a_task_in_python_gives_what_the_librarys_gives():
    ours = surefoot.run(standing(Height("torso_height_in_python"), duration=3))
    theirs = surefoot.run("walk_flat_ideal", stack="terrain_adaptation", set=["duration=3"])
    assert ours["com_error_max_m"] == pytest.approx(theirs["com_error_max_m"], rel=0.02)
    assert ours["steps_taken"] == theirs["steps_taken"] > 0 and not ours["fell"]


def test_its_rows_have_their_names_and_it_can_be_weighted_and_moved():
    class Limit(Height):
        def rows(self, tick):
            return tick.dynamics.base.J[2:3], [-0.01], [np.inf]

    stack = Stack("terrain_adaptation").before("com_xy", Limit("limit")).weighted_from("torso_yaw", torso_yaw=2)
    assert "limit" in stack.level_names and [task.name for task in stack.own_tasks] == ["limit"]
    scenario = surefoot.load_scenario("walk_flat_ideal", stack=stack)
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    rows = set()
    for _ in range(40):
        plant.write(controller.step(plant.read(), scenario.user(0.0)))
        rows |= {row for level in controller.levels() for row, _ in level.active}
    assert controller.fault == "" and "height" in rows


def raising(tick):
    raise ValueError("no idea")


BAD = {
    "raises": (raising, "ValueError: no idea (test_own_parts.py, line "),
    "nan": (lambda tick: (tick.dynamics.base.J[2:3], [np.nan]), "wrote row 0 (height) with the bounds nan and nan"),
    "huge": (lambda tick: (tick.dynamics.base.J[2:3], [1e200]), "wrote row 0 (height) with a number above 1e100"),
    "columns": (lambda tick: (np.zeros((1, 7)), [0]), "A with 7 columns; 18, one for each acceleration, or 30 with the torques would be valid"),
    "bounds": (lambda tick: (np.zeros((1, 18)), [0, 1]), "rows() gave 1 rows, but 2 lower and 2 upper bounds"),
    "too many": (lambda tick: (np.zeros((3, 18)), [0, 0, 0]), "rows() gave 3 rows, and max_rows is 1"),
    "no rows": (lambda tick: 7, "rows() gave 7; (A, b) for A x = b, (A, lower, upper) or None would be valid"),
    "flat": (lambda tick: ([1.0] * 18, [0]), "rows() gave A of shape (18,)"),
    "complex": (lambda tick: (np.ones((1, 18)) * 1j, [0]), "rows() gave A of complex numbers; real ones would be valid"),
    "text": (lambda tick: ("A", "b"), "ValueError"),
}


@pytest.mark.parametrize("wrong, said", BAD.values(), ids=BAD)
def test_a_task_that_goes_wrong_ends_in_a_safe_posture_and_a_message_that_names_it(wrong, said):
    class Odd(Height):
        def rows(self, tick):
            return wrong(tick) if tick.plan.time > 0.2 else super().rows(tick)

    scenario = standing(Odd("odd"))
    plant = surefoot.Plant(scenario)
    controller, modes = surefoot.Controller(scenario, plant), []
    with pytest.warns(RuntimeWarning, match='"odd"') as warned:
        while plant.time < 1.0:
            command = controller.step(plant.read(), scenario.user(plant.time))
            modes.append(command.mode)
            assert np.isfinite(command.torque).all()
            plant.write(command)
    assert len(warned) == 1 and modes[0] == "optimal" and modes[-1] == "sit" and "hold" in modes
    assert '"odd"' in controller.fault and said in controller.fault
    assert plant.truth.p_SB[2] > 0.2, "it does not fall"


def test_of_a_run_the_reason_names_the_task():
    class Bad(Height):
        begin = 0.2

        def rows(self, tick):
            return raising(tick) if tick.plan.time >= self.begin else super().rows(tick)

    with pytest.warns(RuntimeWarning, match='"bad"'):
        result = surefoot.run(standing(Bad("bad")))
    assert not result.succeeded and '"bad"' in result.reason
    for duration in (0.2, 3.0):
        with pytest.warns(RuntimeWarning, match='"worst"'):
            failed = surefoot.run(standing(type("Worst", (Bad,), {"begin": 0.0})("worst"), duration=duration))
        assert failed.succeeded is False and '"worst"' in failed.reason
    never = Bad("never")
    never.begin = 0.0
    with pytest.warns(RuntimeWarning, match='"never"'):
        result = surefoot.run(standing(never, duration=0.2))
    assert '"never"' in result.fault
    assert result["fallback_ticks"] == 80 and any('"never"' in note for note in result.notes)


def test_parts_that_take_longer_than_a_tick_are_told():
    class Slow(Height):
        pause = 0.004

        def rows(self, tick):
            time.sleep(self.pause)
            return super().rows(tick)

    class SlowPlanner(surefoot.Planner):
        def update(self, user, state, dynamics, last):
            time.sleep(0.004)
            return super().update(user, state, dynamics, last)

    def notes(task, **parts):
        return [note for note in surefoot.run(standing(task, duration=0.1), **parts).notes if "in the median" in note]

    fast = Slow("fast")
    fast.pause = 0
    assert notes(fast) == []
    [note] = notes(Slow("slow"))
    assert re.fullmatch(r"the stage of your own task slow takes \S+ ms in the median, and a tick has 2.5 ms", note)
    [note] = notes(fast, planner=SlowPlanner(standing(fast)))
    assert note.startswith("the stage of your own planner takes ")


@pytest.mark.parametrize("attribute, given, said", [
    ("max_rows", "3", "max_rows is the text '3'; the largest number of rows"),
    ("unit", 3, "unit is 3; a text"), ("unit", None, "unit is None; a text"),
    ("row_names", "xyz", "row_names is the text 'xyz'; a list of texts"), ("row_names", [1, 2], r"row_names is \[1, 2\]; a list of texts"),
    ("row_names", None, "row_names is None; a list of texts"),
])  # fmt: skip
def test_an_attribute_of_a_task_that_makes_no_sense_is_named(monkeypatch, attribute, given, said):
    odd = type("Odd", (Height,), {attribute: given})("odd")
    monkeypatch.setattr("surefoot.task._registered", {"odd": odd})  # as one that was changed later
    for use in (lambda: Stack("terrain_adaptation").last(odd), lambda: Stack("terrain_adaptation"), lambda: surefoot.load_scenario("walk_flat")):
        with pytest.raises(surefoot.Error, match=f'task "odd": {said}.* would be valid'):
            use()


def test_a_task_with_such_an_attribute_is_not_registered():
    with pytest.raises(surefoot.Error, match='task "odd": unit is 3; a text would be valid'):
        surefoot.register_task(type("Odd", (Height,), {"unit": 3})("odd"))
    surefoot.Stack("terrain_adaptation")


def test_what_is_of_a_leg_is_written_in_its_place():
    plan = surefoot.MotionPlan()
    for by_leg in (plan.feet, surefoot.RobotState().slips):
        with pytest.raises(surefoot.Error, match=r"plan.feet\['LF'\].p_WF = "):
            by_leg["LF"] = True
        with pytest.raises(surefoot.Error, match="can't be replaced"):
            by_leg.update(LF=True)
        assert by_leg.copy() == by_leg and type(copy.deepcopy(by_leg)) is dict
    plan.feet["LF"].p_WF = [1, 2, 3]
    assert plan.feet["LF"].p_WF[2] == 3


@pytest.mark.parametrize("make, said", [
    (lambda: type("Sizeless", (OwnTask,), {"rows": raising})("sizeless"), "max_rows is 0; the largest number of rows that rows"),
    (lambda: Height("com_xy"), "com_xy"),
    (lambda: type("Vast", (OwnTask,), {"max_rows": 10**7, "rows": raising})("vast"), "max_rows is 10000000; .* from 1 to 1000, would be valid"),
    (lambda: type("Named", (OwnTask,), {"max_rows": 1, "row_names": ["a", "b"], "rows": raising})("named"), "row_names has 2 names, and max_rows is 1"),
    (lambda: type("Writes", (OwnTask,), {"max_rows": 3, "write": lambda self, tick: None})("writes"), "Writes has no rows"),
    (lambda: Height("a: b"), "is no name of a level"),
    (lambda: type("Mine", (OwnTask,), {"__init__": lambda self: None, "rows": raising})(), r"Mine.__init__ must call super\(\).__init__\(name\) first"),
])  # fmt: skip
def test_a_task_that_can_be_none_is_refused_at_set_up(make, said):
    with pytest.raises(surefoot.Error, match=said):
        surefoot.load_scenario("walk_flat_ideal", stack=Stack("terrain_adaptation").last(make()))


def test_a_force_of_the_ground_can_be_part_of_a_task():
    class Light(OwnTask):
        max_rows, unit = 3, "N"

        def rows(self, tick):
            force = tick.force("LF")
            return force[:, :-1], [-50, -50, 0] - force[:, -1], [50, 50, 60] - force[:, -1]

    stack = Stack("terrain_adaptation").before("com_xy", Light("light"))
    scenario = surefoot.load_scenario("walk_flat_ideal", stack=stack, set=["user=[{time: 0}]"])
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    for _ in range(200):
        plant.write(controller.step(plant.read(), scenario.user(plant.time)))
    assert controller.fault == "" and controller.model.force[0][2] == pytest.approx(60, abs=0.1)


class Still(surefoot.Planner):
    plan = None

    def update(self, user, state, dynamics, last):
        self.plan = self.plan or surefoot.standing_plan(dynamics)
        self.plan.time = state.time
        return self.plan


class Walks(surefoot.Planner):
    def update(self, user, state, dynamics, last):
        return super().update(user, state, dynamics, last)


def test_a_planner_of_ones_own_is_followed_and_can_ask_the_librarys():
    scenario = surefoot.load_scenario("walk_flat_ideal", set=["duration=2"])
    still = surefoot.run(scenario, planner=Still())
    assert still["steps_taken"] == 0 and still["fallback_ticks"] == 0 and not still["fell"]
    assert surefoot.run(scenario, planner=Walks(scenario)).torques_hash == surefoot.run(scenario).torques_hash


@pytest.mark.parametrize("wrong, said", [(lambda: 1 / 0, "ZeroDivisionError"), (lambda: None, "returned None; a MotionPlan would be valid")])
def test_a_planner_that_goes_wrong_is_told_and_the_robot_sits_down(wrong, said):
    class Odd(Still):
        def update(self, user, state, dynamics, last):
            return wrong() if state.time > 0.2 else super().update(user, state, dynamics, last)

    scenario = surefoot.load_scenario("walk_flat_ideal", set=["duration=1"])
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant, planner=Odd())
    with pytest.warns(RuntimeWarning, match="planner"):
        while plant.time < 1.0:
            command = controller.step(plant.read(), scenario.user(plant.time))
            plant.write(command)
    assert said in controller.fault and command.mode == "sit" and plant.truth.p_SB[2] > 0.2
    with pytest.raises(surefoot.Error, match="plans nothing by itself"):
        surefoot.Planner().update(scenario.user(0), controller.state, scenario.robot_model.dynamics(), None or hierarchy_outcome())


def test_the_librarys_planner_follows_a_gait_by_its_name():
    user = "user=[{time: 0.2, walk: true, velocity: [0.1, 0], gait: trot}, {time: 9, walk: true, gait: crawl}]"
    scenario = surefoot.load_scenario("trot", set=["duration=3", "planner.calibration.duration=0", "criteria=none", user])
    seen = []

    class Changes(surefoot.Planner):
        def __init__(self, name):
            super().__init__(scenario)
            self.name = name

        def update(self, user, state, dynamics, last):
            user.gait = self.name
            plan = super().update(user, state, dynamics, last)
            seen.append(scenario.gaits[plan.gait])
            return plan

    assert surefoot.run(scenario, planner=Changes("crawl")).fault == "" and seen[-1] == "crawl"
    with pytest.warns(RuntimeWarning, match="gait"):
        assert 'gait "craw' in surefoot.run(scenario, planner=Changes("crawls")).fault


def test_an_exception_whose_text_fails_is_told_by_its_kind():
    class Broken(Exception):
        def __str__(self):
            raise ValueError("no text")

    class Raises(Still):
        def update(self, user, state, dynamics, last):
            raise Broken

    with pytest.warns(RuntimeWarning, match=r"threw: Broken: its text can't be read \(test_own_parts.py, line \d+\)"):
        surefoot.run("walk_flat_ideal", set=["duration=0.01"], planner=Raises())


def hierarchy_outcome():
    """As a planner is given it."""
    kept = []

    class Keeps(Still):
        def update(self, user, state, dynamics, last):
            kept.append(last)
            return super().update(user, state, dynamics, last)

    surefoot.run("walk_flat_ideal", set=["duration=0.01"], planner=Keeps())
    return kept[0]


def test_an_empty_plan_is_told():
    class Empty(surefoot.Planner):
        def update(self, user, state, dynamics, last):
            return surefoot.MotionPlan()

    with pytest.warns(RuntimeWarning, match="the planner's plan is empty: it has all feet at one place"):
        assert not surefoot.run("walk_flat_ideal", set=["duration=1"], planner=Empty()).succeeded


@pytest.mark.parametrize("change, said", [
    ({"friction": -1.0}, "friction -1 below 0"), ({"force_max": -3.0}, "force_max -3 N below 0"),
    ({"force_min": 900.0, "force_max": 10.0}, "force_min 900 N above force_max 10 N"),
])  # fmt: skip
def test_feet_whose_limits_make_no_sense_are_told(change, said):
    class Odd(Still):
        def update(self, user, state, dynamics, last):
            plan = super().update(user, state, dynamics, last)
            for name, value in change.items():
                setattr(plan.feet["LF"], name, value)
            return plan

    with pytest.warns(RuntimeWarning, match=f"{said} in foot LF"):
        assert not surefoot.run("walk_flat_ideal", set=["duration=1"], planner=Odd())["fell"]


def test_a_plan_without_a_time_is_told():
    class Timeless(Still):
        def update(self, user, state, dynamics, last):
            plan = super().update(user, state, dynamics, last)
            plan.time = np.nan
            return plan

    with pytest.warns(RuntimeWarning, match="the planner's plan has NaN or infinity in its time"):
        assert surefoot.run("walk_flat_ideal", set=["duration=1"], planner=Timeless()).succeeded is False


@pytest.mark.parametrize("given, said", [
    ({"time": np.nan}, "time is nan"), ({"friction": -1.0}, "friction is -1; a number of at least 0 would be valid"),
    ({"friction": np.inf}, "friction is inf"), ({"force_max": -1.0}, "force_max is -1"),
])  # fmt: skip
def test_a_standing_plan_that_no_controller_would_follow_is_not_made(given, said):
    with pytest.raises(surefoot.Error, match=said):
        surefoot.standing_plan(surefoot.Robot("anymal_b").dynamics(), **given)


def test_what_is_written_into_the_frames_of_a_plan_stays():
    plan, frame = surefoot.MotionPlan(), surefoot.FramePlan()
    frame.frame = 7
    plan.frames.append(frame)
    plan.frames[0].p_XF = [1, 2, 3]
    assert len(plan.frames) == 1 and [(each.frame, list(each.p_XF)) for each in plan.frames] == [(7, [1, 2, 3])]
    plan.frames = [*plan.frames, frame]
    plan.frames = plan.frames
    assert plan.frames[-1].p_XF[2] == 0 and plan.frames[0].p_XF[2] == 3 and "frame=7" in repr(plan.frames)
    more = plan.frames + [frame]
    plan.frames += [frame]
    assert type(more) is list and len(more) == len(plan.frames) == 3 and type(copy.deepcopy(plan.frames)) is list
    plan.frames = more[:1]
    plan.frames.extend(more[1:2])
    with pytest.raises(IndexError, match="there is no frame 2, of 2"):
        plan.frames[2]
    for more in (lambda: [plan.frames.append(frame) for _ in range(5)], lambda: setattr(plan, "frames", [frame] * 7)):
        with pytest.raises(surefoot.Error, match="a plan has at most 6 frames"):
            more()


@pytest.mark.parametrize("methods, said", [
    ({}, r"Mine has no update\(self, user, state, dynamics, last\)"),
    ({"update": lambda self, user, state: None}, r"Mine.update\(\): too many positional arguments; a function of user, state, dynamics, last would be valid"),
])  # fmt: skip
def test_a_planner_without_the_right_update_is_refused(methods, said):
    with pytest.raises(surefoot.Error, match=said):
        surefoot.run("walk_flat_ideal", planner=type("Mine", (surefoot.Planner,), methods)())


def test_what_a_library_raises_is_told_by_the_users_own_line():
    class Singular(Height):
        def rows(self, tick):
            return np.linalg.inv(np.zeros((1, 1))), [0.0]

    with pytest.warns(RuntimeWarning, match=r"Singular matrix \(test_own_parts.py, line \d+\)") as warned:
        surefoot.run(standing(Singular("singular"), duration=0.1))
    assert warned[0].filename == __file__


@pytest.mark.parametrize("base, part", [(surefoot.Planner, "planner"), (surefoot.Estimator, "estimator")])
def test_a_part_whose_base_was_not_made_is_told_how(base, part):
    made = type("Mine", (base,), {"__init__": lambda self: None})()
    with pytest.raises(surefoot.Error, match=r"Mine.__init__ must call super\(\).__init__\(\) first"):
        surefoot.run("walk_flat", set=["duration=0.1"], **{part: made})


class Asks(surefoot.Estimator):
    def update(self, reading, context):
        return super().update(reading, context)


def test_an_estimator_of_ones_own_is_believed_and_can_ask_the_librarys():
    scenario = surefoot.load_scenario("walk_flat", set=["duration=1"])
    assert surefoot.run(scenario, estimator=Asks(scenario)).torques_hash == surefoot.run(scenario).torques_hash


def test_an_estimator_that_goes_wrong_is_told_and_the_robot_sits_down():
    class Odd(Asks):
        def update(self, reading, context):
            state = super().update(reading, context)
            if reading.time > 0.2:
                state.q_WB = [0, 0, 0, 0]
            return state

    scenario = surefoot.load_scenario("walk_flat", set=["duration=1"])
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant, estimator=Odd(scenario))
    with pytest.warns(RuntimeWarning, match="estimator"):
        while plant.time < 1.0:
            command = controller.step(plant.read(), scenario.user(plant.time))
            plant.write(command)
    assert "q_WB has the length 0" in controller.fault and command.mode in ("sit", "hold") and plant.truth.p_SB[2] > 0.2


def forgets_the_velocity(reading, context):
    state = surefoot.RobotState()
    state.time, state.p_WB, state.q_WB, state.w_WB_B = reading.time, [0, 0, 0.49], [1, 0, 0, 0], reading.gyro
    state.q, state.qd, state.torque = reading.q, context.joint_velocity, reading.torque
    return state


@pytest.mark.parametrize("begin", [0.0, 0.5])
@pytest.mark.parametrize("made, named", [(lambda reading, context: surefoot.RobotState(), "time"), (forgets_the_velocity, "v_WB")])
def test_an_estimator_that_gives_nan_is_told_what_is_nan_and_the_robot_sits_down(begin, made, named):
    class Gives(Asks):
        def update(self, reading, context):
            return made(reading, context) if reading.time >= begin else super().update(reading, context)

    scenario = surefoot.load_scenario("walk_flat", set=["duration=3", "user=[{time: 0}]"])
    with pytest.warns(RuntimeWarning, match=f"NaN, infinity or an impossible value in {named}") as warned:
        result = surefoot.run(scenario, estimator=Gives(scenario))
    assert len(warned) == 1 and not result["fell"] and result.fault.endswith(named)
    assert "own" in result.reason and named in result.reason, result.reason


def test_a_plan_is_written_by_its_names():
    plan = surefoot.MotionPlan()
    plan.feet["LF"].phase = "swing"
    plan.torso.q_WB = [1, 0, 0, 0]
    assert plan.feet["LF"].phase == "swing" and plan.feet["RF"].phase == "stance"
    with pytest.raises(surefoot.UnknownNameError, match='phase is "swinging"; valid are: stance, unloading, swing, search'):
        plan.feet["LF"].phase = "swinging"
    assert tasks.ComXy in vars(tasks).values()


@pytest.mark.parametrize("run", [
    lambda scenario, own: surefoot.run(scenario, **own).torques_hash,
    lambda scenario, own: by_hand(surefoot.Controller(scenario, **own), scenario),
])  # fmt: skip
def test_a_planner_and_an_estimator_forget_the_run_before(run):
    """Friction and steps are the planner's, position and bias the estimator's."""

    class Counts(Walks):
        ticks = 0

        def update(self, user, state, dynamics, last):
            self.ticks += 1
            return super().update(user, state, dynamics, last)

        def restart(self):
            self.ticks = 0
            super().restart()

    scenario = surefoot.load_scenario("walk_flat", set=["duration=2"])
    own = {"planner": Counts(scenario), "estimator": Asks(scenario)}
    first = run(scenario, own)
    surefoot.run(scenario, **own, every_tick=lambda tick: tick.controller.set_friction(0.2))
    assert run(scenario, own) == first and 700 < own["planner"].ticks <= 800


def by_hand(controller, scenario):
    plant = surefoot.Plant(scenario)
    torques = []
    while plant.time < scenario.duration - 1e-9:
        torques.append(controller.step(plant.read(), scenario.user(plant.time)).torque.tobytes())
        plant.write(controller.command)
    return torques
