"""`surefoot info`, `explain` and `replay` as their user sees them; and logs that are not what they should be."""

import itertools
import json
import re

import pytest
from damaged_logs import HEAD, attachment_place, bare_messages, cut, cut_at, damaged, damaged_at, first_topic, foreign, in_other_chunks, newer, of_version, plain_text, steered, tick_chunks, timings_chunk, without_calls, without_chunk, without_ticks, written
from live_page import Served
from log_file import OPERATOR, OPERATOR_TOLD, attachment, messages
from mcap.reader import make_reader
from mcap.writer import CompressionType
from program import answer, complaint, of_json, surefoot

COMMANDS = {"info": [], "explain": ["--at", 0.5], "replay": ["--verify"]}
SHOWN = ("replay", "--port", 0)


def raw_bytes(path, topic):
    with open(path, "rb") as file:
        return sum(len(message.data) for _, _, message in make_reader(file).iter_messages(topics=[topic]))


def test_info_says_which_run_it_was_and_counts_every_topic(log):
    found = of_json("info", log)
    assert (found["scenario"], found["seed"], found["ticks"], found["whole"]) == ("walk_flat_ideal", 0, 800, True)
    assert {topic["messages"] for topic in found["topics"].values()} == {800}
    for topic in ("/plan", "/truth"):
        assert found["topics"][topic]["bytes"] == raw_bytes(log, topic)
    assert found["attachments"]["model.xml"] > 1000 and found["summary"]["metrics"]["duration_s"] == 2
    text = answer("info", log)
    assert "whole" in text.splitlines()[0] and "800 ticks of 2.5 ms" in text
    assert "not judged, too short: " in text


@pytest.mark.parametrize("share", [0.3, 0.95])
def test_info_of_a_log_that_was_cut_off_says_so_and_shows_what_is_there(log, tmp_path, share):
    file = cut(log, tmp_path, share)
    found = of_json("info", file)
    assert not found["whole"] and "cut off at byte" in found["problem"] and found["summary"] is None
    assert 0 < found["ticks"] <= 800
    text = answer("info", file)
    assert "not whole" in text and "the log has no summary" in text and "that run goes on where this log ends" in text


def test_explain_gives_the_messages_of_the_nearest_tick(log):
    found = of_json("explain", log, "--at", 0.7491)
    assert found["time"] == 0.75
    for topic in ("readings", "health", "user", "state", "plan", "model", "command", "truth"):
        assert found[topic] == messages(log, f"/{topic}")[300], topic


def test_explain_says_in_a_sentence_what_gave_way_to_what(log):
    for tick, hierarchy in list(enumerate(messages(log, "/hierarchy")))[100::150]:
        found = of_json("explain", log, "--at", 0.0025 * tick)
        expected = [level["name"] for level in hierarchy["levels"] if level["residual"] > 1e-6]
        assert [level["level"] for level in found["gave_way"]] == expected
        content = {name for name in expected if not name.endswith("_minimisation")}
        assert all(f"{name} gave way by " in found["sentence"] for name in content)
        assert content or found["sentence"].startswith("Every level got what it asked for")
        assert found["costs_are_exact"] and "estimates" not in found["sentence"]


def exact_costs(level):
    """Of a level of `solve --explain --json`: rows of higher levels with their costs, dearest first."""
    rows = [(by["name"], row["row"], row["cost"]) for by in level["blocked_by"] for row in by["rows"]]
    return sorted((row for row in rows if row[2] > 0), key=lambda row: -row[2])


def test_costs_that_explain_tells_are_those_that_the_solver_explains_of_that_tick(log, tmp_path):
    facts = set()
    for tick in range(250, 800, 150):
        time = 0.0025 * tick
        (tmp_path / "tick.jsonl").write_text(surefoot("dump", log, "--from", time, "--to", time + 0.001).stdout)
        (line,) = surefoot("solve", tmp_path / "tick.jsonl", "--explain", "--json").stdout.splitlines()
        levels = {level["name"]: level for level in json.loads(line)["levels"]}
        for level in of_json("explain", log, "--at", time)["gave_way"]:
            told = [(row["level"], row["row"], row["cost"]) for row in level["to"]]
            expected = exact_costs(levels[level["level"]])
            assert sorted(row[:2] for row in told) == sorted(row[:2] for row in expected)
            costs = [row[2] for row in told]
            assert sorted(costs) == pytest.approx(sorted(row[2] for row in expected), rel=1e-6)
            assert all(one >= 0.9 * next_one for one, next_one in itertools.pairwise(costs)), "dearest first, but for digits that nobody reads"
            facts |= {row[0] for row in told} & {"no_contact_motion", "equations_of_motion"}
    assert facts, "the log names no row of those"


def test_explain_shows_feet_levels_limits_and_the_events_around(log):
    lift_off = next(plan["time"] for plan in messages(log, "/plan") if any(event["event"] == 1 for event in plan["events"]))
    text = answer("explain", log, "--at", lift_off)
    assert re.search(r"\+0\.0000 s  \w\w: lift-off", text)
    assert re.search(r"^foot +phase +normal force", text, re.MULTILINE)
    for words in ("motion", "sensors are good", "largest torque", "base in W", "truth in S"):
        assert words in text
    assert len(re.findall(r"^(?:LF|RF|LH|RH) ", text, re.MULTILINE)) == 4


def test_explain_tells_what_the_operator_did(log, tmp_path):
    file = steered(log, tmp_path, OPERATOR)
    found = of_json("explain", file, "--at", 1)
    assert {event["time"]: event["text"] for event in found["events"] if event["by"] == "operator"} == OPERATOR_TOLD
    assert [event["time"] for event in found["events"]] == sorted(event["time"] for event in found["events"])
    text = answer("explain", file, "--at", 0.52)
    assert "0.5000 s  -0.0200 s  the operator pushes base with 12 N·s to the left (120 N for 0.1 s)" in text
    assert "by the operator" not in answer("explain", file, "--at", 1.9)


def test_explain_names_the_limits_that_act_and_only_these(log):
    words = {-1: ", at its lower bound", 1: ", at its upper bound", -3: ", beyond its lower bound", 3: ", beyond its upper bound"}
    hierarchies = messages(log, "/hierarchy")
    some, none = (next(tick for tick, h in enumerate(hierarchies) if bool(h["active"]) == wanted) for wanted in (True, False))
    text = answer("explain", log, "--at", 0.0025 * some)
    shown = text.split("Limits that act:\n")[1].split("Events")[0].splitlines()
    assert shown == [f"  {row['level']} {row['row']}{words[row['state']]}" for row in hierarchies[some]["active"]]
    assert "No limit acts." in answer("explain", log, "--at", 0.0025 * none)


def test_explain_gives_the_last_tick_for_the_end_of_the_duration_and_says_so(log):
    found = of_json("explain", log, "--at", 2)
    assert (found["asked"], found["time"]) == (2, 1.9975)
    assert "The log ends before 2 s: this is its last tick." in answer("explain", log, "--at", 2)
    assert "last tick" not in answer("explain", log, "--at", 1.9975)


def test_explain_tells_the_range_of_a_log_that_has_no_such_tick(log, tmp_path):
    assert "no tick at 7 s; the log goes from 0 s to 1.9975 s" in complaint("explain", log, "--at", 7)
    assert "no tick at -1 s" in complaint("explain", log, "--at", -1)
    assert "no tick at 2.01 s" in complaint("explain", log, "--at", 2.01)
    line = complaint("explain", cut(log, tmp_path, 0.5), "--at", 1.99)
    assert "the log goes from 0 s to " in line and "cut off at byte" in line
    assert "--at" in complaint("explain", log) and "--at" in complaint("explain", log, "--at", "soon")
    assert "--at is not a time" in complaint("explain", log, "--at", "nan")
    assert '"" is not a time' in complaint("explain", log, "--at", "")


def test_explain_and_verify_work_on_what_is_there_of_a_log_that_was_cut_off(log, tmp_path):
    file = cut(log, tmp_path, 0.7)
    assert of_json("explain", file, "--at", 0.2)["time"] == 0.2
    found = of_json("replay", file, "--verify", status=4)
    assert found["same"] is None and 0 < found["ticks"] < 800 and "cut off at byte" in found["problem"]
    text = answer("replay", file, "--verify", status=4)
    assert "so far every torque is the same" in text and "The log is not whole" in text
    assert "What the run had after its last tick here could not be compared" in text


@pytest.mark.parametrize("number", [0, 3, -1])
def test_info_counts_and_names_what_a_damaged_chunk_took(log, tmp_path, number):
    file, first, last = without_chunk(log, tmp_path, number)
    found = of_json("info", file)
    (place,) = found["lost"]["places"]
    assert place["why"] in ("the checksum of a chunk is wrong", "a chunk can't be decompressed")
    assert (place["first_time"], place["last_time"]) == pytest.approx((first, last))
    assert found["ticks"] + found["lost"]["ticks"] == 800 and found["lost"]["ticks"] >= round((last - first) / 0.0025)
    assert found["summary"] is not None and not found["whole"]
    text = answer("info", file)
    assert "goes on" not in text, "the log's end is there"
    assert re.search(rf"^lost +{found['lost']['ticks']} ticks, in 1 place of the file", text, re.MULTILINE)
    assert f"at byte {place['offset']} of " in text and f"({first:.4f} s to {last:.4f} s)" in text


@pytest.mark.parametrize("number", [0, 3])
def test_explain_goes_on_behind_a_damaged_chunk(log, tmp_path, number):
    file, first, last = without_chunk(log, tmp_path, number)
    for topic in ("readings", "plan", "command", "truth"):
        assert of_json("explain", file, "--at", last + 0.1)[topic] == of_json("explain", log, "--at", last + 0.1)[topic], topic
    assert "The log is not whole" in answer("explain", file, "--at", last + 0.1)
    line = complaint("explain", file, "--at", (first + last) / 2)
    assert "at byte" in line and ("where no tick can be read" in line or number == 0)


def test_explain_makes_no_tick_of_the_rest_of_one_that_is_lost(log, tmp_path):
    """Chunks end within ticks: what stands of one behind the damage is no whole tick."""
    ends = [1e-9 * chunk.message_end_time for chunk in tick_chunks(log)]
    starts = [1e-9 * chunk.message_start_time for chunk in tick_chunks(log)]
    after = [first_topic(log, chunk) for chunk in tick_chunks(log)]
    cut = next(i for i in range(1, len(ends) - 1)
               if ends[i] == starts[i + 1] and after[i + 1] not in ("/truth", "/alignment"))  # in a tick that both chunks have a part of  # fmt: skip
    for number, end in [(cut, 2), (cut + 1, 1)]:
        found = without_chunk(log, tmp_path, number)
        assert f"no tick at {found[end]:.6g} s, where no tick can be read" in complaint("explain", found[0], "--at", found[end])


@pytest.mark.parametrize("number", [0, 3, -1])
def test_verify_never_says_same_of_what_it_could_not_compare(log, tmp_path, number):
    file, first, last = without_chunk(log, tmp_path, number)
    found = of_json("replay", file, "--verify", status=4)
    assert found["same"] is None and not found["all_compared"] and found["different_ticks"] == 0
    assert found["ticks"] == pytest.approx(first / 0.0025, abs=1)
    text = answer("replay", file, "--verify", status=4)
    assert "at byte" in text and ("so far every torque is the same" in text) == (number != 0)
    assert ("What the run had after its last tick here could not be compared" in text) == (number == -1)
    if number == -1:
        assert "ticks from then on)" not in text
        return
    gap = found["gap"]
    assert gap["to"] == pytest.approx(last, abs=0.003)
    assert gap["ticks_behind"] == pytest.approx((1.9975 - last) / 0.0025, abs=1.1) and f"({gap['ticks_behind']} ticks from then on)" in text


def test_verify_says_of_a_log_that_is_not_whole_but_has_all_ticks_that_all_are_the_same(log, tmp_path):
    for file, words in {
        damaged_at(log, tmp_path, timings_chunk(log)): "at byte",
        cut_at(log, tmp_path, log.stat().st_size - 1): "only the index of the file is lost",
        cut_at(log, tmp_path, attachment_place(log, "summary.json")): "what came behind it is lost",
    }.items():
        found = of_json("replay", file, "--verify", status=4)
        assert found["same"] is True and found["all_compared"] and found["ticks"] == 800 and words in found["problem"], file
        text = answer("replay", file, "--verify", status=4)
        assert "every torque is the same to the bit.\nAll of its ticks were compared.\nThe log is not whole: " in text
        assert text.count(str(file)) == 1, "a file is named once"


def test_a_clock_that_begins_late_or_skips_in_a_whole_log_is_told_and_nothing_is_called_lost(log, tmp_path):
    file = without_calls(log, tmp_path, 0, 400)
    found = of_json("info", file)
    assert found["whole"] and "lost" not in found and found["ticks"] == 799
    assert found["clock"] == {"begin": 0, "skips": 1, "first_skip": pytest.approx([0.9975, 1.0025])}
    words = "The clock goes from 0.9975 s to 1.0025 s without a tick between: nothing is lost there, the controller was not called."
    assert words in answer("info", file)
    assert "where the clock skips: the controller was not called" in complaint("explain", file, "--at", 1)
    # The run's own controller was called there, so that it gives other torques behind it; all of them are compared.
    result = surefoot("replay", file, "--verify")
    assert result.returncode in (0, 1) and words in result.stdout and "799 ticks" in result.stdout and "not compared" not in result.stdout
    late = of_json("info", without_calls(log, tmp_path, 200, -1))
    assert late["whole"] and late["clock"] == {"begin": 0.5, "skips": 0}
    assert "The clock begins at 0.5000 s; nothing before it is lost." in answer("info", tmp_path / "skips.mcap")


def test_replay_says_in_the_terminal_what_its_log_lacks(log, tmp_path):
    damaged_log, first, last = without_chunk(log, tmp_path, 3)
    cut_log = cut(log, tmp_path, 0.6)
    byte = re.search(r"cut off at byte (\d+)", of_json("info", cut_log)["problem"])[1]
    for file, words in {
        log: "",
        cut_log: f"warning: the log was never closed, or is cut off (at byte {byte}): what is left of it is shown",
        damaged_log: f"{first:.4f} s to {last:.4f} s can't be read",
        damaged_at(log, tmp_path, tick_chunks(log)[3].chunk_start_offset + 1): "1 piece of the log can't be read",
    }.items():
        with Served("replay", file) as served:
            served.session(lambda session: words in served.errors and session["summarised"] == session["ticks"])
            assert served.end() == 0
        assert words in served.errors and ("warning" in served.errors) == (file != log), served.errors


def test_another_stack_is_asked_up_to_the_first_tick_that_is_lost(log, tmp_path):
    file, first, _ = without_chunk(log, tmp_path, 3)
    assert of_json("replay", file, "--stack", "regular")["ticks"] == pytest.approx(first / 0.0025, abs=1)
    assert f"({found_behind(file)} ticks from then on)" in answer("replay", file, "--stack", "regular")
    line = complaint("replay", without_chunk(log, tmp_path, 0)[0], "--stack", "regular")
    assert "its first ticks are lost" in line


def found_behind(file):
    return of_json("replay", file, "--stack", "regular")["gap"]["ticks_behind"]


@pytest.mark.parametrize("command", [*((name, *words) for name, words in COMMANDS.items()), SHOWN])
def test_what_is_no_log_is_refused_in_one_line_that_names_it(log, tmp_path, command):
    (tmp_path / "empty").touch()
    for file, words in {
        plain_text(tmp_path): "not an MCAP file",
        foreign(tmp_path): "does not begin with a header of surefoot",
        cut(log, tmp_path, 0.0001): "before its header was whole",
        newer(log, tmp_path): "log version 4.0; this program reads 2.x and 3.x",
        tmp_path / "empty": "the file is empty",
        tmp_path / "missing.mcap": "no such file",
        tmp_path: "is a folder",
    }.items():
        line = complaint(command[0], file, *command[1:])
        assert str(file) in line and words in line


def test_info_says_which_version_a_log_has_and_that_a_newer_one_may_have_more(log, tmp_path):
    now = of_json("info", log)["log_version"]
    assert f"log version {now}" in answer("info", log) and "is passed over" not in answer("info", log)
    assert "is passed over" not in answer("info", of_version(log, tmp_path, "2.1"))
    told = answer("info", of_version(log, tmp_path, "3.99"))
    assert "log version 3.99\n" in told and f"this program knows version {now}: what is new since then is passed over" in told


@pytest.mark.parametrize("make", [cut, damaged])
@pytest.mark.parametrize("command", COMMANDS)
def test_no_damage_ends_a_command_otherwise_than_with_an_answer_or_one_line(log, tmp_path, command, make):
    for share in (0.0001, 0.01, 0.5, 0.8, 0.9999):
        result = surefoot(command, make(log, tmp_path, share), *COMMANDS[command])
        assert result.returncode in (0, 1, 2, 4), result
        assert result.returncode != 2 or len(result.stderr.strip().splitlines()) == 1


@pytest.mark.parametrize("command", [("info",), ("explain", "--at", 0), ("replay", "--verify")])
def test_a_damaged_header_is_told_in_words_with_what_can_still_be_done(log, tmp_path, command):
    """The header as a whole, which has a checksum, and one that was made without."""
    other = written(tmp_path / "other.mcap", {"header.json": attachment(log, "header.json")[:-50]})
    for file, words in {
        damaged_at(log, tmp_path, attachment_place(log, "header.json") + 200): "the checksum of the attachment header.json is wrong at byte",
        other: "its header.json, which says what run it is, is damaged at its byte",
    }.items():
        line = complaint(command[0], file, *command[1:], cwd=tmp_path)
        assert line.count(str(file)) == 1 and words in line and "can be read by other readers of MCAP" in line
        assert "exception" not in line and "parse" not in line


@pytest.mark.parametrize("command", [("explain", "--at", 0), ("replay",), ("replay", "--verify")])
def test_of_a_log_that_is_cut_off_before_its_first_tick_that_is_said(log, tmp_path, command):
    file = cut(log, tmp_path, 0.01)
    line = complaint(command[0], file, *command[1:], cwd=tmp_path)
    assert line.count(str(file)) == 1 and "cut off" in line


def test_a_log_without_ticks_has_nothing_to_explain_or_to_run_again(log, tmp_path):
    file = without_ticks(log, tmp_path)
    assert "holds no tick" in complaint("explain", file, "--at", 0)
    line = complaint("replay", file, "--verify")
    assert str(file) in line and "the log has no attachment resolved_stack.yaml" in line
    assert "no tick" in answer("info", file)


@pytest.mark.parametrize("command", COMMANDS)
def test_a_log_with_another_compression_is_refused_with_what_to_do(log, tmp_path, command):
    file = in_other_chunks(log, tmp_path, compression=CompressionType.LZ4)
    said = complaint(command, file, *COMMANDS[command])
    assert f"{file}: its chunks are compressed with lz4; chunks with zstd or without compression would be valid" in said
    assert "`mcap compress LOG -o NEW.mcap --compression zstd`" in said


def test_a_damaged_message_without_chunks_costs_explain_no_timing_beside_it(log, tmp_path):
    file = in_other_chunks(log, tmp_path, by_time=False, use_chunking=False)
    place = bare_messages(file, "/timings")[302]
    asked = ["--at", 0.75]
    found = of_json("explain", damaged_at(file, tmp_path, place + HEAD.size), *asked)
    assert found["levels"] == of_json("explain", log, *asked)["levels"]


@pytest.mark.parametrize("options", [{"compression": CompressionType.NONE}, {"use_chunking": False}], ids=str)
def test_a_log_without_compression_or_without_chunks_is_the_same_run(log, tmp_path, options):
    file = in_other_chunks(log, tmp_path, by_time=False, **options)
    for arguments in (["--verify"], ["--stack", "regular"]):
        same, again = (of_json("replay", one, *arguments) for one in (log, file))
        assert {**again, "log": same["log"]} == same
    assert of_json("explain", file, "--at", 0.75)["plan"] == of_json("explain", log, "--at", 0.75)["plan"]


def test_info_lists_the_events_that_explain_tells_around_its_ticks(log, tmp_path):
    file = steered(log, tmp_path, OPERATOR)
    told = of_json("info", file, "--events")["events"]
    assert {event["by"] for event in told} >= {"planner", "operator", "run"}
    for at in (0.5, 1.5, 1.9975):
        # Forces are told as they are sought: the operator's pushes are in no truth of this log.
        near, around = ([event for event in events if abs(event["time"] - at) < 0.95 and event["by"] != "outside"]
                        for events in (told, of_json("explain", file, "--at", at)["events"]))  # fmt: skip
        assert near == around
    assert "   0.5000 s  the operator pushes base with 12 N·s to the left (120 N for 0.1 s)\n" in answer("info", file, "--events")
    assert "events" not in of_json("info", file)


def test_mend_writes_what_can_be_read_as_a_log_that_is_whole(log, tmp_path):
    file, first, last = without_chunk(log, tmp_path, 3)
    lost = of_json("info", file)
    assert answer("mend", file, "--out", tmp_path / "mended.mcap") == lost["problem"] + "\n"
    mended = of_json("info", tmp_path / "mended.mcap")
    assert mended["whole"] and (mended["ticks"], mended["topics"].keys()) == (lost["ticks"], lost["topics"].keys())
    assert messages(tmp_path / "mended.mcap", "/plan")[-1] == messages(log, "/plan")[-1]
    assert answer("mend", log, "--out", tmp_path / "again.mcap") == "it was whole\n"
    assert "is the log itself" in complaint("mend", log, "--out", log)
    assert "not an MCAP file" in complaint("mend", plain_text(tmp_path), "--out", tmp_path / "none.mcap") and not (tmp_path / "none.mcap").exists()
