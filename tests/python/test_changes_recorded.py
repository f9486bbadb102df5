"""What is changed while a run is recorded from Python is in its log, and the log can be replayed."""

import pytest

import surefoot
from log_file import messages
from program import of_json
from surefoot import Stack

STACK = Stack("terrain_adaptation").tune("com_xy", kp=300)
SHORT = ["duration=2", "stack=terrain_adaptation"]


def change(time, plant, controller):
    """What may be changed before a tick."""
    tick = round(time / 0.0025)
    if tick == 0:
        plant.push([30, 0, 0], time=1.5)
    if tick == 160:
        controller.set_friction(0.3)
    if tick == 200:
        plant.push([0, 60, 0])
        assert controller.set_stack_text(STACK.text(), STACK.name, 0.3)
    if tick == 400:
        assert controller.switch_levels(remove=["torso_height"])
    if tick == 500:
        plant.fail("imu", "late", size=2, duration=0.1)


def by_run(scenario, log):
    surefoot.run(scenario, record=log, every_tick=lambda tick: change(tick.time, tick.plant, tick.controller))


def by_loop(scenario, log):
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    evaluator = surefoot.Evaluator(scenario, plant, controller, str(log))
    while plant.time < scenario.duration - 1e-9:
        change(plant.time, plant, controller)
        command = controller.step(plant.read(), scenario.user(plant.time))
        if abs(plant.time - 0.6) < 1e-9:
            controller.set_friction(0.4)  # holds from the next tick on
        evaluator.add()
        plant.write(command)
        if plant.time > 1.2:
            controller.set_friction(0.5)
    evaluator.close()


@pytest.mark.parametrize("record", [by_run, by_loop])
@pytest.mark.parametrize("name", ["walk_flat", "walk_flat_ideal"])
def test_a_log_of_changes_is_replayed_to_the_bit(record, name, tmp_path):
    log = tmp_path / "run.mcap"
    record(surefoot.load_scenario(name, set=SHORT), log)
    found = of_json("replay", log, "--verify")
    assert found["same"] and found["ticks"] == 800, found
    changes = messages(log, "/changes")
    assert {each["kind"] for each in changes} == {"push", "stack", "friction", "levels", "fault"}
    assert [each["time"] for each in changes if each["kind"] == "push"] == [0.5, 1.5]
    assert [each["text"] for each in changes if each["kind"] == "fault"] == ["sensor fault: imu late (2), for 0.1 s"]


def test_of_a_push_from_python_the_log_says_whose_it_is(tmp_path):
    log = tmp_path / "run.mcap"
    by_run(surefoot.load_scenario("walk_flat_ideal", set=SHORT), log)
    assert "the operator pushes base with 6 N·s to the left" in surefoot.explain(log, 0.5).text


def test_a_log_that_would_begin_too_late_is_refused(tmp_path):
    scenario = surefoot.load_scenario("walk_flat_ideal")
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    first = surefoot.Evaluator(scenario, plant, controller, str(tmp_path / "a.mcap"))
    with pytest.raises(surefoot.Error, match=r"another log records .*; close\(\) it first"):
        surefoot.Evaluator(scenario, plant, controller, str(tmp_path / "b.mcap"))
    controller.step(plant.read(), scenario.user(0))
    first.add()
    first.close()
    with pytest.raises(surefoot.Error, match=r"has made 1 ticks already, .* made before step\(\) would be valid"):
        surefoot.Evaluator(scenario, plant, controller, str(tmp_path / "c.mcap"))


def test_an_evaluator_knows_that_the_controller_stopped():
    class Bad(surefoot.OwnTask):
        max_rows = 1

        def rows(self, tick):
            return 1 / 0 if tick.plan.time > 0.2 else None

    scenario = surefoot.load_scenario("walk_flat_ideal", stack=Stack("terrain_adaptation").last(Bad("bad")), set=["duration=1", "criteria=none"])
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    evaluator = surefoot.Evaluator(scenario, plant, controller)
    with pytest.warns(RuntimeWarning):
        while plant.time < 1:
            command = controller.step(plant.read(), scenario.user(plant.time))
            evaluator.add()
            plant.write(command)
            assert evaluator.succeeded is not False or plant.time > 0.2
    assert evaluator.succeeded is False and evaluator.metrics["succeeded"] is False
    assert evaluator.reason.startswith("the controller stopped for safety at 0.") and '"bad"' in evaluator.reason
