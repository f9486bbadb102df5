"""Ctrl-C and sys.exit() in a run, within a part of the user's own and without one."""

import os
import signal
import sys
import threading

import numpy as np
import pytest

import surefoot
from surefoot import OwnTask, Stack


def press_ctrl_c():
    os.kill(os.getpid(), signal.SIGINT)
    for _ in range(1000):  # the handler is called between two lines
        pass


ENDINGS = {"ctrl-c": (press_ctrl_c, KeyboardInterrupt), "exit": (lambda: sys.exit(3), SystemExit)}
PARTS = ["task", "planner", "estimator", "every_tick"]
BEGIN = 0.05  # s


class Height(OwnTask):
    max_rows, unit, end = 1, "m/s²", None

    def rows(self, tick):
        if self.end and tick.plan.time >= BEGIN:
            self.end()
        return tick.dynamics.base.J[2:3], [0]


def parts_that_end(part, end):
    """A scenario, and what run() and Controller() take with it."""

    class Planner(surefoot.Planner):
        def update(self, user, state, dynamics, last):
            if state.time >= BEGIN:
                end()
            return super().update(user, state, dynamics, last)

    class Estimator(surefoot.Estimator):
        def update(self, reading, context):
            if reading.time >= BEGIN:
                end()
            return super().update(reading, context)

    task = Height("height")
    task.end = end if part == "task" else None
    stack = Stack("terrain_adaptation").last(task)
    scenario = surefoot.load_scenario("walk_flat", stack=stack, set=["duration=5", "user=[{time: 0}]"])
    return scenario, {"planner": {"planner": Planner(scenario)}, "estimator": {"estimator": Estimator(scenario)}}.get(part, {})


@pytest.mark.parametrize("part", PARTS)
@pytest.mark.parametrize("end, raised", ENDINGS.values(), ids=ENDINGS)
def test_what_ends_a_program_ends_a_run_from_within_any_part(part, end, raised):
    scenario, own = parts_that_end(part, end)
    if part == "every_tick":
        own = {"every_tick": lambda tick: end() if tick.time >= BEGIN else None}
    times = []
    with pytest.raises(raised):
        surefoot.run(scenario, **({"every_tick": lambda tick: times.append(tick.time)} | own))
    assert part == "every_tick" or BEGIN <= times[-1] < BEGIN + 0.01


@pytest.mark.parametrize("part", PARTS[:-1])
@pytest.mark.parametrize("end, raised", ENDINGS.values(), ids=ENDINGS)
def test_in_a_loop_by_hand_step_raises_it_and_goes_on_when_called_again(part, end, raised):
    ending = [end]
    scenario, own = parts_that_end(part, lambda: ending.pop()() if ending else None)
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant, **own)
    with pytest.raises(raised):
        while plant.time < 1:
            plant.write(controller.step(plant.read(), scenario.user(plant.time)))
    assert plant.time == pytest.approx(BEGIN) and np.isfinite(controller.command.torque).all()
    while plant.time < 0.2:
        plant.write(controller.step(plant.read(), scenario.user(plant.time)))
    assert controller.command.mode == "optimal"


def test_ctrl_c_ends_a_run_without_any_part_in_python():
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        surefoot.run("walk_flat", set=["duration=1000"])
    timer.join()
