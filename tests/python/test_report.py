"""`surefoot report`: its page, its files, and logs that are not what they should be."""

import fcntl
import json
import os
import re
import subprocess
import sys
from unittest import mock

import pytest
from damaged_logs import cut, cut_at, damaged_at, of_version, plain_text, rewritten, steered, tick_chunks, without_ticks
from log_file import OPERATOR, attachment
from log_tools import complaint_of, log_command

from surefoot_campaign.errors import InputError  # isort: skip
from surefoot_report import report  # isort: skip

FIGURES = ["com_tracking", "terrain_adaptation", "estimate", "map", "events", "torques", "forces", "residuals", "active_limits", "tick_times"]


def page_of(log, folder, **options):
    return report.write_report(log, folder, with_pictures=False, **options).read_text()


# In place of what draws the figures, which takes most of the time.
NOT_DRAWN = {"saved": lambda figure, name: ("<svg></svg>", b""), "inline": lambda svg, name: name,
             **{part: [(name, lambda run: "figure", caption) for name, _, caption in getattr(report, part)] for part in ("MOTION", "FORCES", "LEVELS", "TIMES")}}


def words_of(log, folder, **options):
    """The page with empty images."""
    with mock.patch.multiple(report, **NOT_DRAWN):
        return page_of(log, folder, **options)


@pytest.fixture(scope="module")
def page(steps_down, tmp_path_factory):
    return page_of(steps_down, tmp_path_factory.mktemp("page"))


def with_header(log, folder, **parts):
    header = json.loads(attachment(log, "header.json"))
    return rewritten(log, folder / "header.mcap", attachments={"header.json": json.dumps(header | parts).encode()})


def with_summary(log, folder, reason, criteria=({"metric": "fell", "equals": False, "passed": True},)):
    summary = {"metrics": {"succeeded": True, "goal_reached": False, "reason": reason}, "criteria": list(criteria)}
    return rewritten(log, folder / "summary.mcap", attachments={"summary.json": json.dumps(summary).encode()})


def test_a_page_shows_all_figures_and_numbers_of_a_run(page):
    for text in ("<h1>step_down</h1>", "anymal_b", "seed 0", "com_error_max_m", "(a) COM, lateral", "(c) COM tracking error in the plane",
                 "(a) orientation error", "(b) height error", "LF hip–foot distance", "RH hip–foot distance", "limits 0.18 m (outside) and 0.535 m",
                 "x [m]", "torque [N·m]", "7  limb extension limits", "(a) tilt", "(c) position, drift", "(b) from the side", "ground at −0.14 m",
                 "touchdown", "time per tick [µs]", "period 2500 µs", "calibrates itself on the spot (0 to 9.5 s)", "amber: the limb limits act",
                 "amber: it searches for ground", "<pre>surefoot run", "2.5 ms, 400 Hz", "as it truly was", "What gave way to what"):  # fmt: skip
        assert text in page, text
    assert re.findall(r"<b>Figure (\d+)\.</b>", page) == [str(number) for number in range(1, len(FIGURES) + 1)]
    assert page.count('<svg class="plot"') == len(FIGURES) and "prefers-color-scheme: dark" in page and "stroke: var(--c0)" in page
    assert len(page) < 1_500_000


def test_a_page_needs_no_network_and_no_script(page):
    for text in ("http:", "https:", "//", "<script", "<link", "<img", "@import", "url(h", "src="):
        assert text not in page, text


def test_each_figure_is_an_svg_and_a_pdf_and_none_of_an_earlier_run_stays(steps_down, log, tmp_path):
    page, figures = page_of(steps_down, tmp_path), tmp_path / "figures"
    names = {f"{name}.{form}" for name in FIGURES for form in ("svg", "pdf")}
    assert {file.name for file in figures.iterdir()} == set(re.findall(r'href="figures/([^"]*)" download', page)) == names
    for name in FIGURES:
        svg = (figures / f"{name}.svg").read_text()
        assert "<svg" in svg and "var(" not in svg and (figures / f"{name}.pdf").read_bytes().startswith(b"%PDF")
    (figures / "mine.txt").write_text("stays")
    assert page_of(steps_down, tmp_path) == page
    page_of(log, tmp_path)  # of which the state is the truth
    assert {file.name for file in figures.iterdir()} == {"mine.txt"} | {name for name in names if not name.startswith(("estimate", "active_limits"))}
    assert {file.name for file in tmp_path.iterdir()} == {"index.html", "figures"}


def test_a_report_that_is_killed_half_way_mixes_no_two_runs(steps_down, log, tmp_path, monkeypatch):
    words_of(steps_down, tmp_path)
    figures = tmp_path / "figures"
    for old in figures.iterdir():
        old.write_text("old")
    moved, replace = [], os.replace

    def ended(*names):
        if len(moved) == 3:
            raise KeyboardInterrupt
        moved.append(names)
        replace(*names)

    monkeypatch.setattr(os, "replace", ended)
    with pytest.raises(KeyboardInterrupt):
        words_of(log, tmp_path)
    left = [file.read_text() for file in figures.iterdir()]
    assert len(left) == 3 and "old" not in left
    assert [file.name for file in tmp_path.iterdir()] == ["figures"]


def test_two_reports_at_once_into_a_folder_are_not_mixed(log, tmp_path):
    words_of(log, tmp_path)
    place = os.open(tmp_path, os.O_RDONLY)
    fcntl.flock(place, fcntl.LOCK_EX)
    with pytest.raises(InputError, match=f"{tmp_path}: is being written by another run"):
        words_of(log, tmp_path)
    assert (tmp_path / "index.html").exists()
    for folder in (tmp_path, tmp_path / "a/seed1"):  # by a run, whose lock it is
        assert words_of(log, folder, is_locked=True)
    os.close(place)


def test_what_is_no_log_is_refused_and_leaves_nothing(log, tmp_path):
    (tmp_path / "run.mcap.partial").write_bytes(b"x")
    files = {plain_text(tmp_path): "not an MCAP file", cut(log, tmp_path, 0.01): "cut off at byte",
             without_ticks(log, tmp_path): "holds no tick, so there is nothing to report",
             tmp_path / "run.mcap": "of a run that goes on or was cut off, would be valid"}  # fmt: skip
    for file, words in files.items():
        with pytest.raises(InputError) as refused:
            words_of(file, tmp_path / "a/b")
        assert words in str(refused.value) and str(file) in str(refused.value) and not (tmp_path / "a").exists()


def test_a_wrong_call_gives_one_line(log, tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(InputError, match="file/report: this folder can't be made"):
        words_of(log, tmp_path / "file/report")
    for arguments, words in {("run.mcap", "--out", ""): "the name is empty", ("run.mcap", "--out", "x"): "run.mcap: no such file",
                             (log,): "--out", (log, "--out", "x", "--piktures"): 'unknown argument "--piktures"'}.items():  # fmt: skip
        assert words in complaint_of(*arguments, package="surefoot_report")
    assert "surefoot report run.mcap --out out" in log_command("--help", package="surefoot_report").stdout


def test_what_is_lost_of_a_log_is_told(log, tmp_path):
    whole = words_of(log, tmp_path / "whole")
    assert "The log is not whole" not in whole and "goes on where this log ends" not in whole
    index = words_of(cut_at(log, tmp_path, log.stat().st_size - 20), tmp_path / "index")
    assert "only the index of the file is lost. This shows what could be read of it, to 2 s." in index and str(tmp_path) not in index
    half = words_of(cut(log, tmp_path, 0.5), tmp_path / "half")
    assert "The log is not whole" in half and "com tracking" in half and "goes on where this log ends" in half
    chunk = tick_chunks(log)[1]
    damaged = words_of(damaged_at(log, tmp_path, chunk.chunk_start_offset + chunk.chunk_length // 2), tmp_path / "damaged")
    assert "The log is not whole" in damaged and "may be missing here: the log is damaged" in damaged


def test_a_message_that_is_no_json_is_named(log, tmp_path):
    broken = rewritten(log, tmp_path / "broken.mcap", lambda channel, number, data: b"{" if (channel.topic, number) == ("/plan", 7) else data)
    with pytest.raises(InputError, match="a message on /plan is not what it should be"):
        words_of(broken, tmp_path / "out")


def test_an_older_log_is_shown_as_far_as_it_goes(log, tmp_path):
    lacks = {"/plan": {"calibration"}, "/hierarchy": {"blocked_by", "blocking_is_known", "missed"}, "/truth": {"xfrc_applied"}}
    page = words_of(of_version(log, tmp_path, "2.1", lacks), tmp_path / "old")
    assert "calibrates itself" not in page and "What gave way" not in page and "com tracking" in page


def test_a_log_without_truth_shows_what_the_controller_believed(log, tmp_path):
    page = page_of(rewritten(log, tmp_path / "belief.mcap", lambda channel, _, data: None if channel.topic == "/truth" else data), tmp_path / "out")
    assert "estimated COM" in page and "as the controller believed it" in page and "hip–foot distance" in page
    assert "(a) orientation error" not in page and "forces.svg" not in page and "true" not in re.findall(r">([^<]*)</text>", page)


def test_a_stack_without_limb_limits_and_a_ground_without_steps_promise_neither(log, tmp_path):
    header = json.loads(attachment(log, "header.json"))
    page = words_of(with_header(log, tmp_path, limb=header["limb"] | {"level": -1, "min": None, "max": None}, terrain=[]), tmp_path / "out")
    assert "this stack does not limit it" in page and "limits 0" not in page and "edges of the" not in page


def test_names_from_a_log_are_made_harmless(log, tmp_path):
    header = json.loads(attachment(log, "header.json"))
    levels = [*header["level_names"][:3], "<i>slanted</i>", *header["level_names"][4:]]
    page = page_of(with_header(log, tmp_path, scenario="<b>bold</b>", level_names=levels, drawn=[{"path": "<u>", "value": -0.05}]), tmp_path / "out")
    assert "<b>bold" not in page and "<i>" not in page and "<u>" not in page and "What the seed drew: 1 value<" in page and "−0.05" in page


def test_how_a_run_ended_stands_above_with_its_goal_and_what_went_wrong(log, tmp_path):
    header = json.loads(attachment(log, "header.json"))
    aims = with_header(log, tmp_path, options=header["options"] | {"goal": {"feet_beyond_x": 0.42}})

    def ended(reason, **criterion):
        criteria = [{"metric": "goal_reached", **criterion}] if criterion else [{"metric": "fell", "equals": False, "passed": True}]
        return words_of(with_summary(aims, tmp_path, reason, criteria), tmp_path / "out")

    page = ended("ran to its end")
    assert "✓ the criterion holds: fell" in page and "✗ goal not reached</div>" in page and "beyond x = 0.42 m" in page
    assert "not reached, as the criteria expect" in ended("ran to its end", equals=False, passed=True)
    missed = ended("ran to its end", equals=True, passed=False)
    assert "✗ 1 of 1 criterion missed: goal_reached</div>" in missed and "goal not reached" not in missed
    for reason in ("interrupted", "begun again"):
        cut_off = ended(reason)
        assert f'class="warning">The run was {reason} at 2 s' in cut_off and "(not judged)" in cut_off
        assert 'class="verdict' not in cut_off and "✓" not in cut_off


def test_a_run_that_was_steered_by_hand_is_told_beside_its_verdict_and_its_command(log, tmp_path):
    page = words_of(steered(log, tmp_path, OPERATOR), tmp_path / "out")
    assert "The run was steered by hand: 4 changes and pushes while it ran" in page[: page.index("<h2>")]
    assert "without what was changed and pushed by hand (4 times, on /changes)" in page
    assert "<li>0.5 s: the operator pushes base with 12 N·s to the left (120 N for 0.1 s)</li>" in page


def test_what_pushed_the_robot_is_told_with_its_time(log, tmp_path):
    def pushed(channel, number, data):
        """50 N to the left of a robot that looks along x, from 0.5 to 1 s: the truth of a tick has what acted in the step before it."""
        if channel.topic != "/truth" or not 200 < number <= 400:
            return data
        return data.replace(b'"xfrc_applied":[0,0,0,0,0,0,0,0,0,', b'"xfrc_applied":[0,0,0,0,0,0,0,50,0,')

    page = words_of(rewritten(log, tmp_path / "pushed.mcap", pushed), tmp_path / "out")
    assert re.search(r"<li>0.5 s: pushed by 50 N, 9\d° from ahead to the left, on the base</li>\n<li>1 s: the push on the base ends</li>", page)


SPEAKS = '{"times": [1.5, 2.25], "span": {"first": 1, "last": 2}, "notes": ["a note <b>"], "has_pushes": true}'


@pytest.fixture
def picture_maker(monkeypatch):
    """In the place of the process that makes pictures; does as it is told, in a shell with the folder as $1."""
    for name, value in NOT_DRAWN.items():
        monkeypatch.setattr(report, name, value)

    def made(script):
        run = subprocess.run

        def told(command, **options):
            return run(["sh", "-c", script, "sh", command[-1]] if "report-pictures" in command else command, **options)

        monkeypatch.setattr(subprocess, "run", told)

    return made


def test_pictures_stand_in_the_page_which_is_there_before_them(log, tmp_path, picture_maker):
    picture_maker(f"printf strip > $1/strip.jpg; printf clip > $1/clip.mp4; echo '{SPEAKS}'")
    early = []
    page = report.write_report(log, tmp_path, is_there=lambda path: early.append(path.read_text())).read_text()
    assert "They are being made" in early[0] and "<h2>Numbers</h2>" in early[0] and "data:video" not in early[0]
    assert "They are being made" not in page and "No pictures" not in page and page.index("<h2>Pictures</h2>") < page.index("<h2>Numbers</h2>")
    for text in ("data:image/jpeg;base64,c3RyaXA=", "data:video/mp4;base64,Y2xpcA==", "at 1.50 s, 2.25 s", "1.00 s to 2.00 s of the run", "a note &lt;b&gt;",
                 "the yellow arrow"):  # fmt: skip
        assert text in page


@pytest.mark.parametrize("script, words", {
    "echo 'surefoot: no renderer <here>' >&2; exit 2": "no renderer &lt;here&gt;",
    "exit 7": "their program ended with 7",
    "kill -9 $$": "their program ended with -9",
    "echo nonsense": "Expecting value",
}.items())  # fmt: skip
def test_a_report_without_pictures_is_whole_and_says_why(log, tmp_path, picture_maker, script, words):
    picture_maker(script)
    page = report.write_report(log, tmp_path).read_text()
    assert f"No pictures: {words}" in page and "<h2>Numbers</h2>" in page and 'class="pictures"' not in page


def test_a_page_that_finds_no_room_for_its_pictures_stays_without_and_says_why(log, tmp_path):
    """With a limit to the size of files that the page alone keeps."""
    script = f"""
import pathlib, resource, signal
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (2_000_000, resource.RLIM_INFINITY))
from surefoot_report import page, report
page.data_of = lambda file, kind: "c" * 3_000_000
report.make_pictures = lambda log, folder: page.Pictures(folder=pathlib.Path(folder), span={{"first": 0, "last": 1}})
report.write_report({str(log)!r}, {str(tmp_path / "out")!r})
"""
    subprocess.run([sys.executable, "-c", script], check=True)
    page = (tmp_path / "out/index.html").read_text()
    assert "No pictures: " in page and "can't be written" in page and "They are being made" not in page
