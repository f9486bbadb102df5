"""Several threads at one controller and plant."""

import contextlib
import subprocess
import sys
import threading
import time
from types import SimpleNamespace

import pytest

import surefoot


@pytest.fixture
def scenario():
    return surefoot.load_scenario("walk_flat_ideal", set=["duration=2"])


def test_one_thread_at_a_time_steps_a_controller():
    class Steps(surefoot.Planner):
        def update(self, user, state, dynamics, last):
            controller.step(plant.read(), user)

    scenario = surefoot.load_scenario("walk_flat_ideal")
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant, planner=Steps())
    with pytest.warns(RuntimeWarning, match="this controller is busy"):
        controller.step(plant.read(), scenario.user(0))


class Late(surefoot.OwnTask):
    """Has no rows; each tick it calls something first."""

    max_rows = 1

    def rows(self, tick):
        self.call()
        return tick.dynamics.base.J[:0], []


@pytest.fixture
def late():
    """A loop whose own task calls something in the middle of each tick."""
    task = Late("late")
    stack = surefoot.Stack("terrain_adaptation").last(task)
    scenario = surefoot.load_scenario("walk_flat_ideal", stack=stack)
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    return SimpleNamespace(scenario=scenario, stack=stack, plant=plant, controller=controller, task=task)


def test_a_change_in_the_middle_of_a_tick_is_refused(late):
    changes = [lambda: late.controller.set_stack("terrain_adaptation"), lambda: late.controller.set_friction(0.5), late.controller.levels,
               lambda: late.controller.switch_levels(remove=["torso_yaw"]), lambda: late.controller.explain_levels()]  # fmt: skip
    refused = []

    def try_all():
        for change in changes:
            with pytest.raises(surefoot.Error, match="this controller is busy with the call that called this; between two ticks would be valid"):
                change()
            refused.append(change)

    late.task.call = try_all
    late.controller.step(late.plant.read(), late.scenario.user(0))
    assert refused == changes and not late.controller.fault


def test_other_threads_wait_for_the_end_of_a_tick(late):
    done, ends = [], []
    calls = [late.controller.levels, lambda: late.controller.set_friction(0.5), lambda: late.controller.set_stack(late.stack), lambda: late.controller.state]
    begun = threading.Barrier(len(calls) + 1)

    def begin():
        begun.wait()
        for _ in range(200):
            time.sleep(0)  # lets the others on
        ends.append(len(done))

    def other(call):
        begun.wait()
        call()
        done.append(call)

    late.task.call = begin
    threads = [threading.Thread(target=other, args=[call]) for call in calls]
    for thread in threads:
        thread.start()
    late.controller.step(late.plant.read(), late.scenario.user(0))
    for thread in threads:
        thread.join()
    assert ends == [0] and sorted(map(id, done)) == sorted(map(id, calls)) and not late.controller.fault


def test_another_threads_looks_and_changes_do_not_stop_a_loop(scenario):
    """Nor does the loop, which leaves the controller alone for moments only, keep them waiting."""
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    looks, ended, failed = [0], threading.Event(), []

    def look():
        try:
            while not ended.is_set():
                assert len(controller.levels()) in (0, 6) and controller.plan.com and plant.truth.feet
                controller.set_friction(0.5 + 0.01 * (looks[0] % 10))
                plant.push([1, 0, 0])
                looks[0] += 1
        except Exception as error:
            failed.append(error)

    thread = threading.Thread(target=look)
    thread.start()  # before the first tick, which has no levels
    for _ in range(400):
        plant.write(controller.step(plant.read(), scenario.user(plant.time)))
    ended.set()
    thread.join()
    assert not failed and looks[0] > 20


def test_what_a_run_lends_waits_for_its_ticks_too(scenario):
    lent, found, failed = [], [], []
    begun = threading.Event()

    def look():
        begun.wait()
        try:
            while True:
                found.append(len(lent[0].controller.levels()))
        except surefoot.Error as error:
            failed.append(str(error))

    def tick(now):
        lent[:] = [now]
        if now.time > 0:
            begun.set()
        if now.time > 1.0:
            now.stop()

    thread = threading.Thread(target=look)
    thread.start()
    surefoot.run(scenario, every_tick=tick)
    thread.join()
    assert set(found) == {6} and "the run of this controller has ended" in failed[0]


def test_a_loop_without_a_plant_lets_changes_in(scenario):
    """It keeps the interpreter's lock between its ticks for some microseconds only."""
    controller, stack, failed, changes = surefoot.Controller("anymal_b"), surefoot.Stack("walk"), [], []
    plant, user = surefoot.Plant(surefoot.load_scenario("walk_flat")), surefoot.UserCommand()

    def change():
        try:
            while changes.count(True) < 10:  # False: the stack before is not there yet
                changes.append(controller.set_stack(stack, duration=0.001))
        except surefoot.Error as error:
            failed.append(str(error))

    thread = threading.Thread(target=change)
    thread.start()
    while thread.is_alive():
        plant.write(controller.step(plant.read(), user))
    assert not failed and changes.count(True) == 10


def test_a_log_has_another_threads_change_at_the_tick_that_has_it(scenario, tmp_path):
    """A change that waits comes between the callback and its tick."""
    lent, changes = [], []

    def change():
        with contextlib.suppress(surefoot.Error):  # the run has ended
            while True:
                lent[0].controller.set_friction(0.4 + 0.01 * (len(changes) % 20))
                changes.append(lent[0].time)

    thread = threading.Thread(target=change)

    def tick(now):
        if not lent:
            lent.append(now)
            thread.start()

    surefoot.run(scenario, every_tick=tick, record=tmp_path / "run.mcap")
    thread.join()
    assert len(changes) > 20
    assert surefoot.read(tmp_path / "run.mcap").verify()["same"] is True


def test_a_tick_without_a_solution_has_no_problem(late):
    def fail():
        raise ValueError("lost")

    late.task.call = fail
    with pytest.warns(RuntimeWarning, match="lost"):
        late.controller.step(late.plant.read(), late.scenario.user(0))
    with pytest.raises(surefoot.Error, match="no hierarchy was solved at the last tick"):
        late.controller.problem


def test_levels_after_a_tick_are_of_its_stack_though_the_clock_stands_still(late):
    late.task.call = lambda: None
    reading = late.plant.read()
    late.controller.step(reading, late.scenario.user(0))
    assert late.controller.set_stack(surefoot.Stack("terrain_adaptation").without("com_xy").last(surefoot.tasks.ComXy()).last(late.task), 0.0001)
    late.controller.step(reading, late.scenario.user(0))
    assert [level.name for level in late.controller.levels()] == late.controller.level_names


def test_right_after_a_change_of_stack_the_levels_are_still_those_of_the_last_tick(late, tmp_path):
    late.task.call = lambda: None
    evaluator = surefoot.Evaluator(late.scenario, late.plant, late.controller, tmp_path / "run.mcap")

    def step():
        late.controller.step(late.plant.read(), late.scenario.user(0))
        return [repr(level) for level in late.controller.levels()]

    def end():
        evaluator.add()
        late.plant.write(late.controller.command)

    step()
    end()
    before = step()
    assert late.controller.set_stack(surefoot.Stack("terrain_adaptation").without("com_xy").last(surefoot.tasks.ComXy()).last(late.task))
    assert [repr(level) for level in late.controller.levels()] == before and late.controller.level_names[-2] == "com_xy"
    with pytest.raises(surefoot.Error, match="no hierarchy was solved at the last tick, or another stack has come since"):
        late.controller.problem
    end()
    after = step()
    end()
    assert {level.name: level.num_rows for level in late.controller.levels()}["com_xy"] == 2 and late.controller.problem and after != before
    evaluator.close()
    names = [[level["name"] for level in surefoot.explain(tmp_path / "run.mcap", time, exact=False).facts["levels"]] for time in (0.0025, 0.005)]
    assert names[0].index("com_xy") < names[1].index("com_xy") == len(names[1]) - 2, "the log has each tick with the names of its own stack"


DAEMONS = {
    "a loop": "plant.write(controller.step(plant.read(), user))",
    "a loop with an estimator of its own": "plant.write(own.step(plant.read(), user))",
    "runs": "surefoot.run('walk_flat_ideal', set=['duration=1'])",
    "runs with a callback": "surefoot.run('walk_flat_ideal', set=['duration=1'], every_tick=lambda tick: None)",
    "solves": "surefoot.solve([{'A': [[1, 1]], 'b': [1]}])",
}


@pytest.mark.parametrize("what", DAEMONS)
def test_a_program_ends_as_it_wants_while_a_daemon_thread_is_in_the_library(what):
    """Where Python ends a thread that asks for its lock too late."""
    script = f"""
import sys, threading, surefoot
class Looks(surefoot.Estimator):
    def update(self, reading, context):
        return super().update(reading, context)
scenario = surefoot.load_scenario("walk_flat")
plant, user, begun = surefoot.Plant(scenario), surefoot.UserCommand(), threading.Event()
controller, own = surefoot.Controller(scenario), surefoot.Controller(scenario, estimator=Looks(scenario))
def loop():
    while True:
        {DAEMONS[what]}
        begun.set()
threading.Thread(target=loop, daemon=True).start()
begun.wait()
sys.exit(3)
"""
    for _ in range(3):
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
        assert (done.returncode, done.stderr) == (3, "")
