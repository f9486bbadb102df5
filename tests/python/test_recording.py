"""Logs of loops without a plant, logs that are computed again, and tasks that are tried."""

import numpy as np
import pytest

import surefoot


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
    assert "truth" not in log.topics and "alignment" not in log.topics
    assert [each["text"] for each in log.events if each["text"].startswith("friction")] == ["friction 0.4, by the operator"]
    assert "friction_cone" in surefoot.explain(file, 0.2).text
    found = log.verify()
    assert found["same"] and found["ticks"] == 100
    with pytest.raises(KeyError, match="has no metrics, .* or of one without a plant"):
        log.metrics
    with pytest.raises(KeyError, match="has no /alignment: it was recorded without a plant"):
        log.aligned_error("com")
    with pytest.raises(surefoot.Error, match="has no attachment model.xml, which this needs; a log that is recorded with a plant would be valid"):
        log.picture(0.1)


def test_a_recorder_is_closed_by_its_block(tmp_path):
    file = tmp_path / "robot.mcap"
    controller = surefoot.Controller("anymal_b")
    with surefoot.Recorder(controller, str(file)) as recorder:
        controller.step(surefoot.SensorReading(12), surefoot.UserCommand())
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


def test_another_stack_is_asked_at_each_tick_of_a_log(tmp_path):
    log = surefoot.run("walk_flat_ideal", set=["duration=1"], record=tmp_path / "run.mcap").log
    found = surefoot.read(log).compare("crouch_first")
    assert found["ticks"] == 400 and {level["name"] for level in found["levels"]} > {"torso_height", "torso_yaw"}
    with pytest.raises(surefoot.Error, match="no_such"):
        surefoot.read(log).compare("no_such")


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
