"""Stacks put together in Python."""

import copy
import pickle

import numpy as np
import pytest

import surefoot
from program import ROOT
from surefoot import StackLevel, Stack, Task, tasks


@pytest.fixture
def stack():
    return Stack("terrain_adaptation")


def test_a_stack_is_written_line_by_line_with_gains(stack):
    made = stack.before("torso_yaw", tasks.FramePosition("gripper", kp=100, kd=20)).without("torso_height")
    names = made.level_names
    assert names[names.index("torso_yaw") - 1] == "gripper_position" and "torso_height" not in names
    assert "gripper_position: frame_position kd=20 kp=100" in str(made) and "frame=gripper" in str(made)
    assert "torso_height" in stack.level_names, "what it was made from is as it was"
    assert repr(made).startswith("<stack terrain_adaptation: equations_of_motion > no_contact_motion > ")


def test_each_place_can_be_chosen(stack):
    one, two = tasks.TorsoTiltLimits("tilt"), StackLevel("more", [tasks.Posture(joints="legs"), tasks.TorqueMinimisation(weight=0.1)], damping=0.5)
    made = stack.after("com_xy", one).last(two).replace("torso_yaw", tasks.TorsoYaw(kp=50))
    names = made.level_names
    assert names[names.index("com_xy") + 1] == "tilt" and names[-1] == "more"
    last = list(made)[-1]
    assert (last.damping, last.tasks[1].weight, last.tasks[0].parameters["joints"]) == (0.5, 0.1, "legs")
    assert [level.tasks[0].parameters["kp"] for level in made if level.name == "torso_yaw"] == [50]
    assert [level.tasks[0].parameters["kp"] for level in stack.tune("com_xy", kp=300) if level.name == "com_xy"] == [300]


def test_levels_are_found_and_stacks_compared_copied_and_pickled(stack):
    assert stack["com_xy"] == stack[4] and stack[-1].name == "contact_force_minimisation" and "com_xy" in stack and stack[4] in stack and "nothing" not in stack
    with pytest.raises(surefoot.UnknownNameError, match="no level 'comxy'; did you mean \"com_xy\"?"):
        stack["comxy"]
    with pytest.raises(IndexError, match="no level 99; a name, or a place from 0 to"):
        stack[99]
    changed = stack.before("torso_yaw", tasks.Posture()).tune("com_xy", kp=300).without("torso_height").weighted_from("torso_yaw", torso_yaw=2)
    assert changed != stack == Stack("terrain_adaptation") and len({stack, Stack("terrain_adaptation"), changed}) == 2
    for again in (copy.copy(changed), copy.deepcopy(changed), pickle.loads(pickle.dumps(changed))):
        assert again == changed and str(again) == str(changed)


@pytest.mark.parametrize("make, said", [
    (lambda: Task("com"), 'task com: unknown task "com"; valid are: '),
    (lambda: tasks.ComXy(kp=float("nan")), 'task com_xy: kp: "NaN" is not a finite number'),
    (lambda: tasks.FramePosition("gripper", kp=-100), "^task frame_position: kp is -100, but"),
    (lambda: tasks.ComXy(weight=-1), "task com_xy: weight"),
    (lambda: Task("com_xy", kpp=1), 'kpp: the task com_xy has no such parameter; did you mean "kp"?'),
])  # fmt: skip
def test_a_task_that_no_stack_would_take_is_refused_where_it_is_made(make, said):
    with pytest.raises(surefoot.Error, match=said):
        make()


def test_a_stack_of_nothing_but_tasks_is_one(tmp_path):
    made = Stack(name="mine").last(tasks.EquationsOfMotion(), tasks.NoContactMotion(), tasks.TorqueLimits(), tasks.FrictionCone(), tasks.ComXy())
    made.write(tmp_path / "mine.yaml")
    assert Stack(tmp_path / "mine.yaml") == made and len(made) == 5


def test_a_stack_has_the_name_that_stands_in_its_file(stack, tmp_path):
    stack.write(tmp_path / "other.yaml")
    assert Stack(tmp_path / "other.yaml").name == stack.name
    assert Stack(tmp_path / "other.yaml", name="mine").name == "mine"
    (tmp_path / "other.yaml").write_text('name: "a: b"\nbase: walk\n')
    assert Stack(tmp_path / "other.yaml").name == "other", "no file can be called a: b"


def test_a_file_has_the_numbers_of_the_robot_that_it_is_written_for_and_says_which(stack, tmp_path):
    def kp(file, robot=None):
        return {level.name: level.tasks[0].parameters.get("kp") for level in Stack(file).levels(robot and surefoot.Robot(robot))}

    for robot, said in [(None, "ANYmal B"), ("solo12", "solo12"), (surefoot.Robot("solo12"), "solo12"), (ROOT / "robots/solo12.yaml", "solo12")]:
        stack.write(tmp_path / "mine.yaml", robot)
        assert (tmp_path / "mine.yaml").read_text().startswith(f"# Its numbers fit {said}; Stack.write(…, robot=…) writes those of another robot.\nname: ")
        expected = {level.name: level.tasks[0].parameters.get("kp") for level in stack.levels(None if robot is None else surefoot.Robot("solo12"))}
        assert kp(tmp_path / "mine.yaml") == kp(tmp_path / "mine.yaml", "hexapod") == expected
    Stack(name="own").last(tasks.EquationsOfMotion()).write(tmp_path / "own.yaml", robot="solo12")
    assert (tmp_path / "own.yaml").read_text().startswith("name: own\n"), "numbers that are given fit what they were given for"
    with pytest.raises(surefoot.Error, match="robot is 3; a Robot or a text or None would be valid"):
        stack.write(tmp_path / "mine.yaml", robot=3)


def test_levels_below_one_can_be_weighted_instead(stack, tmp_path):
    made = stack.weighted_from("com_xy", com_xy=100)
    assert made.level_names[-1] == "weighted" and len(made) == 5
    assert [task.weight for task in list(made)[-1].tasks if task.task == "com_xy"] == [100]
    assert "weighted" not in made.without("weighted") and made.tune("com_xy", weight=3)["weighted"].tasks[0].weight == 3
    made.write(tmp_path / "made.yaml")
    assert Stack(tmp_path / "made.yaml") == made


class Gained(surefoot.OwnTask):
    """The base is held with a gain that is set later."""

    max_rows, gain = 1, 1.0

    def rows(self, tick):
        base = tick.dynamics.base
        return base.J[2:3], [-self.gain * base.v[2] - base.Jdot_u[2]]


def test_a_task_of_ones_own_stays_the_object_that_it_is(stack):
    task = Gained("mine")
    for made in (stack.last(task), stack.last(task).tune("mine", weight=2), stack.last(task).weighted_from("torso_yaw", mine=2)):
        assert made == made == copy.copy(made) and made.own_tasks == [task] and made.own_tasks[0] is task
    tuned = stack.last(task).tune("mine", weight=2)
    assert tuned != stack.last(task) and tuned["mine"].tasks[0].weight == 2 and task.weight == 1
    assert tuned != stack.last(Gained("mine")).tune("mine", weight=2), "another task of the same name"


def test_what_is_set_of_a_task_of_ones_own_holds_in_the_controller(stack):
    task = Gained("mine")
    scenario = surefoot.load_scenario("walk_flat_ideal", stack=stack.first(StackLevel("both", [task])).without("both").last(task).tune("mine", weight=2))
    seen = []
    task.rows = lambda tick: seen.append(task.gain)
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    for gain in (3.0, 4.0):
        task.gain = gain
        plant.write(controller.step(plant.read(), scenario.user(0)))
    assert seen == [3.0, 4.0]


TUNED = r"of a task can't be set; stack.tune\('com_xy', \w+=…\) gives a stack with another one, or make a new task with it"


@pytest.mark.parametrize("make", [tasks.ComXy, lambda: Stack("terrain_adaptation")["com_xy"].tasks[0], lambda: copy.deepcopy(tasks.ComXy(kp=3)),
                                  lambda: pickle.loads(pickle.dumps(tasks.ComXy(kp=3)))])  # fmt: skip
@pytest.mark.parametrize("change, said", [
    (lambda task: setattr(task, "kp", 5), f"^kp {TUNED}"),
    (lambda task: setattr(task, "weight", 7), f"^weight {TUNED}"),
    (lambda task: setattr(task, "name", "other"), "^name of a task can't be set; a new task with another one would be valid"),
    (lambda task: setattr(task, "kpp", 5), 'the task com_xy has no kpp to set; did you mean "kp"?'),
    (lambda task: setattr(task, "parameters", {}), r"parameters of a task can't be changed: stack.tune\(task.task, kp=…\)"),
    (lambda task: task.parameters.update(kp=-3), r"parameters of a task can't be changed: stack.tune\(task.task, kp=…\)"),
    (lambda task: task.parameters.__setitem__("kp", -3), "parameters of a task can't be changed"),
])  # fmt: skip
def test_a_task_of_the_library_is_not_changed(make, change, said):
    task = make()
    before = repr(task)
    with pytest.raises(surefoot.Error, match=said):
        change(task)
    assert repr(task) == before


def test_a_task_of_ones_own_has_further_attributes_and_so_has_one_that_is_derived(stack):
    class Soft(tasks.ComXy):
        def __init__(self):
            super().__init__(kp=20)
            self.note = "soft"

    task = Gained("mine")
    task.gain = task.more = 3
    for fixed in (task, Soft()):
        with pytest.raises(AttributeError, match="^weight of a task can't be set"):
            fixed.weight = 3
    assert (task.gain, task.more, Soft().note) == (3, 3, "soft") and stack.replace("com_xy", Soft())["com_xy"].tasks[0].parameters["kp"] == 20


@pytest.mark.parametrize("name", ["v1/2", "../../tmp/zz", "a\\b", "..", "- a", "*a", "a: b", "a\0", "a" * 201])
def test_a_stacks_name_is_one_that_a_file_can_have(name):
    with pytest.raises(surefoot.Error, match="is no name of a stack; one that begins with a letter"):
        Stack("terrain_adaptation", name=name)


def test_a_stacks_name_may_be_a_text_and_is_not_set_later():
    made = Stack("terrain_adaptation", name="größer 2.1 - b")
    with pytest.raises(surefoot.Error, match=r"name of a stack can't be set; Stack\(…, name=…\)"):
        made.name = "other"
    with pytest.raises(surefoot.Error, match=r"name of a stack can't be set; Stack\(…, name=…\)"):
        del made.name
    with pytest.raises(surefoot.Error, match=r"has no kp to set; before\(\), .* give another stack"):
        made.kp = 3
    with pytest.raises(surefoot.Error, match=r"damping of a level can't be set; stack.replace\('com_xy', StackLevel\(…\)\)"):
        made["com_xy"].damping = 1.0
    assert surefoot.load_scenario("walk_flat", stack=made).name == "walk_flat"
    with pytest.raises(surefoot.Error, match="^stack größer 2.1 - b: .* at most|^stack größer 2.1 - b: .*reaches only"):
        surefoot.load_scenario("walk_flat", stack=made.tune("limb_extension_limits", max=3))


def test_every_task_of_the_catalog_has_a_class_with_its_parameters():
    for info in surefoot.catalog():
        made = getattr(tasks, "".join(word.capitalize() for word in info["name"].split("_")))
        assert made().task == info["name"] and info["summary"][1:] in made.__doc__
        numbers = {each["name"]: each["default"] for each in info["numbers"]}
        assert made(name="own", **numbers).parameters == numbers


def test_numbers_of_the_base_go_with_the_robots_size_and_given_ones_do_not(stack):
    small = surefoot.Robot("solo12")
    made = stack.tune("com_xy", kp=300)
    kp = {level.name: level.tasks[0].parameters.get("kp") for level in made.levels(small)}
    assert kp["com_xy"] == 300 and kp["swing_foot"] > 800


def test_a_frame_is_followed_by_tasks_that_are_told_apart_by_it(stack):
    made = stack.before("torso_yaw", tasks.FramePosition("LF_SHANK", held_in="world"), tasks.FrameOrientation("LF_SHANK"), tasks.FramePosition("base"))
    assert {"LF_SHANK_position", "LF_SHANK_orientation", "base_position"} <= set(made.level_names)
    assert tasks.FramePosition("my/frame:0").name == "my/frame_0_position", "a level's name has no colon"
    assert tasks.FramePosition().name == "frame_position", "the tip of an arm that reaches"


def test_a_frame_is_asked_for_where_there_is_no_arm(stack):
    made = stack.before("torso_yaw", tasks.FramePosition())
    with pytest.raises(surefoot.Error, match='frame_position: no frame is given, and the robot anymal_b has no arm .*; valid is .* "base"'):
        surefoot.Controller("anymal_b", stack=made)
    assert surefoot.Controller("anymal_b_kinova", stack=made).level_names.index("frame_position") > 0


def test_posture_is_of_any_joints(stack):
    made = stack.last(tasks.Posture(joints=["LF_HAA", "RF_HAA"], target="plan"))
    assert list(made)[-1].tasks[0].parameters["joints"] == "LF_HAA RF_HAA"
    scenario = surefoot.load_scenario("walk_flat", stack=made)
    assert surefoot.Controller(scenario).plan is not None


def test_a_frame_that_the_robot_has_not_is_told_with_near_ones(stack):
    with pytest.raises(surefoot.Error, match='has no frame "LF_SHNK"; did you mean "LF_SHANK"\\? closest: LF_SHANK, '):
        surefoot.load_scenario("walk_flat", stack=stack.last(tasks.FramePosition("LF_SHNK")))


@pytest.mark.parametrize("change, said", [
    (lambda s: s.without("equations_of_motion"), 'the stack "terrain_adaptation" has no equations_of_motion: its torques'),
    (lambda s: s.first(tasks.TorsoTiltLimits()), "has torso_tilt_limits above equations_of_motion"),
])  # fmt: skip
def test_a_stack_without_the_robots_dynamics_first_is_refused(stack, change, said):
    with pytest.raises(surefoot.Error, match=said):
        surefoot.Controller("anymal_b", stack=change(stack))


@pytest.mark.parametrize("level, said", [("torque_limits", "cut off"), ("friction_cone", "slide"), ("no_contact_motion", "it falls")])
def test_what_else_a_stack_lacks_of_the_physics_is_told(stack, level, said):
    notes = surefoot.Controller("anymal_b", stack=stack.without(level)).notes
    assert any(f'the stack "terrain_adaptation" has no {level}: ' in note and said in note for note in notes)


class Still(surefoot.OwnTask):
    """The base keeps still."""

    max_rows, unit = 3, "m/s²"

    def rows(self, tick):
        base = tick.dynamics.base
        return base.J, -20 * base.v - base.Jdot_u


def test_a_registered_task_can_be_named_by_stack_files(tmp_path):
    surefoot.register_task(Still("still"))
    assert surefoot.catalog()[-1] | {"numbers": []} == {
        "name": "still", "summary": "The base keeps still.", "equation": "–", "unit": "m/s²", "numbers": [], "choices": []}  # fmt: skip
    with pytest.raises(KeyError, match='there is no "nam"; did you mean "name"'):
        surefoot.catalog()[-1]["nam"]
    (tmp_path / "mine.yaml").write_text("name: mine\nbase: terrain_adaptation\nlevels: [equations_of_motion, no_contact_motion, torque_limits, "
                                        "friction_cone, {task: still}, swing_foot]\n")  # fmt: skip
    made = Stack(tmp_path / "mine.yaml")
    assert "still" in made.level_names and [task.task for task in made.own_tasks] == ["still"]
    for scenario in (surefoot.load_scenario("walk_flat", stack=made), surefoot.load_scenario("walk_flat", stack=str(tmp_path / "mine.yaml"))):
        assert surefoot.Controller(scenario).level_names[4] == "still"
    with pytest.raises(surefoot.Error, match="there is a task 'com_xy' already"):
        surefoot.register_task(Still("com_xy"))
    with pytest.raises(surefoot.Error, match="task is .*; an OwnTask would be valid"):
        surefoot.register_task(tasks.ComXy())


@pytest.mark.parametrize("read", [Stack, lambda file: surefoot.load_scenario("walk_flat", stack=file),
                                  lambda file: surefoot.Controller("anymal_b", stack=file)])  # fmt: skip
def test_a_file_with_a_task_of_ones_own_says_how_that_is_known(stack, tmp_path, read):
    file = str(tmp_path / "mine.yaml")
    stack.last(Still("nowhere_registered")).write(file)
    with pytest.raises(surefoot.Error, match=r'unknown task "nowhere_registered"; valid are: .*; one of your own is known after register_task\(\)$'):
        read(file)


def test_a_level_of_one_task_needs_no_list():
    assert StackLevel("a", tasks.ComXy()) == StackLevel("a", [tasks.ComXy()])


@pytest.mark.parametrize("change, said", [
    (lambda s: s.before("torso_yow", tasks.Posture()), "has no level 'torso_yow'; did you mean \"torso_yaw\"?"),
    (lambda s: s.before("torso_yaw"), "no level was given"),
    (lambda s: s.last(3), "new is 3; a Task or a StackLevel would be valid"),
    (lambda s: s.last(tasks.ComXy()), "two levels have the name 'com_xy'"),
    (lambda s: s.last(tasks.ComXy("again", kp=-1)), "task com_xy: kp is -1, but must be a number of at least 0"),
    (lambda s: s.tune("com_xy", kp=float("nan")), 'level com_xy: kp: "NaN" is not a finite number'),
    (lambda s: s.tune("com_xy", kpp=1), 'level com_xy: kpp: the task com_xy has no such parameter; did you mean "kp"?'),
    (lambda s: s.tune("com_x", kp=1), "has no task 'com_x'; did you mean \"com_xy\"?"),
    (lambda s: s.tune("limb_extension_limits", form="round"), 'form is "round", but must be one of: paper relative radial'),
    (lambda s: s.weighted_from("torque_limits"), "keeps the physics and can't be weighted"),
    (lambda s: s.last(StackLevel("empty", [])), "level empty: has no task"),
    (lambda s: s.last(StackLevel("odd", ["com_xy"])), "'com_xy' is no task; one of surefoot.tasks or an OwnTask is valid"),
    (lambda s: StackLevel("odd", 3), "level odd: 3 is no task; one of surefoot.tasks or an OwnTask is valid"),
    (lambda s: Stack("terrain"), 'unknown stack "terrain"; valid are: crouch_first'),
    (lambda s: tasks.ComXy("a: b"), "'a: b' is no name of a level"),
])  # fmt: skip
def test_what_can_be_no_stack_is_refused_at_once(stack, change, said):
    with pytest.raises(surefoot.Error) as error:
        change(stack)
    assert said in str(error.value)


def test_a_scenario_and_a_controller_have_the_stack_and_take_another(stack):
    short = stack.tune("com_xy", kp=300)
    scenario = surefoot.load_scenario("walk_flat_ideal", set=["duration=0.1"], stack=short)
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    assert controller.level_names == short.level_names
    controller.step(plant.read(), scenario.user(0.0))
    torso_first = stack.without("com_xy").last(tasks.ComXy(kp=500, kd=45))
    assert controller.set_stack(torso_first, duration=0.01)
    assert not controller.set_stack(stack), "the other change still goes on"
    for _ in range(10):
        plant.write(controller.step(plant.read(), scenario.user(plant.time)))
    assert controller.level_names[-1] == "com_xy"
    with pytest.raises(surefoot.Error, match="level"):
        controller.set_stack(stack.without("com_xy"))
    with pytest.raises(surefoot.Error, match="0.535|reach|at most"):
        surefoot.load_scenario("walk_flat", stack=stack.tune("limb_extension_limits", max=3))


def test_a_scenario_is_changed_by_what_only_the_stack_knows(stack):
    mine = stack.before("torso_yaw", tasks.FramePosition("LF_SHANK", name="shank"))
    for word in ("user=[{time: 0, reach: {frame: LF_SHANK, position: [0.4, 0.2, -0.2]}}]", "tasks.frame_position.kp=10", "stack_switches=[{time: 1, remove: [shank]}]"):
        assert surefoot.load_scenario("walk_flat_ideal", stack=mine, set=[word]).name == "walk_flat_ideal"


def test_levels_are_taken_off_and_put_back_while_it_walks(stack):
    scenario = surefoot.load_scenario("walk_flat_ideal", stack=stack)
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    for _ in range(40):
        plant.write(controller.step(plant.read(), scenario.user(0.0)))
    assert controller.switch_levels(remove=["torso_height"], duration=0.01)
    for _ in range(8):
        plant.write(controller.step(plant.read(), scenario.user(plant.time)))
    left = {level.name: level.degrees_of_freedom_left for level in controller.levels()}
    assert left["torso_height"] == left["torso_yaw"] and controller.switch_levels(add=["torso_height"], duration=0.01)
    with pytest.raises(surefoot.Error, match="torso_heigt"):
        controller.switch_levels(add=["torso_heigt"])
    controller.set_friction(0.4)
    with pytest.raises(surefoot.Error, match="friction"):
        controller.set_friction(-1)


@pytest.mark.parametrize("name, set", [("walk_flat", ["robot=spot_arm"]), ("step_down", []), ("walk_flat", ["robot=solo12"])])
def test_the_same_stack_again_changes_nothing_with_arms_and_with_tasks_of_the_scenario(name, set):
    scenario = surefoot.load_scenario(name, set=[*set, "stack=terrain_adaptation"])
    plant = surefoot.Plant(scenario)
    controller, other = surefoot.Controller(scenario, plant), surefoot.Controller(scenario, plant)
    for tick in range(120):
        reading, user = plant.read(), scenario.user(plant.time)
        if tick == 60:
            assert other.set_stack("terrain_adaptation", duration=0.05)
        torque = controller.step(reading, user).torque
        np.testing.assert_allclose(other.step(reading, user).torque, torque, atol=1e-6)
        plant.write(torque)
    assert other.level_names == controller.level_names
    if name == "step_down":
        ours = Stack("terrain_adaptation").tune("friction_cone", axes="control")
        assert "axes: \"control\"" in ours.text(changed={"friction_cone": {"axes": "gravity"}}), "what you give yourself wins"
