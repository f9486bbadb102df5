"""Every function and property of the package with every kind of wrong argument: what it says names the argument and what would be valid."""

import contextlib
import copy
import fractions
import functools
import inspect
import math
import os
import pickle
import pydoc
import re

import numpy as np
import pytest

import surefoot
from surefoot import _arguments

BAD = {
    "an object": object(), "a text": "nonsense", "None": None, "nan": math.nan, "a fraction": 1.5, "minus seven": -7, "a million million": 10**12,
    "bytes": b"ab", "fifty numbers": [1.0] * 50, "one number": [1.0], "numbers and a text": [0.0, "a", 1.0], "nan in numbers": [math.nan, 0.0, 1.0],
    "a matrix": np.eye(2), "a dict": {"a": 1}, "a set": {1, 2}, "a function": lambda *given: None, "True": True,
}  # fmt: skip
LIVES_SHORTLY = {"GaitTick"}  # within a gait's method: test_own_gaits.py
HEAVY = {"film", "report", "picture", "plot", "doctor", "write", "complete"}  # what they take is checked as for all others
INTERNAL = {"read_scenario", "parse_stack", "stack_levels", "run_scenario", "try_task", "ControllerBase.__init__", "ControllerBase.set_stack_text", "GaitEvent", "Recorded.__init__", "OwnTask.rows"}  # what surefoot's own Python calls
VALID = {  # where the parameter's name alone does not say it
    "Recorded.in_W": lambda world: {"name": "truth.p_SB"}, "Recorded.aligned_error": lambda world: {"name": "com"},
    "ControllerBase.switch_levels": lambda world: {"remove": ["torso_height"]}, "check_task": lambda world: {"task": world.own_task},
    "Recorder.__init__": lambda world: {"controller": world.fresh},
}  # fmt: skip
TOLD = (ValueError, TypeError, KeyError)  # surefoot.Error is a ValueError


class World:
    """Valid arguments and objects, by the names of parameters and classes."""

    def __init__(self, folder, log):
        self.scenario = surefoot.load_scenario("walk_flat", set=["duration=0.01", "stack=terrain_adaptation"])
        self.plant = surefoot.Plant(self.scenario)
        self.controller = surefoot.Controller(self.scenario, self.plant)
        self.stack = surefoot.Stack("terrain_adaptation")
        ticks, inputs, kept = [], [], []

        class Keeps(surefoot.OwnTask):
            max_rows = 1

            def rows(self, tick):
                ticks.append(tick)

        class Looks(surefoot.Estimator):
            def update(self, reading, context):
                inputs.append(context)
                return super().update(reading, context)

        class Plans(surefoot.Planner):
            def update(self, user, state, dynamics, last):
                inputs.append(last)
                return super().update(user, state, dynamics, last)

        scenario = surefoot.load_scenario("walk_flat", set=["duration=0.5"], stack=self.stack.last(Keeps("keeps")))
        self.result = surefoot.run(scenario, estimator=Looks(scenario), planner=Plans(scenario), every_tick=kept.append)
        self.tick, self.task_tick, self.context, self.last = kept[-1], ticks[-1], inputs[-2], inputs[-1]
        self.controller.step(self.plant.read(), self.scenario.user(0))
        self.planner, self.estimator = surefoot.Planner(self.scenario), surefoot.Estimator(self.scenario)
        self.folder, self.log = folder, log
        self.own_task, self.fresh = Keeps("keeps"), surefoot.Controller(self.scenario)

    def argument(self, name):
        user, robot = surefoot.UserCommand(), self.scenario.robot_model
        valid = {
            "name": "walk_flat", "name_or_path": "anymal_b", "scenario": self.scenario, "plant": self.plant, "controller": self.controller,
            "of": self.scenario, "reading": self.plant.read(), "user": user, "command": self.controller.command, "time": 0.0, "state": self.controller.state,
            "dynamics": robot.dynamics(), "last": self.last, "context": self.context, "force": [0, 1, 0], "sensor": "imu", "x": 0.0, "y": 0.0,
            "friction": 0.5, "levels": [{"A": [[1.0]], "b": [1.0]}], "leg": "LF", "link": "base", "metric": "steps_taken", "log": self.log,
            "path": self.log, "spec": {"scenario": "walk_flat_ideal", "seeds": [1], "set": {"duration": 0.05}, "name": "short"},
            "task": "com_xy", "tasks": [surefoot.tasks.ComXy()], "level": "com_xy", "stack": self.stack, "text": self.stack.text(), "duration": 0.3,
            "record": None, "every_tick": None, "estimator": None, "planner": None, "description": robot.urdf, "file": str(self.folder / "a.yaml"),
            "topic": "state", "names": [], "new": [], "robot": None, "torque": [0.0] * 12, "folder": str(self.folder), "out": str(self.folder / "out"),
        }  # fmt: skip
        return valid[name]

    def of_class(self, kind):
        made = {
            "Plant": self.plant, "Controller": self.controller, "ControllerBase": self.controller, "Scenario": self.scenario, "Stack": self.stack,
            "Robot": self.scenario.robot_model, "Dynamics": self.scenario.robot_model.dynamics(), "TaskTick": self.task_tick, "Result": self.result,
            "Planner": self.planner, "Estimator": self.estimator, "Task": surefoot.tasks.ComXy(), "Aligner": surefoot.Aligner(),
            "HierarchicalSolver": surefoot.HierarchicalSolver(), "Recorded": surefoot.read(self.log),
            "Evaluator": surefoot.Evaluator(self.scenario, self.plant, self.controller), "MotionPlan": self.controller.plan,
            "Recorder": surefoot.Recorder(surefoot.Controller(self.scenario), self.folder / "own.mcap"),
            "RobotState": self.controller.state, "GroundTruth": self.plant.truth, "FootPlan": self.controller.plan.feet["LF"],
            "TorsoPlan": self.controller.plan.torso, "ComPlan": self.controller.plan.com, "ArmPlan": self.controller.plan.arm,
            "ModelRecord": self.controller.model, "SensorHealth": self.controller.health, "GroupHealth": self.controller.health.imu,
            "TickTiming": self.controller.timing, "Tick": self.tick, "Solution": surefoot.solve([{"A": [[1.0]], "b": [1.0]}]),
        }  # fmt: skip
        inside = {"Alignment": lambda: surefoot.Aligner().update(self.plant, self.controller), "TrueContact": lambda: self.plant.truth.feet["LF"],
                  "WorldPose": lambda: surefoot.Aligner().update(self.plant, self.controller).feet,
                  "FrameList": lambda: surefoot.MotionPlan().frames}  # fmt: skip
        return made[kind.__name__] if kind.__name__ in made else inside.get(kind.__name__, kind)()


@pytest.fixture(scope="module")
def world(tmp_path_factory, log):
    folder = tmp_path_factory.mktemp("world")
    before = os.getcwd()
    os.chdir(folder)
    yield World(folder, str(log))
    os.chdir(before)


def parameters(function):
    """Of each form that a function has."""
    inner = function.__wrapped__
    if hasattr(inner, "__nb_signature__"):
        return [_arguments.signature_of(text, defaults).parameters for text, _, defaults in inner.__nb_signature__]
    return [inspect.signature(inner).parameters]


def public():
    """(name, class or None, function or property) of all that takes arguments."""
    from surefoot_log.recorded import Recorded

    _arguments.checked(Recorded)
    for name, thing in [*vars(surefoot).items(), ("Recorded", Recorded)]:
        if name[0] == "_" or name in INTERNAL | LIVES_SHORTLY or inspect.ismodule(thing) or (isinstance(thing, type) and issubclass(thing, Exception)):
            continue
        if not isinstance(thing, type):
            yield name, None, thing
            continue
        for member, inner in vars(thing).items():
            if isinstance(inner, property) and inner.fset is not None or member == "__init__" and hasattr(inner, "__wrapped__"):
                yield f"{name}.{member}", thing, inner
            elif callable(inner) and member[0] != "_" and not isinstance(inner, type) and member not in HEAVY:
                yield f"{name}.{member}", thing, inner


PUBLIC = {name: (kind, function) for name, kind, function in public() if name not in HEAVY | INTERNAL}


def calls(world, name, kind, function):
    """(parameter, call with a value of it) for each."""
    if isinstance(function, property):
        thing = world.of_class(kind)
        return [(name.partition(".")[2], lambda value: function.fset(thing, value))]
    found = []
    for form in parameters(function):
        names = list(form)[1 if kind else 0 :]
        if kind is surefoot.StackLevel or name == "OwnTask.__init__":
            continue
        thing = None if kind is None or name.endswith("__init__") else world.of_class(kind)
        target = kind if name.endswith("__init__") else function if kind is None else getattr(thing, function.__name__)
        needed = [each for each in names if form[each].default is inspect.Parameter.empty and form[each].kind < inspect.Parameter.VAR_POSITIONAL]
        for each in names:
            if form[each].kind in (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD):
                continue

            def call(value, each=each, target=target, needed=needed):
                others = {one: world.argument(one) for one in needed if one != each} | VALID.get(name, lambda world: {})(world)
                return target(**others | {each: value})

            found.append((each, call))
    return found


@pytest.mark.parametrize("name", PUBLIC)
def test_a_wrong_argument_is_named_with_what_was_given_or_would_be_valid(world, name):
    wrong = []
    for parameter, call in calls(world, name, *PUBLIC[name]):
        for what, value in BAD.items():
            try:
                call(value)
            except TOLD as error:
                text = str(error)
                given = [_arguments.shown(value)[:20], *([value] if isinstance(value, str) else []), *(["1e+12"] if isinstance(value, int) and value == 10**12 else [])]
                is_named = re.search(rf"\b{parameter.rstrip('s')}", text) or any(each in text for each in given)
                if not is_named or "incompatible function" in text or "_core" in text:
                    wrong.append(f"{parameter} = {what}: {text}")
            except BaseException as error:
                wrong.append(f"{parameter} = {what}: {type(error).__name__}: {error}")
    assert not wrong, "\n".join(wrong)


def test_enough_is_looked_at():
    assert len(PUBLIC) > 150 and {"run", "Plant.push", "UserCommand.velocity", "Controller.__init__", "Stack.tune", "Recorded.in_W"} <= PUBLIC.keys()


@pytest.mark.parametrize("call, said", [
    (lambda world: world.plant.push([0, 60]), "force has 3 numbers; 2 were given"),
    (lambda world: world.plant.push("north"), "force is the text 'north'; a list of numbers would be valid"),
    (lambda world: world.controller.step(None, surefoot.UserCommand()), "reading is None; a SensorReading would be valid"),
    (lambda world: world.plant.write(None), "command is None; a JointCommand or a list of numbers would be valid"),
    (lambda world: world.plant.write([0.0] * 11), "the command has 11 torques, but the robot has 12 joints"),
    (lambda world: surefoot.load_scenario("walk_flat", seed=1.5), "seed is 1.5; a whole number would be valid"),
    (lambda world: surefoot.run("walk_flat", every_tick=3), "every_tick is 3; a function or None would be valid"),
    (lambda world: surefoot.run("walk_flat", set=3), "set is 3; a list of texts or a dict would be valid"),
    (lambda world: surefoot.run("walk_flat", set={"duration": -2}), "set has 'duration=-2': \"-2\" is not a number above 0"),
    (lambda world: surefoot.run(3), "scenario is 3; a Scenario or a text would be valid"),
    (lambda world: surefoot.campaign({}), "^spec: "),
    (lambda world: surefoot.read(world.log).in_W([1, 2]), r"name is \[1, 2\]; a text would be valid"),
    (lambda world: surefoot.UserCommand(walk=True, velocty=[0.1, 0]), r"^UserCommand\(\): .*'velocty'; did you mean velocity\? its arguments are walk, velocity"),
    (lambda world: world.scenario.robot_model.dynamics(u_=[0]), r"^Robot.dynamics\(\): .*'u_'"),
    (lambda world: setattr(surefoot.UserCommand(), "velocity", [[0.1, 0]]), r"^velocity has the shape \(1, 2\); a list of numbers would be valid, of one dimension$"),
    (lambda world: world.plant.write(np.zeros((12, 1))), r"^command has the shape \(12, 1\); a JointCommand or a list of numbers would be valid, of one dimension$"),
    (lambda world: world.scenario.robot_model.dynamics(q=np.zeros((12, 1))), r"^q has the shape \(12, 1\); a list of numbers or None would be valid, of one dimension$"),
    (lambda world: setattr(surefoot.UserCommand(), "velocity", np.array(["1", "2"])), r"^velocity is array\(\['1', '2'\].*\); a list of numbers would be valid$"),
    (lambda world: setattr(surefoot.UserCommand(), "velocity", np.array([1j, 2])), r"^velocity is array\(\[0.\+1.j, 2.\+0.j\]\); a list of numbers would be valid$"),
    (lambda world: world.plant.write(torque=np.zeros(12) * 1j), r"^torque is array\(.*; a list of numbers would be valid$"),
    (lambda world: surefoot.load_scenario("walk_flat", seed=np.array(1.5)), r"^seed is array\(1.5\); a whole number would be valid$"),
    (lambda world: surefoot.tasks.ComXy(kp=np.complex128(1)), r"^kp is np.complex128\(1\+0j\); a number or None would be valid$"),
    (lambda world: surefoot.campaign({"scenario": world.scenario, "seeds": [1]}), "^spec has a Scenario; numbers, texts, .* scenarios and robots go by their names$"),
    (lambda world: surefoot.campaign({"scenario": "walk_flat", "seeds": np.array([1j])}), "^spec has a complex; numbers, texts, "),
    (lambda world: surefoot.UserCommand(speed=3), r"UserCommand\(\): got an unexpected keyword argument 'speed'; its arguments are walk, velocity"),
    (lambda world: surefoot.SensorReading(q=[0] * 12), r"^SensorReading\(\): q is set behind it: made = SensorReading\(num_joints, num_legs\); made.q = …$"),
    (lambda world: world.plant.push(), r"Plant.push\(\): missing a required argument: 'force'; its arguments are force, body"),
    (lambda world: surefoot.Scenario(), "Scenario objects are made by the library, not by hand"),
    (lambda world: surefoot.Robot(None), "name_or_path is None; a text would be valid"),
    (lambda world: surefoot.tasks.ComXy(kp=[1]), r"kp is \[1\]; a number or None would be valid"),
    (lambda world: setattr(surefoot.UserCommand(), "velocity", "fast"), "velocity is the text 'fast'; a list of numbers would be valid"),
    (lambda world: surefoot.Controller("anymal_b", stak="walk"), r"^Controller\(\): got an unexpected keyword argument 'stak'; did you mean stack\? its arguments are of, plant, stack"),
    (lambda world: surefoot.tasks.FramePosition("base", kpp=1), r"^FramePosition\(\): .*'kpp'; did you mean kp\? its arguments are frame"),
    (lambda world: surefoot.OwnTask(), r"^OwnTask\(\): missing a required argument: 'name'; its arguments are name, weight"),
    (lambda world: surefoot.register_task("a", 1), r"^register_task\(\): too many positional arguments; its arguments are task"),
    (lambda world: surefoot.run("walk_flat", every_tick=lambda: 1), r"every_tick\(\): .*; a function of tick would be valid"),
    (lambda world: surefoot.Controller("anymal_b", stack=world.stack.last(surefoot.tasks.FramePosition("gripper"))), "^stack terrain_adaptation: the robot anymal_b has no frame"),
    (lambda world: surefoot.Controller("anymal_b", stack="foo"), '^stack foo: unknown stack "foo"; valid are: '),
    (lambda world: surefoot.load_scenario("walk_flat", set=["durtion=2"]), "^set has 'durtion=2': unknown key; did you mean \"duration\""),
    (lambda world: surefoot.read(world.log).film("a.mp4", 3, 1), "^no tick lies from 3 s to 1 s; the log goes from 0 s to"),
    (lambda world: surefoot.read(world.log).film("a.avi"), "^a.avi: films are written as MP4; a name that ends with .mp4"),
    (lambda world: surefoot.campaign({"scenario": "walk_flt", "seeds": [1]}), '^spec: .*unknown scenario "walk_flt"; did you mean "walk_flat"'),
    (lambda world: surefoot.campaign({"scenario": "walk_flat", "seeds": [1], "grid": {"durtion": [1]}}), '^spec: .*unknown key; did you mean "duration"'),
    (lambda world: setattr(surefoot.UserCommand(), "walk", 1), "walk is 1; True or False would be valid"),
])  # fmt: skip
def test_it_reads_like_advice(world, call, said):
    with pytest.raises(surefoot.Error if "objects are made" not in said else TypeError, match=said) as raised:
        call(world)
    assert "--" not in str(raised.value) and "/tmp" not in str(raised.value)


def test_nan_that_was_written_into_a_vector_is_refused_before_the_tick(world):
    user, command = surefoot.UserCommand(walk=True), surefoot.JointCommand([0.0] * 12)
    user.velocity[1] = math.nan
    with pytest.raises(surefoot.Error, match=r"velocity\[1\] is nan"):
        world.controller.step(world.plant.read(), user)
    command.torque[3] = math.nan
    with pytest.raises(surefoot.Error, match=r"torque\[3\] is nan"):
        world.plant.write(command)
    with pytest.raises(ValueError, match="read-only"):
        world.scenario.torque_limit[0] = math.nan


def test_a_field_that_is_not_there_is_told_with_the_nearest():
    with pytest.raises(AttributeError, match="a UserCommand has no velocty; did you mean velocity\\? it has walk, velocity"):
        surefoot.UserCommand().velocty = [1, 0]
    with pytest.raises(AttributeError, match="can't be replaced"):
        surefoot.MotionPlan().feet = {}


def objects(of, found, depth=0):
    """One of each class of the package that is reached from an object."""
    if isinstance(of, dict | list | tuple):
        for one in [*(of.values() if isinstance(of, dict) else of)][:3]:
            objects(one, found, depth)
    elif type(of).__module__.startswith("surefoot") and not isinstance(of, np.ndarray) and type(of) not in found and depth < 6:
        found[type(of)] = of
        for name in dir(of):
            with contextlib.suppress(surefoot.Error):  # of a run that has ended
                if name[0] != "_" and not callable(value := getattr(of, name)):
                    objects(value, found, depth + 1)


def test_every_object_prints_as_something_useful(world):
    class Own(surefoot.Estimator):
        pass

    dynamics, found = world.scenario.robot_model.dynamics(), {}
    evaluator = surefoot.Evaluator(world.scenario, world.plant, world.controller)
    for one in [world.scenario, world.plant, world.controller, world.controller.levels(), world.result, world.tick, world.task_tick, world.context, world.last,
                dynamics, dynamics.frame("LF_FOOT"), evaluator, surefoot.Aligner(), surefoot.explain(world.log, 1.0), surefoot.read(world.log), world.stack,
                world.planner, surefoot.HierarchicalSolver(), surefoot.solve([{"A": [[1.0]], "b": [1.0]}])]:  # fmt: skip
        objects(one, found)
    texts = {kind.__name__: repr(one) for kind, one in found.items()}
    assert {"Point", "Frame", "TickContext", "FootContact", "HierarchyOutcome", "TaskTick", "Evaluator", "Explanation", "Aligner", "Planner"} <= texts.keys()
    assert not [f"{name}: {text}" for name, text in texts.items() if " object at 0x" in text]
    assert repr(Own()) == "<Own, an own Estimator>" and texts["HierarchyOutcome"].startswith("HierarchyOutcome(tilt_shortfall=")
    assert "J=3×18" in texts["Point"] and texts["Explanation"].startswith("<explanation: ") and len(texts["TaskTick"]) < 200


def test_help_has_what_is_meant_for_users_each_with_a_text():
    text = pydoc.plain(pydoc.render_doc(surefoot))
    for name in ("run(", "load_scenario(", "campaign(", "class Controller(", "class Stack(", "class OwnTask(", "class Recorded(", "read("):
        assert re.search(rf"^    {re.escape(name)}", text, re.MULTILINE), name
    assert not re.search(r"parse_stack|read_scenario|run_scenario|stack_levels\(", text)
    assert not [name for name in dir(surefoot) if name in INTERNAL and "." not in name and name != "GaitEvent"]
    without = [f"{kind.__name__}.{name}" for kind in map(surefoot.__dict__.get, surefoot.__all__) if isinstance(kind, type) and not issubclass(kind, Exception)
               for name, member in vars(kind).items() if name[0] != "_" and not re.sub(r"\(self.*\) -> .*", "", inspect.getdoc(member) or "")]  # fmt: skip
    assert not without


def test_a_command_can_be_copied_and_pickled():
    user = surefoot.UserCommand(walk=True, velocity=[0.1, 0], reach=surefoot.ReachCommand(0, [0.5, 0, 0.6]), gait="trot")
    for again in (copy.copy(user), copy.deepcopy(user), pickle.loads(pickle.dumps(user))):
        assert repr(again) == repr(user) and again is not user
    again.velocity[0] = 1.0
    assert user.velocity[0] == 0.1


def test_no_field_of_a_command_is_lost_on_the_way_to_another_process():
    user, seen = surefoot.UserCommand(), {}
    for number, (name, member) in enumerate(vars(surefoot.UserCommand).items()):
        if not isinstance(member, property):
            continue
        before = copy.copy(getattr(user, name))
        given = {bool: lambda: not before, float: lambda: 0.1 * number, int: lambda: "trot", np.ndarray: lambda: 0.1 * number + np.arange(len(before)),
                 surefoot.ReachCommand: lambda: surefoot.ReachCommand(arm=1, position=[1, 2, 3], in_world=True, orientation=[0.1, 0, 0], frame=2)}  # fmt: skip
        setattr(user, name, given[type(before)]())
        seen[name] = repr(getattr(user, name))
        assert seen[name] != repr(before), f"{name} is as it was"
    again = pickle.loads(pickle.dumps(user))
    assert {name: repr(getattr(again, name)) for name in seen} == seen and {"walk", "reach", "gait"} <= set(seen)


@pytest.mark.parametrize("robot", ["anymal_b", "hexapod"])
def test_what_a_loop_passes_on_can_be_copied_and_pickled(robot):
    scenario = surefoot.load_scenario("walk_flat", robot=robot)
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    for _ in range(40):
        plant.write(controller.step(plant.read(), surefoot.UserCommand(walk=True)))
    passed = [plant.read(), plant.truth, controller.command, surefoot.ReachCommand(0, [0.5, 0, 0.6])]
    passed += [controller.plan, controller.state, controller.model, controller.health, controller.plan.feet["LF"], controller.timing]
    for one in passed:
        for again in (copy.copy(one), copy.deepcopy(one), pickle.loads(pickle.dumps(one))):
            assert repr(again) == repr(one) and again is not one
    again = copy.deepcopy(controller.plan)
    again.feet["LF"].p_WF[0] += 1.0
    assert again.feet["LF"].p_WF[0] != controller.plan.feet["LF"].p_WF[0]
    assert copy.deepcopy(scenario) is copy.copy(scenario) is scenario, "nothing in it changes"


def test_a_reach_is_written_as_a_whole():
    user = surefoot.UserCommand()
    user.reach = surefoot.ReachCommand(0, [0.5, 0, 0.6])
    assert user.reach.arm == 0 and user.reach.position[0] == 0.5
    with pytest.raises(AttributeError, match="feet of a MotionPlan can't be replaced"):
        surefoot.MotionPlan().feet = {}


def test_a_frame_by_name_is_told_where_its_number_is(world):
    robot = world.scenario.robot_model
    for named in (lambda: surefoot.ReachCommand(frame="LF_SHANK"), lambda: setattr(surefoot.ReachCommand(), "frame", "LF_SHANK")):
        with pytest.raises(surefoot.Error, match=r"frame is the text 'LF_SHANK'; a whole number would be valid: its place, ") as error:
            named()
        assert eval(str(error.value).rpartition("its place, ")[2]) == robot.frames.index("LF_SHANK")


def test_help_shows_signature_and_text():
    assert str(inspect.signature(surefoot.Plant.push)).startswith("(self, force: 'collections.abc.Sequence[float]', body: 'str' = '', duration: 'float' = 0.1")
    assert surefoot.Plant.push.__doc__.startswith("Pushes a link of the URDF")


def test_a_name_that_a_dict_has_not_is_told_with_those_that_it_has(world):
    recorded, stack = surefoot.read(world.log), surefoot.Stack("terrain_adaptation")
    near_feet, metric = r'there is no "XX"; valid are: LF, RF, LH, RH', r'there is no "duration"; .*closest: .*duration_s'
    for given, name, said in [
        (world.controller.dynamics.feet, "XX", near_feet), (world.controller.dynamics.contacts, "XX", near_feet), (world.controller.plan.feet, "XX", near_feet),
        (world.controller.state.slips, "XX", near_feet), (world.context.contacts, "XX", near_feet), (world.plant.truth.feet, "XX", near_feet),
        (world.result.metrics, "duration", metric), (recorded.metrics, "duration", metric), (recorded.channels, "state.p_WX.x", 'did you mean "state.p_WB.x"'),
        (world.controller.problem[0], "a", 'there is no "a"; .*valid are: .*A'), (surefoot.catalog()[0], "nam", 'did you mean "name"'),
        (surefoot.scenarios(), "walk_flt", 'did you mean "walk_flat"'), (world.scenario.drawn, "x", "it is empty"),
        (stack["com_xy"].tasks[0].parameters, "kq", 'valid are: kd, kp'), (recorded.criteria[0], "metrics", 'did you mean "metric"'),
    ]:  # fmt: skip
        with pytest.raises(KeyError, match=said):
            given[name]
        assert name not in given and given.get(name) is None


def test_an_object_among_the_settings_is_told_where_it_goes():
    with pytest.raises(surefoot.Error, match=r"set has a Stack; .*stack= take objects"):
        surefoot.load_scenario("walk_flat", set={"stack": surefoot.Stack("walk")})


ALL_THREE = [np.int64(3), np.uint8(3), np.array(3), np.float32(3), np.longdouble(3), np.array(3.0), fractions.Fraction(3)]


@pytest.mark.parametrize("number", ALL_THREE, ids=repr)
def test_whatever_acts_as_a_number_is_one(world, number):
    task = surefoot.tasks.ComXy(kp=number, weight=number)
    assert task == surefoot.tasks.ComXy(kp=3, weight=3) and repr(task).replace(".0", "") == "Task('com_xy', weight=3, kp=3)"
    assert world.stack.tune("com_xy", kp=number) == world.stack.tune("com_xy", kp=3)
    assert world.stack.weighted_from("com_xy", com_xy=number) == world.stack.weighted_from("com_xy", com_xy=3)
    assert surefoot.load_scenario("walk_flat", set={"duration": number}).duration == 3.0
    world.plant.push([0, number, 0], duration=number)
    user = surefoot.UserCommand(yaw_rate=number)
    user.height = number
    assert user.height == user.yaw_rate == 3.0


@pytest.mark.parametrize("number", ALL_THREE[:3], ids=repr)
def test_so_it_is_with_whole_numbers_and_truths(world, number):
    assert surefoot.load_scenario("walk_flat", seed=number).drawn == surefoot.load_scenario("walk_flat", seed=3).drawn
    run = functools.partial(surefoot.run, "walk_flat_ideal", set={"duration": 0.01})
    assert run(seed=number).torques_hash == run(seed=3).torques_hash
    assert world.stack[number] == world.stack[3] and surefoot.SensorReading(number).q.shape == (3,)
    user = surefoot.UserCommand(walk=np.float64(0.3) > 0.1, calibrate=np.False_)
    assert user.walk is True
    user.walk = np.array(False)
    assert user.walk is False
    levels = ({"A": [[1.0]], "b": [1.0]},)
    assert surefoot.solve(levels, certify=np.True_).verdict == "proven" and surefoot.HierarchicalSolver().solve(levels, x_ref=np.zeros(1)).x[0] == 1.0


def test_the_errors_say_what_they_are():
    kinds = [kind for kind in vars(surefoot).values() if isinstance(kind, type) and issubclass(kind, Exception)]
    assert {"Error", "FileError", "UnknownNameError", "WorldError"} <= {kind.__name__ for kind in kinds}
    assert all(issubclass(kind, surefoot.Error) and kind.__doc__ for kind in kinds)


def test_the_tasks_are_all_that_their_module_shows():
    assert dir(surefoot.tasks) == sorted(surefoot.tasks.__all__) and {"ComXy", "Posture"} <= {*dir(surefoot.tasks)}
