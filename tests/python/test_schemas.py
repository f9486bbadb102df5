"""The schemas that editors check files by agree with the program, held by a validator of JSON Schema."""

import copy
import json
import re

import jsonschema
import pytest
import yaml
from program import ROOT, complaint, surefoot

FOLDERS = {"scenario": "scenarios", "randomisation": "randomisations", "robot": "robots", "stack": "stacks", "gait": "gaits"}
FILES = [(kind, file) for kind, folder in FOLDERS.items() for file in sorted((ROOT / folder).glob("*.yaml"))]


class Loader(yaml.SafeLoader):
    """Numbers as YAML 1.2, the program and editors have them: 1e-3 is one."""


Loader.add_implicit_resolver("tag:yaml.org,2002:float", re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$"), list("-+.0123456789"))


@pytest.fixture(scope="module")
def validators():
    schemas = {kind: json.loads(surefoot("list", "schema", kind).stdout) for kind in FOLDERS}
    for schema in schemas.values():
        jsonschema.Draft202012Validator.check_schema(schema)
    return {kind: jsonschema.Draft202012Validator(schema) for kind, schema in schemas.items()}


def load(file):
    return yaml.load(file.read_text(), Loader)


@pytest.mark.parametrize("kind, file", FILES, ids=lambda value: getattr(value, "stem", value))
def test_a_file_that_ships_is_valid(kind, file, validators):
    assert [error.message for error in validators[kind].iter_errors(load(file))] == []


WRONG = ["planner: {swing: {apx: 0.1}}", "planner: {swing: {apex: -0.1}}", "planner: {torso: {max_tilt: 1.6}}", "planner: {stance: {knees: backwards}}",
         "planner: {gait: {order: [LF, RF, LH]}}", "actuators: {level: 3}", "sensors: {encoders: {offset: {LF_KFF: 0.1}}}",
         "sensors: {faults: {a: {sensor: gps, kind: nan, time: 1}}}", "terrain: {elements: {a: {shape: plane, size: [1, 1, 1]}}}",
         "terrain: {elements: {a: {shape: steps, height: 0.1, count: 0}}}", "tasks: {com_xy: {kq: 1}}", "tasks: {com_xy: {kp: -1}}", "criteria: {fel: false}",
         "user: [{walk: true}]", "stack_switches: [{time: -1, remove: [com_xy]}]", "randomise: {terrain.fricton: [0.4, 1.0]}",
         "randomise: {terrain.friction: [-0.4, 1.0]}", "randomise: {terrain.friction: [0.4]}"]  # fmt: skip


@pytest.mark.parametrize("text", WRONG)
def test_what_a_schema_refuses_in_a_scenario_the_program_refuses(text, validators, tmp_path):
    (tmp_path / "wrong.yaml").write_text(f"base: walk_flat\n{text}\n")
    assert not validators["scenario"].is_valid(load(tmp_path / "wrong.yaml"))
    assert "wrong.yaml:2" in complaint("run", str(tmp_path / "wrong.yaml"), "--check")


CHANGES = [
    ("robot", "anymal_b", lambda robot: robot["foot"].update(radius=-0.01)),
    ("robot", "anymal_b", lambda robot: robot["legs"]["LF"].update(knee="LF_KFE")),
    ("robot", "anymal_b", lambda robot: robot["foot"].pop("radius")),
    ("stack", "terrain_adaptation", lambda stack: stack["levels"][-1].update(wieght=1)),
    ("stack", "terrain_adaptation", lambda stack: stack["levels"][-1].update(task="torso")),
    ("stack", "terrain_adaptation", lambda stack: stack.update(levels=[])),
]


@pytest.mark.parametrize("kind, name, change", CHANGES)
def test_what_a_schema_refuses_in_a_robot_or_stack_the_program_refuses(kind, name, change, validators, tmp_path):
    tree = load(ROOT / FOLDERS[kind] / f"{name}.yaml")
    assert validators[kind].is_valid(copy.deepcopy(tree))
    change(tree)
    assert not validators[kind].is_valid(tree)
    (tmp_path / "wrong.yaml").write_text(yaml.safe_dump(tree))
    assert "wrong.yaml" in complaint("run", "walk_flat", "--check", "--set", f"{kind}={tmp_path / 'wrong.yaml'}")


def test_options_are_listed_by_the_beginning_of_their_keys():
    assert "planner.swing.apex " in surefoot("list", "options", "planner.swing").stdout
    (row,) = json.loads(surefoot("list", "options", "planner.com.leg_share", "--json").stdout)
    assert (row["default"], row["range"]) == ("0.76", "0.34 … 1")
    assert "begins with" in complaint("list", "options", "plannr")
    assert "scenario" in complaint("list", "schema", "scenarios")


def test_defaults_are_listed_with_the_robot_whose_they_are():
    assert surefoot("list", "tasks").stdout.startswith("Defaults of anymal_b;")
    of = {robot: json.loads(surefoot("list", "options", "planner.swing.reach_max", "--json", "--robot", robot).stdout)[0]["default"] for robot in ("anymal_b", "hyq")}
    assert float(of["hyq"]) > 1.2 * float(of["anymal_b"])
    assert "anymal_b" in complaint("list", "tasks", "--robot", "anymal_x")
