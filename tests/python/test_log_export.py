"""`surefoot export`: what is in the tables and in the scene is what is in the log, read by other people's readers."""

import csv
import json
import math
import pathlib
import re
import struct

import numpy as np
import pyarrow.parquet
import pytest
from damaged_logs import HEAD, bare_messages, cut, damaged_at, foreign, in_other_chunks, newer, plain_text, steered, tick_chunks, without_chunk, without_ticks
from foxglove_fields import FIELDS, bare, differences, schema_of
from log_file import OPERATOR, OPERATOR_TOLD, attachment, messages
from log_tools import complaint_of, log_command
from mcap.opcode import Opcode
from mcap.reader import NonSeekingReader, make_reader
from mcap.writer import CompressionType
from surefoot_campaign.errors import InputError
from surefoot_log import chunk
from surefoot_log.log_file import LogFile
from surefoot_log.table import Table

TICKS = 800
JOINTS = [f"{leg}_{joint}" for leg in ("LF", "RF", "LH", "RH") for joint in ("HAA", "HFE", "KFE")]


def exported(*arguments):
    result = log_command("export", *arguments)
    assert result.returncode == 0, result.stderr
    return result


@pytest.fixture(scope="module")
def table(log, tmp_path_factory):
    file = tmp_path_factory.mktemp("export") / "run.parquet"
    exported(log, "--parquet", file)
    return pyarrow.parquet.read_table(file)


def test_a_row_a_tick_with_its_time(table):
    assert table.num_rows == TICKS
    assert table["time"].to_pylist() == pytest.approx([0.0025 * tick for tick in range(TICKS)], abs=1e-12)


def test_every_number_of_a_message_is_in_its_column_to_the_bit(log, table):
    row = 555
    plan, state, truth = (messages(log, topic)[row] for topic in ("/plan", "/state", "/truth"))
    expected = {f"state.p_WB.{axis}": value for axis, value in zip("xyz", state["p_WB"])}
    expected |= {f"state.q_WB.{axis}": value for axis, value in zip("wxyz", state["q_WB"])}
    expected |= {f"state.qd.{joint}": value for joint, value in zip(JOINTS, state["qd"])}
    expected |= {f"plan.feet.LH.p_WF.{axis}": value for axis, value in zip("xyz", plan["feet"]["LH"]["p_WF"])}
    expected |= {f"plan.com.zmp.{axis}": value for axis, value in zip("xy", plan["com"]["zmp"])}
    expected |= {f"plan.R_WC.{i + 1}{j + 1}": plan["R_WC"][i][j] for i in range(3) for j in range(3)}
    expected |= {"plan.feet.RF.phase": plan["feet"]["RF"]["phase"], "truth.torso_contact": truth["torso_contact"]}
    expected |= {f"truth.qpos.{i}": value for i, value in enumerate(truth["qpos"])}
    for name, value in expected.items():
        assert table[name][row].as_py() == value, name


def test_levels_are_part_of_the_name(log, table):
    for row in (3, 700):
        for level in messages(log, "/hierarchy")[row]["levels"]:
            for key, value in level.items():
                if key != "name":
                    assert table[f"hierarchy.level.{level['name']}.{key}"][row].as_py() == value


def test_what_is_not_known_is_null(log, table):
    assert messages(log, "/readings")[9]["foot_force"]["LF"] is None
    assert table["readings.foot_force.LF"].null_count == TICKS


def test_no_field_of_a_schema_is_forgotten(log, table):
    with open(log, "rb") as file:
        summary = make_reader(file).get_summary()
    named = {name.rsplit(".", 1)[0] for name in table.column_names} | set(table.column_names)
    for channel in summary.channels.values():
        for field, part in json.loads(summary.schemas[channel.schema_id].data)["properties"].items():
            items = part.get("items", {}).get("type")
            if field == "time" or items == "object":
                continue
            full = f"{channel.topic[1:]}.{field}"
            assert any(name == full or name.startswith(full + ".") for name in named), full


def test_columns_say_their_unit_and_what_they_are(table):
    field = table.schema.field("state.v_WB.x")
    assert (field.metadata[b"unit"], field.metadata[b"about"]) == ("m/s".encode(), b"base velocity in W")
    assert json.loads(table.schema.metadata[b"surefoot"])["scenario"] == "walk_flat_ideal"


def test_what_is_said_of_all_feet_is_said_of_each(table):
    feet = {"state.foot_force": "N", "state.slip_velocity": "m/s", "model.p_WF": "m", "model.force": "N", "truth.v_WF": "m/s"}
    for name, unit in feet.items():
        metadata = table.schema.field(f"{name}.LH.z").metadata
        assert metadata[b"unit"].decode() == unit, name


def test_a_levels_residual_has_the_unit_of_its_rows(log, table):
    header = json.loads(table.schema.metadata[b"surefoot"])
    units = dict(zip(header["level_names"], header["level_units"]))
    assert units["equations_of_motion"] == "N and N·m" and all(units.values())
    for level, unit in units.items():
        assert table.schema.field(f"hierarchy.level.{level}.residual").metadata[b"unit"] == unit.encode()


def test_timings_which_stand_behind_all_ticks_are_in_their_rows(log, table):
    assert table["timings.total"].to_pylist() == [timing["total"] for timing in messages(log, "/timings")]


def test_what_each_level_took_is_a_column_with_its_unit(log, table):
    timings = messages(log, "/timings")
    for place, level in enumerate(timings[0]["levels"]):
        name = f"timings.level.{level['name']}.solve"
        assert table[name].to_pylist() == [timing["levels"][place]["solve"] for timing in timings]
        assert table.schema.field(name).metadata[b"unit"] == "µs".encode()
    for timing in timings:
        known = [level["solve"] for level in timing["levels"] if level["solve"] is not None]
        assert known and all(time > 0 for time in known) and sum(known) <= timing["solve"] + 1e-3 * len(known)


def test_csv_reads_back_to_the_same_numbers(log, table, tmp_path):
    exported(log, "--csv", tmp_path / "run.csv", "--topics", "state", "/command", "--every", 7)
    with open(tmp_path / "run.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == math.ceil(TICKS / 7)
    assert {re.split(r"[.\[]", name)[0] for name in rows[0]} == {"time", "state", "command"}
    for i in (0, 50):
        for column, text in rows[i].items():
            name = column.split("[")[0]
            value = table[name][7 * i].as_py()
            read = {"true": True, "false": False}.get(text, text) if isinstance(value, (bool, str)) else text and float(text)
            assert read == ("" if value is None else value), name


def test_csv_has_the_unit_of_each_column_behind_its_name(log, table, tmp_path):
    exported(log, "--csv", tmp_path / "run.csv", "--every", 400)
    with open(tmp_path / "run.csv", newline="", encoding="utf-8") as file:
        header = next(csv.reader(file))
    units = [(field.name, field.metadata[b"unit"].decode()) for field in table.schema]
    assert header == [f"{name}[{unit}]" if unit else name for name, unit in units]
    assert {"time[s]", "plan.com.p.x[m]", "command.torque.LF_KFE[N·m]", "state.q_WB.w", "plan.feet.LF.phase"} <= set(header)


@pytest.mark.parametrize("share", [0.3, 0.6, 0.9])
def test_of_a_log_that_was_cut_off_the_beginning_is_exported_with_a_warning(log, table, tmp_path, share):
    result = exported(cut(log, tmp_path, share), "--parquet", tmp_path / "cut.parquet", "--topics", "state")
    assert result.stderr.count(f"cut{share}.mcap: the log is not whole: cut off at byte") == 1
    part = pyarrow.parquet.read_table(tmp_path / "cut.parquet")
    assert 0 < part.num_rows < TICKS
    assert part.equals(table.select(part.column_names).slice(0, part.num_rows))


@pytest.fixture
def opened(monkeypatch):
    """The chunks that were decompressed so far, by the time at which they begin."""
    starts, real = [], chunk.opened
    monkeypatch.setattr(chunk, "opened", lambda record: starts.append(record.message_start_time) or real(record))
    return starts


def test_an_export_begins_without_reading_the_whole_log(log, opened):
    file = LogFile(log)
    everything = list(file.by_time())
    chunks = len(opened)
    for topics, most in (({"/state"}, 1), ({"/state", "/timings"}, 2), (None, 2)):
        opened.clear()
        time, first = next(file.by_time(topics))
        assert (time, len(opened)) == (0, most)
        assert {message.topic for message in first} == (topics or {message.topic for message in everything[0][1]})
    opened.clear()
    assert {topic: message.time for topic, message in file.first_messages().items()} == dict.fromkeys(file.topics(), 0)
    assert len(opened) == 2 < chunks


def test_an_unknown_topic_is_told_before_anything_is_read(log, opened):
    with pytest.raises(InputError, match='unknown topic "/plann"'):
        Table(LogFile(log), {"/plann"})
    assert opened == []


@pytest.mark.parametrize("number", [0, 3])
def test_of_a_damaged_log_all_but_the_damaged_chunk_is_exported(log, table, tmp_path, number):
    file, first, last = without_chunk(log, tmp_path, number)
    result = exported(file, "--parquet", tmp_path / "part.parquet", "--topics", "state", "timings")
    assert f"({first:.4f} s to {last:.4f} s); what stood there is lost, the rest was read" in result.stderr
    part = pyarrow.parquet.read_table(tmp_path / "part.parquet")
    times = part["time"].to_pylist()
    assert all(time < first + 0.003 or time > last - 0.003 for time in times) and (times[0] == 0) == (number != 0)
    rows = [round(time / 0.0025) for time in times]
    assert len(rows) == pytest.approx(TICKS - (last - first) / 0.0025, abs=2)
    assert part.equals(table.select(part.column_names).take(rows))


@pytest.mark.parametrize("byte", [0, 1, 2, 5])
def test_of_a_log_whose_chunk_has_a_damaged_head_the_rest_is_exported(log, table, tmp_path, byte):
    chunk = tick_chunks(log)[3]
    file = damaged_at(log, tmp_path, chunk.chunk_start_offset + byte)
    result = exported(file, "--parquet", tmp_path / "part.parquet", "--topics", "plan")
    assert ("a record's head is damaged" in result.stderr) == (byte != 0)
    if byte != 0:
        first, last = 1e-9 * chunk.message_start_time, 1e-9 * chunk.message_end_time
        assert f"({first:.4f} s to {last:.4f} s); what stood there is lost" in result.stderr
    part = pyarrow.parquet.read_table(tmp_path / "part.parquet")
    assert part.num_rows > TICKS - 100 and part["time"][-1].as_py() == table["time"][-1].as_py()


@pytest.mark.parametrize("options", [{"by_time": True}, {"by_time": False}, {"use_chunking": False}, {"by_time": False, "use_chunking": False},
                                     {"channels_first": True, "use_chunking": False}], ids=str)
def test_a_log_that_another_writer_wrote_anew_is_exported_whole(log, table, tmp_path, options):
    file = in_other_chunks(log, tmp_path, **options)
    exported(file, "--parquet", tmp_path / "again.parquet")
    assert pyarrow.parquet.read_table(tmp_path / "again.parquet").equals(table)


def times(log, topic):
    return [time for time, group in log.by_time() for message in group if message.topic == topic]


@pytest.mark.parametrize("channels_first", [False, True])
def test_a_log_without_chunks_has_its_timings_beside_its_ticks(log, tmp_path, channels_first):
    read = LogFile(in_other_chunks(log, tmp_path, channels_first=channels_first, use_chunking=False))
    assert times(read, "/timings") == times(LogFile(log), "/timings")


def test_a_damaged_message_outside_of_chunks_costs_that_message_alone(log, tmp_path):
    file = in_other_chunks(log, tmp_path, by_time=False, use_chunking=False)
    place = bare_messages(file, "/plan")[100]
    read, whole = LogFile(damaged_at(file, tmp_path, place + HEAD.size)), LogFile(log)
    plans = times(whole, "/plan")
    assert times(read, "/plan") == plans[:100] + plans[101:]
    for topic in ("/state", "/command", "/timings"):
        assert times(read, topic) == times(whole, topic)
    assert read.problem.startswith(f"a message's channel is unknown at byte {place} of ") and read.problem.count("at byte") == 1


def test_a_message_outside_of_chunks_that_is_too_short_costs_nothing_else(log, tmp_path):
    file = in_other_chunks(log, tmp_path, by_time=False, use_chunking=False)
    place, data = bare_messages(file, "/plan")[100], file.read_bytes()
    file.write_bytes(data[:place] + HEAD.pack(Opcode.MESSAGE, 12) + bytes(12) + data[place:])
    read = LogFile(file)
    assert times(read, "/plan") == times(LogFile(log), "/plan")
    assert f"a record is shorter than it says at byte {place} of " in read.problem


def test_what_stands_behind_a_last_chunk_with_a_damaged_head_is_read(log, tmp_path):
    with open(log, "rb") as file:
        last = max(chunk.chunk_start_offset for chunk in make_reader(file).get_summary().chunk_indexes)
    read = LogFile(damaged_at(log, tmp_path, last + 3))
    assert sum(message.topic == "/plan" for message in read.messages()) == TICKS
    assert read.attachments["summary.json"] == attachment(log, "summary.json")
    assert read.problem.startswith(f"a record's head is damaged at byte {last} of ") and "cut off" not in read.problem


def test_an_index_whose_checksum_is_wrong_is_not_followed(log, tmp_path):
    chunk = tick_chunks(log)[3]
    entry = log.read_bytes().rindex(struct.pack("<Q", chunk.chunk_start_offset) + struct.pack("<Q", chunk.chunk_length))
    read = LogFile(damaged_at(log, tmp_path, entry + 1))
    assert LogFile(log).topics() is not None and read.topics() is None
    first = {topic: message.time for topic, message in read.first_messages().items()}
    assert first == {topic: message.time for topic, message in LogFile(log).first_messages().items()}


def test_what_is_no_log_is_refused_by_name(log, tmp_path):
    out = tmp_path / "out.csv"
    (tmp_path / "empty").touch()
    for file, words in {
        plain_text(tmp_path): "not an MCAP file",
        foreign(tmp_path): "does not begin with a header of surefoot",
        cut(log, tmp_path, 0.0001): "before its header was whole",
        newer(log, tmp_path): f"log version 3.0; this program reads {json.loads(attachment(log, 'header.json'))['log_version']}.",
        without_ticks(log, tmp_path): "holds no tick",
        tmp_path / "empty": "the file is empty",
        tmp_path / "missing.mcap": "No such file",
        tmp_path: "is a folder",
    }.items():
        line = complaint_of("export", file, "--csv", out)
        assert str(file) in line and words in line
        assert not out.exists() and not list(tmp_path.glob("*.partial"))


def test_wrong_arguments_are_said_with_what_would_be_valid(log, tmp_path):
    assert "--csv FILE, --parquet FILE or --foxglove" in complaint_of("export", log)
    assert 'did you mean "/plan"?' in complaint_of("export", log, "--csv", tmp_path / "a.csv", "--topics", "plann")
    assert "there is no folder" in complaint_of("export", log, "--csv", tmp_path / "no/a.csv")
    assert "is a folder" in complaint_of("export", log, "--csv", tmp_path)
    assert "are the same file" in complaint_of("export", log, "--csv", tmp_path / "a", "--parquet", tmp_path / "a")
    assert "--every" in complaint_of("export", log, "--csv", tmp_path / "a.csv", "--every", "0")
    assert 'did you mean "--topics"?' in complaint_of("export", log, "--topic", "plan")


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


def test_events_tell_what_the_operator_did(log, tmp_path):
    exported(steered(log, tmp_path, OPERATOR), "--foxglove", tmp_path / "scene.mcap", "--topics", "user", "--every", 20)
    events = [message for message in in_file_order(tmp_path / "scene.mcap") if message[1].topic == "/events"]
    told = {round(1e-9 * message.log_time, 6): json.loads(message.data) for *_, message in events}
    assert {time: event["message"] for time, event in told.items() if event["name"] == "operator"} == OPERATOR_TOLD
    assert "planner" in {event["name"] for event in told.values()}


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
    assert used - {"world"} <= parents.keys()
    for frame in parents:
        chain = [frame]
        while chain[-1] in parents:
            chain.append(parents[chain[-1]])
            assert len(chain) <= len(parents) + 1
        assert chain[-1] == "world"


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
        X = {"world": np.eye(4)}
        for name in of:  # parents stand before their children
            X[name] = X[of[name]["parent_frame_id"]] @ matrix(of[name])
        for leg in ("LF", "RH"):
            centre = (X[f"{leg}_FOOT"] @ [0.0, 0.0, 0.02325, 1.0])[:3]
            assert centre == pytest.approx(truths[time]["p_WF"][leg], abs=1e-6)


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


@pytest.mark.parametrize("command", [("export", "--csv"), ("export", "--parquet"), ("export", "--foxglove"), ("video", "--out")])
def test_the_log_itself_is_never_written_over(log, tmp_path, command):
    name, option = command
    copy = tmp_path / "run.mcap"
    copy.write_bytes(pathlib.Path(log).read_bytes())
    (tmp_path / "link.mcap").symlink_to(copy)
    for written in (copy, tmp_path / "link.mcap"):
        assert "is the log itself" in complaint_of(name, copy, option, written)
    assert copy.read_bytes() == pathlib.Path(log).read_bytes()


def test_a_log_with_another_compression_is_refused_with_what_to_do(log, tmp_path):
    file = in_other_chunks(log, tmp_path, compression=CompressionType.LZ4)
    with pytest.raises(InputError, match="compressed with lz4; .* `mcap compress LOG -o NEW.mcap --compression zstd` rewrites it"):
        list(LogFile(file).messages())
