"""`surefoot export --foxglove`: the scene is that of the log, in the schemas that other programs read."""

import json
import math
from types import SimpleNamespace

import numpy as np
import pytest
from damaged_logs import steered
from foxglove_fields import FIELDS, bare, differences, schema_of
from log_file import OPERATOR, messages
from log_tools import TICKS, exported
from mcap.reader import NonSeekingReader, make_reader
from program import of_json
from surefoot_log.foxglove_events import Events


def in_file_order(path):
    with open(path, "rb") as file:
        yield from NonSeekingReader(file).iter_messages(log_time_order=False)


@pytest.fixture(scope="module")
def scene_file(log, tmp_path_factory):
    file = tmp_path_factory.mktemp("export") / "scene.mcap"
    exported(log, "--foxglove", file, "--topics", "command", "timings", "--every", 20)
    return file


@pytest.fixture(scope="module")
def scene(scene_file):
    """Messages of the scene by topic: time [ns] and content; and the schemas' names."""
    found, names = {}, {}
    with open(scene_file, "rb") as stream:
        for schema, channel, message in make_reader(stream, validate_crcs=True).iter_messages():
            found.setdefault(channel.topic, []).append((message.log_time, json.loads(message.data)))
            names[channel.topic] = (schema.name, schema.encoding, channel.message_encoding)
    return found, names


def test_the_scene_has_the_well_known_schemas(scene):
    found, names = scene
    assert names["/tf"] == ("foxglove.FrameTransforms", "jsonschema", "json")
    for topic in ("/scene/robot", "/scene/ground", "/scene/forces"):
        assert names[topic] == ("foxglove.SceneUpdate", "jsonschema", "json")
    assert len(found["/tf"]) == len(found["/scene/forces"]) == len(found["/command"]) == TICKS // 20
    assert len(found["/scene/robot"]) == len(found["/scene/ground"]) == 1


def test_messages_and_schemas_have_the_fields_of_the_published_schemas(scene_file):
    seen = set()
    for schema, channel, message in in_file_order(scene_file):
        if schema.name not in FIELDS:
            continue
        seen.add(schema.name)
        assert bare(json.loads(schema.data)) == schema_of(FIELDS[schema.name])
        assert differences(json.loads(message.data), FIELDS[schema.name], channel.topic) == []
    assert seen == set(FIELDS)


WARNING, ERROR = 3, 4


def test_events_are_those_of_info_and_no_change_is_left_out_however_few_ticks_are_copied(log, stopped, tmp_path):
    for file, by in ((steered(log, tmp_path, OPERATOR), {"planner", "operator", "run"}), (stopped, {"planner", "outside", "controller", "run"})):
        scene = tmp_path / f"scene_of_{file.name}"
        exported(file, "--foxglove", scene, "--every", 100)
        told = [(message.log_time, json.loads(message.data)) for _, channel, message in in_file_order(scene) if channel.topic == "/events"]
        assert all(event["timestamp"] == dict(zip(("sec", "nsec"), divmod(time, 10**9))) for time, event in told)
        events = of_json("info", file, "--events")["events"]
        texts = [f"{event['leg']}: {event['text']}" if event["leg"] else event["text"] for event in events]
        assert [(event["message"], event["name"]) for _, event in told] == [(text, event["by"]) for text, event in zip(texts, events)]
        assert [1e-9 * time for time, _ in told] == pytest.approx([event["time"] for event in events]) and {event["by"] for event in events} >= by
        changes = [change["text"] for change in messages(scene, "/changes")]
        assert changes == [change["text"] for change in OPERATOR if "operator" in by]
    (stop,) = [event for _, event in told if event["name"] == "controller"]
    assert stop["message"].startswith("command mode: ") and ", as " in stop["message"] and stop["level"] == WARNING


@pytest.mark.parametrize("summary, level", [(b'{"metrics": {"fell": true}}', ERROR), (b'{"metrics": {"fell": false}}', 2), (b'{"metrics": []}', 2),
                                            (b"[]", 2), (b"no", 2), (None, 2)])  # fmt: skip
def test_the_end_of_a_run_is_an_error_where_the_robot_fell(summary, level):
    written, log = [], SimpleNamespace(events=[{"time": 1.5, "text": "the run ended: so", "leg": None, "by": "run"}])
    events = Events(SimpleNamespace(write=lambda *message: written.append(message)), log, summary)
    events.write_until(1_499_999_999)
    assert written == []
    events.write_until(1_500_000_000)
    ((topic, _, _, time, message),) = written
    assert (topic, time, message["message"], message["level"]) == ("/events", 1_500_000_000, "the run ended: so", level)


def test_time_never_goes_back_in_the_scenes_file(scene_file):
    times = [message.log_time for *_, message in in_file_order(scene_file)]
    assert times == sorted(times) and times[-1] > 1.9e9


def test_what_messages_say_of_their_time_is_their_time(scene):
    for topic, transforms in (("/tf", "transforms"), ("/scene/forces", "entities")):
        for time, message in scene[0][topic]:
            assert {(part["timestamp"]["sec"], part["timestamp"]["nsec"]) for part in message[transforms]} == {divmod(time, 10**9)}


def test_every_frame_hangs_on_the_world(scene):
    parents = {transform["child_frame_id"]: transform["parent_frame_id"] for transform in scene[0]["/tf"][0][1]["transforms"]}
    used = {part["frame_id"] for topic in scene[0] if topic.startswith("/scene/") for _, message in scene[0][topic] for part in message["entities"]}
    assert used - {"S"} <= parents.keys()
    for frame in parents:
        chain = [frame]
        while chain[-1] in parents:
            chain.append(parents[chain[-1]])
            assert len(chain) <= len(parents) + 1
        assert chain[-1] == "S"


def test_what_vanishes_is_replaced_by_nothing(scene):
    """An entity stays until one of its name comes, so each message names all of them."""
    for _, message in scene[0]["/scene/forces"]:
        assert [part["id"] for part in message["entities"]] == ["forces", "pushes", "support polygon", "centre of mass"]
        assert all(part["lifetime"] == {"sec": 0, "nsec": 0} for part in message["entities"])


def matrix(transform):
    x, y, z, w = (transform["rotation"][key] for key in "xyzw")
    X = np.eye(4)
    X[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                 [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                 [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]  # fmt: skip
    X[:3, 3] = [transform["translation"][key] for key in "xyz"]
    return X


def test_the_frames_lead_to_where_the_feet_are_in_truth(log, scene):
    truths = {round(1e9 * truth["time"]): truth for truth in messages(log, "/truth")}
    for time, message in scene[0]["/tf"][::10]:
        of = {transform["child_frame_id"]: transform for transform in message["transforms"]}
        X = {"S": np.eye(4)}
        for name in of:  # parents stand before their children
            X[name] = X[of[name]["parent_frame_id"]] @ matrix(of[name])
        for leg in ("LF", "RH"):
            centre = (X[f"{leg}_FOOT"] @ [0.0, 0.0, 0.02325, 1.0])[:3]
            assert centre == pytest.approx(truths[time]["p_SF"][leg], abs=1e-6)


def test_what_the_controller_plans_has_a_frame_of_its_own_in_the_scene(log, scene):
    models, truths = ({round(1e9 * one["time"]): one for one in messages(log, topic)} for topic in ("/state", "/truth"))
    for time, message in scene[0]["/tf"][::10]:
        X_SW = matrix(next(one for one in message["transforms"] if one["child_frame_id"] == "W"))
        assert (X_SW @ [*models[time]["p_WB"], 1.0])[:3] == pytest.approx(truths[time]["p_SB"], abs=5e-3)


def test_arrows_stand_on_the_feet_and_are_as_long_as_their_force(log, scene):
    truths = {round(1e9 * truth["time"]): truth for truth in messages(log, "/truth")}
    time, message = scene[0]["/scene/forces"][20]
    arrows = next(part for part in message["entities"] if part["id"] == "forces")["arrows"]
    loaded = [foot for foot in truths[time]["feet"].values() if math.hypot(*foot["force"]) > 5.0]
    assert len(arrows) == len(loaded) > 2
    for arrow, foot in zip(arrows, loaded):
        assert [arrow["pose"]["position"][axis] for axis in "xyz"] == foot["point"]
        assert arrow["shaft_length"] + arrow["head_length"] == pytest.approx(0.0022 * math.hypot(*foot["force"]))


def test_every_entity_of_the_robot_is_fixed_to_a_frame_that_is_sent(scene):
    found, _ = scene
    frames = {transform["child_frame_id"] for transform in found["/tf"][0][1]["transforms"]}
    robot = found["/scene/robot"][0][1]["entities"]
    assert len(robot) > 12
    assert all(part["frame_locked"] and part["frame_id"] in frames for part in robot)
    triangles = [piece for part in robot for piece in part["triangles"]]
    assert triangles and all(max(piece["indices"]) < len(piece["points"]) for piece in triangles)
