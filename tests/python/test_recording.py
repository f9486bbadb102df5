"""Logs of loops without a plant, logs that are computed again, and tasks that are tried."""

import signal

import numpy as np
import pytest

import surefoot


@pytest.fixture(autouse=True)
def nothing_is_registered(monkeypatch):
    """Whatever tests before registered."""
    monkeypatch.setattr("surefoot.task._registered", {})


def walk(recorder_of, ticks=100):
    """A controller on readings from anywhere, here from a plant that it doesn't know. `recorder_of(controller)`: made before its first tick."""
    scenario = surefoot.load_scenario("walk_flat", set=["duration=1"])
    plant, controller = surefoot.Plant(scenario), surefoot.Controller("anymal_b")
    recorder = recorder_of(controller)
    for tick in range(ticks):
        if tick == 50:
            controller.set_friction(0.4)
        plant.write(controller.step(plant.read(), scenario.user(plant.time)))
        recorder.add()
    return controller, recorder


def test_a_controller_without_a_plant_is_recorded_explained_and_computed_again(tmp_path):
    file = tmp_path / "robot.mcap"
    controller, recorder = walk(lambda controller: surefoot.Recorder(controller, str(file)))
    assert not file.exists(), "it is called .partial until it is closed"
    recorder.close()
    log = surefoot.read(file)
    assert len(log.time) == 100 and log["state.p_WB.z"][-1] == controller.state.p_WB[2]
    assert "truth" not in log.topics and "alignment" not in log.topics and repr(log).startswith("<anymal_b's controller without a plant, ")
    assert [each["text"] for each in log.events if each["text"].startswith("friction")] == ["friction 0.4, by the operator"]
    assert "friction_cone" in surefoot.explain(file, 0.2).text
    found = log.verify()
    assert found["same"] and found["ticks"] == 100
    with pytest.raises(surefoot.Error, match="has no metrics: it was recorded without a plant"):
        log.metrics
    with pytest.raises(surefoot.Error, match="has no /alignment: it was recorded without a plant"):
        log.aligned_error("com")
    with pytest.raises(surefoot.Error, match="has no attachment model.xml, which this needs; one that is recorded with a plant would be valid"):
        log.picture(0.1)


def test_a_recorder_is_closed_by_its_block(tmp_path):
    file = tmp_path / "robot.mcap"
    controller = surefoot.Controller("anymal_b")
    with surefoot.Recorder(controller, str(file)) as recorder:
        reading = surefoot.SensorReading(12)
        reading.time = 0.0
        controller.step(reading, surefoot.UserCommand())
        recorder.add()
    assert len(surefoot.read(file).time) == 1
    with pytest.raises(surefoot.Error, match="this Recorder is closed"):
        recorder.add()


def test_a_recorder_refuses_what_makes_no_log(tmp_path):
    file = str(tmp_path / "robot.mcap")
    controller, recorder = walk(lambda controller: surefoot.Recorder(controller, file), ticks=1)
    with pytest.raises(surefoot.Error, match=r"made no tick since the last add\(\), which comes after step\(\)"):
        recorder.add()
    with pytest.raises(surefoot.Error, match="the controller has made 1 ticks already"):
        surefoot.Recorder(controller, file)
    with pytest.raises(surefoot.Error, match=r"run\(…, record=.run.mcap.\) would be valid"):
        surefoot.run("walk_flat_ideal", set=["duration=0.1"], every_tick=lambda tick: surefoot.Recorder(tick.controller, file))
    fresh = surefoot.Controller("anymal_b")
    with surefoot.Recorder(fresh, str(tmp_path / "first.mcap")), pytest.raises(surefoot.Error, match="another log records"):
        surefoot.Recorder(fresh, str(tmp_path / "second.mcap"))


@pytest.mark.parametrize(("time", "said"), [(-0.5, "the reading's time is -0.5 s; times that grow"), (np.nan, "time is nan s; times"), (0.0, "time is 0 s, and the one before was at 0.0025 s")])
def test_a_recorder_refuses_a_clock_that_no_log_has(time, said, tmp_path):
    plant, controller = surefoot.Plant(surefoot.load_scenario("walk_flat_ideal")), surefoot.Controller("anymal_b")
    with surefoot.Recorder(controller, tmp_path / "run.mcap") as recorder:
        for tick in range(2 if time == 0 else 0):
            plant.write(controller.step(plant.read(), surefoot.UserCommand()))
            recorder.add()
        reading = plant.read()
        reading.time = time
        controller.step(reading, surefoot.UserCommand())
        with pytest.raises(surefoot.Error, match=said):
            recorder.add()


def test_a_recorder_warns_of_ticks_that_it_was_not_given(tmp_path):
    plant, controller = surefoot.Plant(surefoot.load_scenario("walk_flat_ideal")), surefoot.Controller("anymal_b")
    with surefoot.Recorder(controller, tmp_path / "run.mcap") as recorder:
        for _ in range(2):
            plant.write(controller.step(plant.read(), surefoot.UserCommand()))
        with pytest.warns(RuntimeWarning, match="^1 tick is not in the log, and what comes behind can't be computed again"):
            recorder.add()
        controller.step(plant.read(), surefoot.UserCommand())
        recorder.add()
        assert repr(recorder).startswith("<recorder of /") and repr(recorder).endswith("run.mcap>")


def test_a_log_without_ticks_says_so(tmp_path):
    with surefoot.Recorder(surefoot.Controller("anymal_b"), tmp_path / "run.mcap"):
        pass
    log = surefoot.read(tmp_path / "run.mcap")
    assert ", 0 channels: " in repr(log)
    with pytest.raises(surefoot.Error, match="the log holds no tick"):
        log.time


def test_another_stack_is_asked_at_each_tick_of_a_log(tmp_path):
    log = surefoot.run("walk_flat_ideal", set=["duration=1"], record=tmp_path / "run.mcap").log
    found = surefoot.read(log).compare("crouch_first")
    assert found["ticks"] == 400 and {level["name"] for level in found["levels"]} > {"torso_height", "torso_yaw"}
    with pytest.raises(surefoot.Error, match="no_such"):
        surefoot.read(log).compare("no_such")


class Still(surefoot.OwnTask):
    """Brakes the base, more with a larger gain."""

    max_rows, unit, gain = 3, "m/s²", 20

    def rows(self, tick):
        base = tick.dynamics.base
        return base.J[:3], -self.gain * base.v[:3] - base.Jdot_u[:3]


class Braking(Still):
    gain = 40


class Asking(surefoot.Planner):
    def update(self, user, state, dynamics, last):
        return super().update(user, state, dynamics, last)


BRAKED = surefoot.Stack("terrain_adaptation").replace("torso_height", Still("still"))


@pytest.fixture(scope="module")
def braked(tmp_path_factory):
    """The log of a run with a task of one's own."""
    file = tmp_path_factory.mktemp("own") / "run.mcap"
    surefoot.run("walk_flat_ideal", set=["duration=1"], stack=BRAKED, record=file)
    return surefoot.read(file)


def test_a_run_with_a_task_of_ones_own_is_computed_again_with_it(braked, monkeypatch):
    with pytest.raises(surefoot.Error, match=r"the run's task still is the user's own and was not given, .*: in Python own_tasks=\[…\]"):
        braked.verify()
    assert braked.verify(own_tasks=[Still("still")])["same"] is True
    assert braked.verify(own_tasks=[Braking("still")])["same"] is False
    monkeypatch.setattr("surefoot.task._registered", {"still": Still("still")})
    assert braked.verify()["same"] is True
    assert braked.verify(own_tasks=[Braking("still")])["same"] is False, "what is given goes before what is registered"


def test_a_stack_is_asked_at_each_tick_of_a_log_with_its_own_tasks(braked):
    same = braked.compare(BRAKED)
    assert same["other"] == "terrain_adaptation" and same["not_reproduced"]["ticks"] == 0
    assert {each["largest"] for each in same["torque_difference"].values()} == {0.0}
    stiffer = braked.compare(BRAKED.tune("com_xy", kp=400))
    assert stiffer["torque_difference"]["LF_KFE"]["rms"] > 1e-4
    by_name = braked.compare("terrain_adaptation", own_tasks=[Still("still")])
    assert {"still"} == {each["name"] for each in by_name["levels"] if "other" not in each}
    both = braked.compare(BRAKED.replace("still", Braking("still")), own_tasks=[Still("still")])
    assert both["not_reproduced"]["ticks"] == 0 and both["torque_difference"]["LF_KFE"]["rms"] > 1e-6
    with pytest.raises(surefoot.Error, match='^the stack "own" has no equations_of_motion'):
        braked.compare(surefoot.Stack().last(*BRAKED.own_tasks))


def test_a_stack_that_is_compared_has_the_numbers_of_the_runs_robot(tmp_path):
    file = tmp_path / "run.mcap"
    surefoot.run("walk_flat_ideal", robot="hyq", set=["duration=0.2"], record=file)
    found = surefoot.read(file).compare(surefoot.Stack("walk"))
    assert found["other"] == "walk"
    assert {each["largest"] for each in found["torque_difference"].values()} == {0.0}


def test_what_is_tuned_of_a_stack_goes_before_what_the_run_tuned(tmp_path):
    file = tmp_path / "run.mcap"
    surefoot.run("walk_flat_ideal", stack="terrain_adaptation", set=["duration=1", "tasks.com_xy.kp=300"], record=file)
    stack = surefoot.Stack("terrain_adaptation")
    largest = [
        max(abs(each["largest"]) for each in surefoot.read(file).compare(other)["torque_difference"].values())
        for other in (stack, stack.tune("com_xy", kp=111))
    ]
    assert largest[0] == 0.0 and largest[1] > 1e-6


def test_exact_costs_of_a_run_with_a_task_of_ones_own_need_it(braked):
    assert "own_tasks" in surefoot.explain(braked, 0.5).facts["why_estimates"]
    assert not surefoot.explain(braked, 0.5, own_tasks=[Still("still")]).facts.get("why_estimates")


def test_a_stack_with_a_task_of_ones_own_that_a_run_changed_to_is_needed_too(tmp_path):
    def change(tick):
        if tick.time == 0.5:
            tick.controller.set_stack(surefoot.Stack("terrain_adaptation").replace("torso_height", surefoot.StackLevel("torso_height", (Still("still"),))), 0.1)

    file = tmp_path / "run.mcap"
    surefoot.run("walk_flat_ideal", stack="terrain_adaptation", set=["duration=1"], every_tick=change, record=file)
    with pytest.raises(surefoot.Error, match='from 0.5000 s on the run has a stack that can.t be read: .*unknown task "still".*own_tasks='):
        surefoot.read(file).verify()
    assert surefoot.read(file).verify(own_tasks=[Still("still")])["same"] is True


def test_a_planner_of_ones_own_plans_again_where_it_is_given(tmp_path):
    scenario = surefoot.load_scenario("walk_flat_ideal", set=["duration=0.5"])
    file = tmp_path / "run.mcap"
    surefoot.run(scenario, planner=Asking(scenario), record=file)
    assert surefoot.read(file).verify()["played_back"] == ["planner"]
    again = surefoot.read(file).verify(planner=Asking(scenario))
    assert again["same"] is True and "played_back" not in again


class Failing(Still):
    def rows(self, tick):
        raise ValueError("no idea")


class Failed(surefoot.Planner):
    def update(self, user, state, dynamics, last):
        raise ValueError("no idea")


def test_what_a_part_of_ones_own_does_wrong_as_it_is_computed_again_is_told(braked, tmp_path):
    with pytest.warns(RuntimeWarning, match='^as the run is computed again, task "still" threw: ValueError: no idea'):
        found = braked.verify(own_tasks=[Failing("still")])
    assert found["same"] is False and "no idea" in found["fault"]
    failing = BRAKED.before("torso_yaw", Failing("failing"))
    assert 'task "failing" threw: ValueError: no idea' in braked.compare(failing)["unanswered"]["other"]["why"]
    assert "computed again, task \"still\" threw" in surefoot.explain(braked, 0.5, own_tasks=[Failing("still")]).facts["why_estimates"]
    assert "with other parts of the user's own" in surefoot.explain(braked, 0.9, own_tasks=[Braking("still")]).facts["why_estimates"]
    scenario = surefoot.load_scenario("walk_flat_ideal", set=["duration=0.1"])
    surefoot.run(scenario, planner=Asking(scenario), record=tmp_path / "run.mcap")
    with pytest.warns(RuntimeWarning, match="computed again, .*no idea"):
        surefoot.read(tmp_path / "run.mcap").verify(planner=Failed())


class Interrupted(Still):
    calls = 0

    def rows(self, tick):
        self.calls += 1
        if self.calls == 50:
            signal.raise_signal(signal.SIGINT)
        return super().rows(tick)


@pytest.mark.parametrize(
    "computed",
    [
        lambda log, own: log.verify(own_tasks=own),
        lambda log, own: log.compare("walk", own_tasks=own),
        lambda log, own: surefoot.explain(log, 0.9, own_tasks=own),
    ],
)
def test_ctrl_c_ends_what_is_computed_again(computed, braked):
    task = Interrupted("still")
    with pytest.raises(KeyboardInterrupt):
        computed(braked, [task])
    assert task.calls < 100


class Height(surefoot.OwnTask):
    """Holds the base's height, or does something amiss."""

    max_rows = 1

    def rows(self, tick):
        if self.wrong == "raises":
            raise RuntimeError("lost")
        self.calls = getattr(self, "calls", 0) + 1
        return tick.dynamics.base.J[2:3], [float(self.calls) if self.wrong == "differs" else 0.0]


@pytest.mark.parametrize(("wrong", "said"), [(None, None), ("raises", 'task "height": rows() raised: RuntimeError: lost'), ("differs", "other rows for the same input")])
def test_a_task_of_ones_own_is_tried_in_many_states(wrong, said):
    task = Height("height")
    task.wrong = wrong
    found = surefoot.check_task(task, "anymal_b")
    assert (not found) if said is None else any(said in each for each in found), found
