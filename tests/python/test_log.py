"""The official reader opens a log, whole or cut off, and finds in it what docs/log.md says."""

import io
import json
import math
import re
import struct
import subprocess
import sys

import pytest
from conftest import record
from log_file import attachment, messages, summary_of
from log_tools import TICKS
from mcap.exceptions import McapError
from mcap.reader import make_reader
from mcap.records import Channel, Message
from mcap.stream_reader import StreamReader
from program import ROOT

TOPICS = {"/readings", "/user", "/state", "/plan", "/model", "/hierarchy", "/command", "/health", "/truth", "/alignment", "/timings"}


def stream_messages(data):
    """Topic, time and bytes of all messages that a reader without an index gets."""
    topics, found = {}, []
    try:
        for item in StreamReader(io.BytesIO(data), validate_crcs=True).records:
            if isinstance(item, Channel):
                topics[item.id] = item.topic
            elif isinstance(item, Message):
                found.append((topics[item.channel_id], item.log_time, item.data))
    except (McapError, EOFError, struct.error):
        pass  # cut off: what came before counts
    return found


def conforms(schema, instance):
    """Whether a message is what its JSON schema says; knows the words that the log's schemas use."""
    kinds = {"object": dict, "array": list, "string": str, "boolean": bool, "integer": int,
             "number": (int, float), "null": type(None)}
    allowed = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    if not any(isinstance(instance, kinds[kind]) for kind in allowed):
        return False
    if "enum" in schema and instance not in schema["enum"]:
        return False
    if isinstance(instance, list):
        fits = schema.get("minItems", 0) <= len(instance) <= schema.get("maxItems", math.inf)
        return fits and all(conforms(schema["items"], element) for element in instance)
    if isinstance(instance, dict):
        known = schema["properties"]
        return known.keys() == instance.keys() and all(conforms(known[k], v) for k, v in instance.items())
    return True


def test_the_index_counts_every_topic(log):
    summary = summary_of(log)
    assert {channel.topic for channel in summary.channels.values()} == TOPICS
    assert set(summary.statistics.channel_message_counts.values()) == {TICKS}
    assert all(channel.message_encoding == "json" for channel in summary.channels.values())
    assert all(schema.encoding == "jsonschema" for schema in summary.schemas.values())


def test_readers_with_and_without_index_get_the_same_messages(log):
    with open(log, "rb") as file:
        reader = make_reader(file, validate_crcs=True)
        by_index = sorted((c.topic, m.log_time, m.data) for _, c, m in reader.iter_messages())
    streamed = stream_messages(log.read_bytes())
    assert len(streamed) == TICKS * len(TOPICS)
    assert by_index == sorted(streamed)


def test_every_message_is_what_its_schema_says_and_ticks_are_a_control_period_apart_on_every_topic(log):
    times = {topic: [] for topic in TOPICS}
    with open(log, "rb") as file:
        for schema, channel, message in make_reader(file).iter_messages():
            assert conforms(json.loads(schema.data), json.loads(message.data)), channel.topic
            times[channel.topic].append(message.log_time)
    assert times == dict.fromkeys(TOPICS, [2_500_000 * tick for tick in range(TICKS)])


def test_the_files_that_the_run_was_made_from_are_in_it(log):
    header = json.loads(attachment(log, "header.json"))
    assert header["scenario"] == "walk_flat_ideal"
    assert header["robot"]["name"] == "anymal_b"
    assert attachment(log, "model.xml").startswith(b"<mujoco")
    assert b"<robot" in attachment(log, "robot.urdf")
    assert attachment(log, "resolved_stack.yaml").count(b"- name:") == len(header["level_names"])
    for name in ["scenario.yaml", "stack.yaml", "robot.yaml"]:
        assert b"name:" in attachment(log, name) or b"description:" in attachment(log, name)
    summary = json.loads(attachment(log, "summary.json"))
    assert summary["metrics"]["duration_s"] == 2
    assert {criterion["metric"] for criterion in summary["criteria"]}


def test_the_metrics_of_the_summary_follow_from_the_messages(log):
    """Computed again from the log alone."""
    metrics = json.loads(attachment(log, "summary.json"))["metrics"]
    errors, step, before = [], 0.0, None
    for truth, plan, command in zip(messages(log, "/truth"), messages(log, "/plan"), messages(log, "/command")):
        errors.append(math.dist(truth["p_SCom"][:2], plan["com"]["p"]))
        if before is not None:
            step = max(step, max(abs(a - b) for a, b in zip(command["torque"], before)))
        before = command["torque"]
    assert metrics["com_error_max_m"] == pytest.approx(max(errors), rel=1e-12)
    rms = math.sqrt(sum(error**2 for error in errors) / len(errors))
    assert metrics["com_error_rms_m"] == pytest.approx(rms, rel=1e-9)
    assert metrics["torque_step_max_nm"] == pytest.approx(step, rel=1e-12)


def test_a_log_cut_off_in_the_middle_gives_all_whole_chunks(log):
    data = log.read_bytes()
    whole = stream_messages(data)
    for share in (0.2, 0.5, 0.8, 0.99):
        cut = stream_messages(data[: int(share * len(data))])
        assert cut == whole[: len(cut)]
        # At most one chunk is lost, and a chunk spans at most a second.
        assert len(cut) > share * len(whole) - 0.5 * TICKS * len(TOPICS)


def test_the_same_seed_gives_the_same_bytes_apart_from_the_timings(log, tmp_path):
    again = record(tmp_path / "again.mcap")
    first, second = log.read_bytes(), again.read_bytes()
    deterministic = [m for m in stream_messages(first) if m[0] != "/timings"]
    assert deterministic == [m for m in stream_messages(second) if m[0] != "/timings"]
    # The timings stand behind everything else: up to there the files are the same.
    chunks = summary_of(log).chunk_indexes
    end_of_ticks = max(c.chunk_start_offset + c.chunk_length for c in chunks if len(c.message_index_offsets) > 1)
    assert first[:end_of_ticks] == second[:end_of_ticks]


def test_another_seed_gives_other_readings(log, tmp_path):
    other = record(tmp_path / "other.mcap", "--seed", "12345")
    assert messages(log, "/readings") != messages(other, "/readings")


def test_every_field_has_a_description(log):
    made = subprocess.run([sys.executable, ROOT / "tools/log_fields.py", log], capture_output=True, text=True, check=True)
    assert all(f"## `{topic}`" in made.stdout for topic in TOPICS)
    assert not [line for line in made.stdout.splitlines() if line.startswith("- `") and line.endswith(": ")], "fields without a description"


def test_the_document_names_every_topic_and_every_attachment_once_in_its_table(log):
    text = (ROOT / "docs/log.md").read_text()
    for topic in TOPICS:
        assert len(re.findall(rf"^\| `{topic}` \|", text, re.MULTILINE)) == 1, topic
    with open(log, "rb") as file:
        for item in make_reader(file).iter_attachments():
            name = re.sub(r"\d+", "1", item.name)
            assert re.search(rf"^\| [^|]*`{name}`[^|]*\|", text, re.MULTILINE), item.name


def test_the_document_names_every_kind_of_change():
    written = {kind for folder in ("python", "server", "surefoot") for file in (ROOT / folder).rglob("*.cpp")
               for kind in re.findall(r'\.kind = "(\w+)"', file.read_text())}  # fmt: skip
    listed = re.search(r"### Changes by hand\n(.*?)\n## ", (ROOT / "docs/log.md").read_text(), re.DOTALL)[1]
    assert {"levels", "fault"} < written == set(re.findall(r"^- `(\w+)`:", listed, re.MULTILINE))
