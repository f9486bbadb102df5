"""Runs, and controllers without a plant, from Python."""

import json
import multiprocessing
import pathlib
import pickle
import threading
from functools import partial

import numpy as np
import pytest

import surefoot
from program import ROOT, run_result


@pytest.fixture
def scenario():
    return surefoot.load_scenario("walk_flat_ideal", set=["duration=2"])


def by_hand(scenario, controller, plant, evaluator=None):
    while plant.time < scenario.duration - 1e-9:
        command = controller.step(plant.read(), scenario.user(plant.time))
        if evaluator is not None:
            evaluator.add()
        plant.write(command)


def hash_of(scenario):
    return surefoot.run(scenario).torques_hash


def test_a_scenario_can_be_sent_to_another_process(tmp_path, monkeypatch):
    file = tmp_path / "mine.yaml"
    file.write_text("base: walk_flat_ideal\nduration: 0.3\n")
    monkeypatch.chdir(tmp_path)
    stack = surefoot.Stack("terrain_adaptation").tune("com_xy", kp=77)
    scenarios = [
        surefoot.load_scenario("walk_flat_mismatch", seed=7, set=["duration=0.3"], stack="regular"), surefoot.load_scenario("mine.yaml"),
        surefoot.load_scenario("walk_flat_ideal", set=["duration=0.3"], robot="hexapod"),
        surefoot.load_scenario("walk_flat_ideal", set=["duration=0.3"], robot=surefoot.Robot("go2"), stack=stack),
    ]  # fmt: skip
    monkeypatch.chdir("/")
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.map(hash_of, scenarios) == [hash_of(each) for each in scenarios]
    again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(scenarios[0]))))
    assert repr(again) == repr(scenarios[0]) and again.options_json == scenarios[0].options_json and again.drawn == scenarios[0].drawn != {}


def seen(scenario):
    """What its files say, without their paths."""
    options = json.loads(scenario.options_json)
    stack, robot = options.pop("stack"), options.pop("robot")
    return pathlib.Path(stack).stem, pathlib.Path(robot).stem, scenario.robot, options, hash_of(scenario)


def test_a_scenario_is_read_again_from_the_same_files_wherever_they_were_found(tmp_path, monkeypatch):
    for folder, number in (("here", 77), ("elsewhere", 88)):
        (tmp_path / folder).mkdir()
        monkeypatch.chdir(tmp_path / folder)
        pathlib.Path("mine.yml").write_text(f"base: walk_flat_ideal\nduration: 0.{number}\n")
        pathlib.Path("stack.yml").write_text(surefoot.Stack("terrain_adaptation").tune("com_xy", kp=number).text())
        pathlib.Path("robot.yaml").write_text((ROOT / "robots/anymal_b.yaml").read_text().replace("name: anymal_b", f"name: robot_{number}"))
        pathlib.Path("soft.yaml").write_text((ROOT / "gaits/trot.yaml").read_text().replace("wait: 0.15", f"wait: 0.{number}"))
    monkeypatch.chdir(tmp_path / "here")
    made = partial(surefoot.load_scenario, "walk_flat_ideal")
    short = ["duration=0.1"]
    given = [
        surefoot.load_scenario("walk_flat_ideal.yaml", set=short), surefoot.load_scenario("mine.yml"), made(set=short, stack="stack.yml"),
        made(set=short, stack=surefoot.Stack("stack.yml")), made(set=[*short, "stack=./stack.yml", "robot=robot.yaml"]),
        made(set=[*short, "gaits=[ soft.yaml, trot]"]), made(set=short, robot="robot.yaml"), made(set=short, robot=made().robot_model),
    ]  # fmt: skip
    before, sent = [seen(each) for each in given], pickle.dumps(given)
    monkeypatch.chdir(tmp_path / "elsewhere")
    assert [seen(each) for each in pickle.loads(sent)] == before
    with pytest.raises(surefoot.Error, match=r"only scenarios of load_scenario\(\) can be pickled"):
        pickle.dumps(surefoot._core.read_scenario("walk_flat"))


def test_a_run_is_that_of_the_program_to_the_bit(scenario):
    ours, theirs = surefoot.run(scenario), run_result("walk_flat_ideal", "--set", "duration=2")
    assert format(ours.torques_hash, "016x") == theirs["torques_hash"]
    assert ours["com_error_max_m"] == theirs["com_error_max_m"] and ours.reason == theirs["reason"]
    assert [each.metric for each in ours.criteria] == [each["metric"] for each in theirs["criteria"]]
    assert repr(ours).startswith("<run of walk_flat_ideal, ")
    with pytest.raises(KeyError, match="com_error"):
        ours["com_error"]


@pytest.mark.parametrize("changes", [["duration=0.5"], ["duration=3", "criteria={steps_taken: {min: 900}}"]])
def test_the_result_of_a_run_comes_back_from_another_process(changes):
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        [sent] = pool.map(partial(surefoot.run, set=changes, seed=3), ["walk_flat"])
    here = surefoot.run("walk_flat", set=changes, seed=3)
    by_clock = {"tick_us", "solve_us", "realtime_factor"}
    assert [*sent.metrics] == [*here.metrics]
    assert all(str(sent[name]) == str(value) for name, value in here.metrics.items() if name not in by_clock)
    for name in ("succeeded", "reason", "fault", "events", "notes", "torques_hash", "log"):
        assert getattr(sent, name) == getattr(here, name), name
    assert str(sent.criteria) == str(here.criteria) and len(sent.criteria) > 0 and repr(sent) == repr(here)


def test_a_robot_is_sent_by_its_file_and_what_can_not_be_sent_is_told_with_what_can(scenario, tmp_path, monkeypatch):
    urdf = pathlib.Path(surefoot.Robot("anymal_b").urdf)
    monkeypatch.chdir(urdf.parent)
    sent = [pickle.dumps(surefoot.Robot(name)) for name in ("go1", urdf.name)]
    monkeypatch.chdir(tmp_path)
    assert [pickle.loads(each).joint_names[0] for each in sent] == [surefoot.Robot(name).joint_names[0] for name in ("go1", str(urdf))]
    with pytest.raises(TypeError, match=r"only a Robot\(name_or_path\) can be pickled; of a scenario, pickle that"):
        pickle.dumps(scenario.robot_model)
    with pytest.raises(TypeError, match="a Solution can't be pickled; its x"):
        pickle.dumps(surefoot.solve([{"A": [[1.0]], "b": [1.0]}]))


def test_a_log_overwrites_no_file_of_another_kind(scenario, tmp_path):
    script = tmp_path / "script.py"
    script.write_text("precious")
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    for record in (lambda: surefoot.run(scenario, record=script), lambda: surefoot.Evaluator(scenario, plant, controller, str(script))):
        with pytest.raises(surefoot.Error, match=r"script.py: logs are written as MCAP; a name that ends with .mcap would be valid"):
            record()
    for nameless in (lambda: surefoot.run(scenario, record=""), lambda: surefoot.Evaluator(scenario, plant, controller, "")):
        with pytest.raises(surefoot.Error, match=r"is an empty text; .*run.mcap,? would be valid"):
            nameless()
    assert script.read_text() == "precious" and [*tmp_path.iterdir()] == [script]


def test_other_threads_go_on_while_a_run_runs(scenario):
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    surefoot.run(scenario)
    after = counted[0]
    done.set()
    thread.join()
    assert after - before > 1000


def test_between_ticks_a_run_is_pushed_commanded_and_stopped(scenario, tmp_path):
    times, sways = [], []

    def tick(now):
        times.append(now.time)
        now.user = surefoot.UserCommand()
        if now.time == 0:
            now.plant.push([0, 80, 0], duration=0.2)
        if now.time > 1 - 1e-9:
            now.stop()
        sways.append(now.plant.truth.v_SB[1])

    result = surefoot.run(scenario, every_tick=tick, record=tmp_path / "run.mcap")
    assert len(times) == 401 and max(sways) > 0.05 and result["steps_taken"] == 0
    assert result.log and not (tmp_path / "run.mcap").exists(), "a run that was cut off keeps .partial"
    with pytest.raises(ZeroDivisionError):
        surefoot.run(scenario, every_tick=lambda now: 1 / 0)


def test_a_loop_by_hand_is_judged_and_recorded_as_a_run(scenario, tmp_path):
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    evaluator = surefoot.Evaluator(scenario, plant, controller, str(tmp_path / "run.mcap"))
    with pytest.raises(surefoot.Error, match="after step"):
        evaluator.add()
    by_hand(scenario, controller, plant, evaluator)
    evaluator.close()
    whole = surefoot.run(scenario)
    for metric in ("com_error_max_m", "steps_taken", "torque_max_nm"):
        assert evaluator.metrics[metric] == whole[metric]
    assert [each.passed for each in evaluator.criteria] == [each.passed for each in whole.criteria]
    assert len(surefoot.read(tmp_path / "run.mcap").time) == 800


def test_without_a_plant_a_controller_of_a_robot_steps_on_readings_from_anywhere():
    scenario = surefoot.load_scenario("walk_flat", set=["duration=1"])
    plant, body = surefoot.Plant(scenario), surefoot.Controller("anymal_b")
    together = surefoot.Controller(scenario, plant)
    for _ in range(100):
        reading, user = plant.read(), scenario.user(plant.time)
        torque = body.step(reading, user).torque
        np.testing.assert_array_equal(torque, together.step(reading, user).torque)
        plant.write(torque)
    assert repr(body) == "<controller of anymal_b, 6 levels, after 0 footsteps>"
    with pytest.raises(surefoot.Error, match="estimation: truth, which needs the plant"):
        surefoot.Controller(surefoot.load_scenario("walk_flat_ideal"))
    with pytest.raises(surefoot.Error, match="give them to load_scenario"):
        surefoot.Controller(scenario, set=["duration=2"])
    with pytest.raises(surefoot.Error, match="set is the text 'duration=2'; a list of texts"):
        surefoot.load_scenario("walk_flat", set="duration=2")


def test_sensors_fail_on_demand(scenario):
    plant = surefoot.Plant(scenario)
    plant.write(np.zeros(12))
    right = plant.read().q[5]
    plant.fail("encoders", "jump", size=0.1, element="RF_KFE", duration=0.004)
    plant.write(np.zeros(12))
    assert plant.read().q[5] - plant.truth.q[5] == pytest.approx(0.1, abs=0.01) and abs(right - plant.truth.q[5]) < 0.05
    plant.write(np.zeros(12))
    plant.write(np.zeros(12))
    assert plant.read().q[5] == pytest.approx(plant.truth.q[5], abs=0.02)
    plant.fail("imu", "late", size=3)
    stamps = []
    for _ in range(6):
        plant.write(np.zeros(12))
        stamps.append(plant.read().time - plant.read().imu_time)
    assert stamps[-1] - stamps[0] >= 0 and stamps[-1] >= 3 * 0.0025 - 1e-9
    for arguments, said in [(("imus",), 'sensor is "imus"; did you mean "imu"?'), (("imu", "breaks"), 'kind is "breaks"'),
                            (("imu", "late", 1.0, 0.5), "a whole number of ticks"), (("foot_force",), "the robot has none"),
                            (("imu", "stops", 1.0, 0.0, "LF_KFE"), "element is LF_KFE, and imu has none; those of encoders,")]:  # fmt: skip
        with pytest.raises(surefoot.Error, match=said):
            plant.fail(*arguments)


def test_pushes_that_make_no_sense_are_refused(scenario):
    plant = surefoot.Plant(scenario)
    with pytest.raises(surefoot.Error, match=r"force\[2\] is nan"):
        plant.push([0, 0, float("nan")])
    with pytest.raises(surefoot.Error, match="duration is -1"):
        plant.push([0, 0, 1], duration=-1)
    with pytest.raises(surefoot.UnknownNameError, match='"nobody"; the robot has: base'):
        plant.push([0, 0, 1], body="nobody")
    while plant.time < 0.0249:
        plant.write([0.0] * 12)
    for time in (0.0, -3.0):
        with pytest.raises(surefoot.Error, match=f"time is {time:g} s, and the plant is at 0.025 s; a time from then on would be valid"):
            plant.push([0, 0, 1], time=time, duration=0.01)
    plant.push([0, 0, 1], time=plant.time)
    assert "LF_SHANK" in plant.bodies


def test_paths_are_taken_wherever_names_are(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    robot, stack, scenario = ROOT / "robots/solo12.yaml", ROOT / "stacks/terrain_adaptation.yaml", ROOT / "scenarios/walk_flat_ideal.yaml"
    short = {"duration": 0.05}
    assert surefoot.Robot(robot).name == surefoot.Controller(robot, stack=stack).scenario.robot == "solo12"
    assert surefoot.load_scenario("walk_flat", robot=robot, stack=stack).robot == surefoot.load_scenario(scenario, robot=robot).robot == "solo12"
    by_name = surefoot.run("walk_flat_ideal", set=short, robot="solo12", stack="terrain_adaptation")
    assert surefoot.run(scenario, set=short, robot=robot, stack=stack).torques_hash == by_name.torques_hash
    urdf = pathlib.Path(surefoot.Robot("solo12").urdf)
    assert surefoot.doctor(urdf).can_walk and surefoot.Robot(urdf).joint_names == surefoot.doctor(str(urdf)).robot.joint_names
    given = surefoot.load_scenario("walk_flat_ideal", set=short, stack=str(stack))
    plant = surefoot.Plant(given)
    controller = surefoot.Controller(given, plant)
    evaluator = surefoot.Evaluator(given, plant, controller, record=pathlib.Path("hand.mcap"))
    assert controller.set_stack(stack, duration=0.01)
    by_hand(given, controller, plant, evaluator)
    evaluator.close()
    assert len(surefoot.read("hand.mcap").time) == 20
    for wrong in (3, b"solo12"):
        with pytest.raises(surefoot.Error, match=f"name_or_path is {wrong!r}; a text would be valid"):
            surefoot.Robot(wrong)
        with pytest.raises(surefoot.Error, match=f"description is {wrong!r}; a text would be valid"):
            surefoot.doctor(wrong)
    with pytest.raises(surefoot.Error, match="robot is 3; a Robot or a text or None would be valid"):
        surefoot.load_scenario("walk_flat", robot=3)


def test_what_is_kept_of_a_tick_says_that_its_run_has_ended():
    kept = []
    surefoot.run("walk_flat_ideal", set=["duration=0.01"], every_tick=lambda tick: kept.append((tick, tick.plant, tick.controller)))
    tick, plant, controller = kept[-1]
    assert all("ended" in repr(each) for each in kept[-1])
    for use in (lambda: tick.time, lambda: tick.plant.truth, lambda: plant.time, lambda: plant.push([0, 1, 0]), lambda: plant.write([0.0] * 12),
                lambda: controller.state, lambda: controller.set_friction(0.5), lambda: tick.controller.levels()):  # fmt: skip
        with pytest.raises(surefoot.Error, match="the run of this (plant|controller) has ended"):
            use()


def test_a_robot_that_only_stands_has_a_controller_of_its_own():
    controller = surefoot.Controller("g1")
    assert controller.step(surefoot.SensorReading(29, 2), surefoot.UserCommand()).torque.shape == (29,)
    plant = surefoot.Plant(surefoot.load_scenario("flat_feet"))
    assert plant.read().foot_force.shape == (2,) and surefoot.Plant(surefoot.load_scenario("walk_flat", robot="hexapod")).read().foot_force.shape == (6,)


def test_what_belongs_to_another_robot_is_refused(scenario):
    other = surefoot.Plant(surefoot.load_scenario("walk_flat", robot="go1"))
    with pytest.raises(surefoot.Error, match="plant is of the robot go1, and the controller of anymal_b"):
        surefoot.Controller(scenario, other)
    controller = surefoot.Controller(scenario, surefoot.Plant(scenario))
    with pytest.raises(surefoot.Error, match=r"reading.q has 18 numbers, and anymal_b has 12 joints; that of SensorReading\(12\) would be valid"):
        controller.step(surefoot.SensorReading(18), surefoot.UserCommand())
    six = surefoot.SensorReading(12, 6)
    six.foot_force[:] = 0.0
    with pytest.raises(surefoot.Error, match=r"reading.foot_force has 6 numbers, and anymal_b has 4 legs; that of SensorReading\(12, 4\) would be valid"):
        controller.step(six, surefoot.UserCommand())


@pytest.mark.parametrize("base, part", [(surefoot.Planner, "planner"), (surefoot.Estimator, "estimator")])
def test_a_part_that_asks_the_librarys_of_another_robot_is_refused(scenario, base, part):
    other = {part: base(surefoot.load_scenario("walk_flat", robot="go1"))}
    for use in (lambda: surefoot.run(scenario, **other), lambda: surefoot.Controller(scenario, surefoot.Plant(scenario), **other)):
        with pytest.raises(surefoot.Error, match=f"{base.__name__} is of the robot go1, and the controller of anymal_b; both of the same scenario"):
            use()


def test_an_evaluator_and_an_aligner_are_of_one_robot_and_from_the_first_tick_on(scenario):
    plant, other = surefoot.Plant(scenario), surefoot.Plant(surefoot.load_scenario("walk_flat_ideal", robot="go1"))
    controller = surefoot.Controller(scenario, plant)
    plant.write(controller.step(plant.read(), scenario.user(0)))
    for call in (lambda: surefoot.Evaluator(scenario, other, controller), lambda: surefoot.Aligner().update(other, controller)):
        with pytest.raises(surefoot.Error, match="plant is of the robot go1, and the controller of anymal_b"):
            call()
    controller.step(plant.read(), scenario.user(0))
    with pytest.raises(surefoot.Error, match="the run is at 0.0025 s already; an Aligner that is updated from the first tick on"):
        surefoot.Aligner().update(plant, controller)


def test_a_loop_by_hand_that_stops_early_is_not_judged():
    scenario = surefoot.load_scenario("walk_flat")
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario)
    evaluator = surefoot.Evaluator(scenario, plant, controller)
    for _ in range(40):
        command = controller.step(plant.read(), scenario.user(plant.time))
        evaluator.add()
        plant.write(command)
    assert evaluator.succeeded is None and {one.passed for one in evaluator.criteria} == {None}


def test_the_hierarchy_of_a_tick_is_solved_again_and_certified(scenario):
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    assert controller.dynamics is None
    with pytest.raises(surefoot.Error, match="no hierarchy was solved at the last tick"):
        controller.problem
    for _ in range(5):
        command = controller.step(plant.read(), scenario.user(plant.time))
        truth = plant.truth
        plant.write(command)
    solution = surefoot.solve(controller.problem, certify=True)
    assert [level.name for level in solution.levels] == controller.level_names and max(level.certificate for level in solution.levels) < 1e-9
    np.testing.assert_allclose(solution.x[-12:], command.torque, atol=1e-6)
    np.testing.assert_allclose(controller.dynamics.com.p[2], truth.p_SCom[2], atol=0.02)


def test_a_plant_of_a_run_is_for_no_second_controller(scenario):
    def second(tick):
        with pytest.raises(surefoot.Error, match=r"that of a run.* a Plant\(scenario\) would be valid"):
            surefoot.Controller(scenario, tick.plant)
        tick.stop()

    surefoot.run(scenario, every_tick=second)


@pytest.mark.parametrize("gait, walked", [("trot", "trot"), ("crawl", "crawl"), (1, "trot")])
def test_a_command_names_its_gait(gait, walked):
    scenario = surefoot.load_scenario("walk_flat", set=["gaits=[crawl, trot]", "duration=16"])
    assert scenario.gaits == ["crawl", "trot"]
    user = surefoot.UserCommand(walk=True, velocity=[0.2, 0], gait=gait)
    assert user.gait == gait
    flights = []

    def tick(now):
        now.user = user if now.time > 10 else now.user
        flights.append(sum(foot.phase == "swing" for foot in now.controller.plan.feet.values()))

    surefoot.run(scenario, every_tick=tick)
    assert max(flights) == {"trot": 2, "crawl": 1}[walked]


def test_gaits_that_are_not_there_are_refused_with_those_that_are():
    with pytest.raises(surefoot.Error, match='there is a gait "crawl" already; give yours another name'):
        surefoot.load_scenario("walk_flat", gaits={"crawl": surefoot.Gait})
    with pytest.raises(surefoot.Error, match='gaits has "sway": 3; a class derived from surefoot.Gait, or a function that makes one'):
        surefoot.load_scenario("walk_flat", gaits={"sway": 3})
    scenario = surefoot.load_scenario("walk_flat_ideal", set=["gaits=[crawl, trot]"])
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    user = surefoot.UserCommand()
    for gait, said in [("trott", 'unknown gait "trott"; did you mean "trot"?.*crawl'), (99, "gait is 99; .*crawl.*trot.*-1"), (-4, "gait is -4")]:
        user.gait = gait
        with pytest.raises(surefoot.Error, match=said):
            controller.step(plant.read(), user)
        with pytest.raises(surefoot.Error, match=said):
            surefoot.run(scenario, every_tick=lambda tick, user=user: setattr(tick, "user", user))
    user.gait = "trot"
    controller.step(plant.read(), user)
    with pytest.raises(surefoot.Error, match=r"one gait alone; with gaits=\[crawl, trot\] it has both"):
        surefoot.Controller("anymal_b").step(plant.read(), user)
    surefoot.Controller("anymal_b", set=["gait=trot", "gaits=[trot]"]).step(plant.read(), user)


def test_what_would_do_nothing_to_a_controller_is_refused_with_the_call_that_does_it(scenario):
    class Own(surefoot.Controller):
        def __init__(self, *given):
            self.label = "own"
            super().__init__(*given)
            self.stack = "of mine"

    controller, own = surefoot.Controller("anymal_b"), Own("anymal_b")
    own.friction = 0.3
    assert (own.label, own.stack, own.scenario.name) == ("own", "of mine", "walk_flat")

    def check(controller):
        for name, said in [("friction", r"set_friction\(\) changes it"), ("stack", r"set_stack\(\) changes it"), ("gait", "set_stack.*change what it does")]:
            with pytest.raises(surefoot.Error, match=f"a Controller has no {name} to set; {said}, and its scenario is given where it is made"):
                setattr(controller, name, "regular")

    check(controller)
    with pytest.raises(AttributeError, match="no scenario to set"):
        controller.scenario = scenario
    surefoot.run(scenario, every_tick=lambda tick: (check(tick.controller), tick.stop()))
    controller.step = lambda *_: "measured"
    assert controller.step(1, 2) == "measured"


def test_a_logged_command_with_nan_keeps_the_gait():
    scenario = surefoot.load_scenario("walk_flat_ideal", set=["gaits=[crawl, trot]", "planner.calibration.duration=0"])
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    gaits = []
    for gait in ["trot"] * 20 + [-3] * 20:
        plant.write(controller.step(plant.read(), surefoot.UserCommand(gait=gait)))
        gaits.append(controller.plan.gait)
    assert set(gaits) == {scenario.gaits.index("trot")}


def test_what_is_for_a_name_is_refused_for_a_scenario():
    with pytest.raises(surefoot.Error, match="are for a scenario's name"):
        surefoot.run(surefoot.load_scenario("walk_flat_ideal"), seed=1)
