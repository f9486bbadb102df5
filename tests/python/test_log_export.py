"""`surefoot export`: what is in the tables is what is in the log, read by other people's readers; what it refuses."""

import json
import math
import pathlib
import re

import pyarrow.parquet
import pytest
from damaged_logs import of_version, plain_text, without_ticks
from log_file import messages, rows_of, summary_of
from log_tools import TICKS, complaint_of, exported
from program import of_json

JOINTS = [f"{leg}_{joint}" for leg in ("LF", "RF", "LH", "RH") for joint in ("HAA", "HFE", "KFE")]


def test_every_number_of_a_message_is_in_its_column_to_the_bit(log, table):
    row = 555
    assert table["time"].to_pylist() == [round(0.0025 * tick, 9) for tick in range(TICKS)], "as one writes them"
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
    assert messages(log, "/readings")[9]["foot_force"]["LF"] is None and table["readings.foot_force.LF"].null_count == TICKS, "not known is null"


def test_a_log_in_which_both_worlds_were_called_W_has_todays_names(log, table, tmp_path):
    old = of_version(log, tmp_path, "2.13")
    assert "p_WB" in messages(old, "/truth")[0] and "p_SB" not in messages(old, "/truth")[0]
    exported(old, "--parquet", tmp_path / "old.parquet")
    read = pyarrow.parquet.read_table(tmp_path / "old.parquet")
    assert read.column_names == table.column_names
    for name in ("truth.p_SB.x", "truth.q_SB.w", "truth.w_SB_B.z", "truth.p_SF.LH.z", "truth.v_SCom.y", "state.p_WB.x"):
        assert read[name].equals(table[name]) and read.schema.field(name).metadata == table.schema.field(name).metadata, name
    now, then = (of_json("explain", file, "--at", "1")["truth"] for file in (log, old))
    assert now == then and now["p_SB"] == messages(log, "/truth")[400]["p_SB"]


def test_levels_are_part_of_the_name(log, table):
    for row in (3, 700):
        for level in messages(log, "/hierarchy")[row]["levels"]:
            for key, value in level.items():
                if key != "name":
                    assert table[f"hierarchy.level.{level['name']}.{key}"][row].as_py() == value


def test_no_field_of_a_schema_is_forgotten(log, table):
    summary = summary_of(log)
    named = {name.rsplit(".", 1)[0] for name in table.column_names} | set(table.column_names)
    for channel in summary.channels.values():
        for field, part in json.loads(summary.schemas[channel.schema_id].data)["properties"].items():
            items = part.get("items", {}).get("type")
            if field == "time" or items == "object":
                continue
            full = f"{channel.topic[1:]}.{field}"
            if full == "plan.joints":  # empty, as no task of this run follows them
                continue
            assert any(name == full or name.startswith(full + ".") for name in named), full


def test_columns_say_their_unit_and_what_they_are(table):
    """What is said of all feet is said of each."""
    field = table.schema.field("state.v_WB.x")
    assert (field.metadata[b"unit"], field.metadata[b"about"]) == ("m/s".encode(), b"base velocity in W")
    assert json.loads(table.schema.metadata[b"surefoot"])["scenario"] == "walk_flat_ideal"
    feet = {"state.foot_force": "N", "state.slip_velocity": "m/s", "model.p_WF": "m", "model.force": "N", "truth.v_SF": "m/s"}
    assert {name: table.schema.field(f"{name}.LH.z").metadata[b"unit"].decode() for name in feet} == feet


def test_each_number_of_the_physics_has_its_own_unit(log, table):
    truth = messages(log, "/truth")[0]
    joints = len(truth["ctrl"])
    expected = {
        "qpos": ["m"] * 3 + [""] * 4 + ["rad"] * joints,
        "qvel": ["m/s"] * 3 + ["rad/s"] * (3 + joints),
        "ctrl": ["N·m"] * joints,
        "xfrc_applied": (["N"] * 3 + ["N·m"] * 3) * (len(truth["xfrc_applied"]) // 6),
    }
    for name, units in expected.items():
        columns = [field for field in table.schema if field.name.startswith(f"truth.{name}.")]
        assert [field.metadata[b"unit"].decode() for field in columns] == units, name
        assert len(columns) == len(truth[name]) > 0
        assert all(b"mjData." + name.encode() in field.metadata[b"about"] for field in columns)
    assert "numbers 6 k to 6 k + 5 are body k's" in table.schema.field("truth.xfrc_applied.6").metadata[b"about"].decode()


def test_a_levels_residual_has_the_unit_of_its_rows(log, table):
    header = json.loads(table.schema.metadata[b"surefoot"])
    units = dict(zip(header["level_names"], header["level_units"]))
    assert units["equations_of_motion"] == "N and N·m" and all(units.values())
    for level, unit in units.items():
        assert table.schema.field(f"hierarchy.level.{level}.residual").metadata[b"unit"] == unit.encode()


def test_what_each_level_took_is_a_column_with_its_unit(log, table):
    timings = messages(log, "/timings")
    assert table["timings.total"].to_pylist() == [timing["total"] for timing in timings], "though they stand behind all ticks"
    for place, level in enumerate(timings[0]["levels"]):
        name = f"timings.level.{level['name']}.solve"
        assert table[name].to_pylist() == [timing["levels"][place]["solve"] for timing in timings]
        assert table.schema.field(name).metadata[b"unit"] == "µs".encode()
    for timing in timings:
        known = [level["solve"] for level in timing["levels"] if level["solve"] is not None]
        assert known and all(time > 0 for time in known) and sum(known) <= timing["solve"] + 1e-3 * len(known)


def test_csv_reads_back_to_the_same_numbers_under_names_with_units(log, table, tmp_path):
    exported(log, "--csv", tmp_path / "run.csv", "--topics", "state", "/command", "--every", 7)
    rows = rows_of(tmp_path / "run.csv")
    assert len(rows) == math.ceil(TICKS / 7)
    units = [(field.name, field.metadata[b"unit"].decode()) for field in table.schema if re.match("time|state|command", field.name)]
    assert list(rows[0]) == [f"{name}[{unit}]" if unit else name for name, unit in units]
    assert {"time[s]", "command.torque.LF_KFE[N·m]", "state.q_WB.w", "command.mode"} <= rows[0].keys()
    for i in (0, 50):
        for column, text in rows[i].items():
            name = column.split("[")[0]
            value = table[name][7 * i].as_py()
            read = {"true": True, "false": False}.get(text, text) if isinstance(value, (bool, str)) else text and float(text)
            assert read == ("" if value is None else value), name


def test_what_is_no_log_is_refused_by_name(log, tmp_path):
    """In the words of `surefoot info`, but for one without ticks."""
    for file, words in {plain_text(tmp_path): "not an MCAP file", without_ticks(log, tmp_path): "holds no tick", tmp_path / "missing.mcap": "no such file"}.items():
        line = complaint_of("export", file, "--csv", tmp_path / "out")
        assert str(file) in line and words in line
        assert not (tmp_path / "out").exists() and not list(tmp_path.glob("*.partial"))


def test_wrong_arguments_are_said_with_what_would_be_valid(log, tmp_path):
    assert "--csv FILE, --parquet FILE or --foxglove" in complaint_of("export", log)
    assert 'did you mean "/plan"?' in complaint_of("export", log, "--csv", tmp_path / "a.csv", "--topics", "plann")
    assert "there is no folder" in complaint_of("export", log, "--csv", tmp_path / "no/a.csv")
    assert "is a folder" in complaint_of("export", log, "--csv", tmp_path)
    assert "are the same file" in complaint_of("export", log, "--csv", tmp_path / "a", "--parquet", tmp_path / "a")
    assert "--every" in complaint_of("export", log, "--csv", tmp_path / "a.csv", "--every", "0")
    assert 'did you mean "--topics"?' in complaint_of("export", log, "--topic", "plan")


@pytest.mark.parametrize("command", [("export", "--csv"), ("export", "--parquet"), ("export", "--foxglove"), ("video", "--out")])
def test_the_log_itself_is_never_written_over_nor_that_of_an_interrupted_run(log, tmp_path, command):
    (name, option), data = command, pathlib.Path(log).read_bytes()
    copy, cut = tmp_path / "copy.mcap", tmp_path / "run.mcap.partial"
    copy.write_bytes(data)
    (tmp_path / "link.mcap").symlink_to(copy)
    for written in (copy, tmp_path / "link.mcap"):
        assert "is the log itself" in complaint_of(name, copy, option, written)
    assert copy.read_bytes() == data
    if name == "export":
        cut.write_bytes(data)
        exported(cut, option, tmp_path / "run.mcap", "--topics", "command", "--every", 100)
        assert cut.read_bytes() == data
        assert sorted(path.name for path in tmp_path.iterdir()) == ["copy.mcap", "link.mcap", "run.mcap", cut.name]


def test_an_export_points_to_a_log_that_was_cut_off_beside_its_own(log, tmp_path):
    mine, cut = tmp_path / "run.mcap", tmp_path / "run.mcap.partial"
    cut.write_bytes(pathlib.Path(log).read_bytes())
    assert f"{cut}, of a run that goes on or was cut off, would be valid" in complaint_of("export", mine, "--csv", tmp_path / "out.csv")
