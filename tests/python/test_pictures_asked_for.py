"""Pictures that reports and runs ask another program for: nothing else depends on whether it can make them."""

import json
import os
import re
import stat
import subprocess
import sys

import pytest
from conftest import SOURCE
from log_file import attachment
from program import PROGRAM


@pytest.fixture
def fake_python(tmp_path):
    """In the place of the Python that makes pictures; does as it is told."""

    def made(script):
        path = tmp_path / "python"
        path.write_text(f"#!/bin/sh\n{script}\n")
        path.chmod(path.stat().st_mode | stat.S_IEXEC)
        return path

    return made


def program(*arguments, python=None):
    environment = {key: value for key, value in os.environ.items() if key != "SUREFOOT_PYTHON"}
    if python is not None:
        environment["SUREFOOT_PYTHON"] = str(python)
    return subprocess.run([PROGRAM, *map(str, arguments)], env=environment, capture_output=True, text=True, timeout=300)


SPEAKS = """echo '{"times": [1.5], "span": {"first": 1, "last": 2}, "notes": ["a note"], "has_pushes": false}'"""


def test_a_report_holds_the_pictures_that_were_made(log, tmp_path, fake_python):
    python = fake_python(f'printf strip > "$5/strip.jpg"; printf clip > "$5/clip.mp4"; {SPEAKS}')
    done = program("report", log, "--out", tmp_path / "out", python=python)
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "out/index.html").read_text()
    assert "data:image/jpeg;base64,c3RyaXA=" in page and "data:video/mp4;base64,Y2xpcA==" in page
    assert "a note" in page and "No pictures" not in page


@pytest.mark.parametrize("script, words", {
    "echo 'surefoot: no renderer here' >&2; exit 2": "no renderer here",
    "exit 7": "their program ended with 7",
    "kill -9 $$": "their program ended with -1",
    "echo nonsense": "parse error",
}.items())  # fmt: skip
def test_a_report_without_pictures_is_whole_and_says_why(log, tmp_path, fake_python, script, words):
    done = program("report", log, "--out", tmp_path / "out", python=fake_python(script))
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "out/index.html").read_text()
    assert re.search(f"No pictures: [^<]*{words}", page) and "<h2>Numbers</h2>" in page


def test_a_report_is_there_before_its_pictures_and_says_that_they_come(log, tmp_path, fake_python):
    page = tmp_path / "out/index.html"
    pictures = f'printf strip > "$5/strip.jpg"; printf clip > "$5/clip.mp4"; {SPEAKS}'
    python = fake_python(f'cp "{page}" "{tmp_path}/early.html"; {pictures}')
    done = program("report", log, "--out", page.parent, python=python)
    assert (done.returncode, done.stdout) == (0, f"{page}\n"), done.stderr
    assert f"{page} can be opened; its pictures are being made" in done.stderr
    early, late = (tmp_path / "early.html").read_text(), page.read_text()
    assert "They are being made" in early and "<h2>Numbers</h2>" in early and "data:video" not in early
    assert "They are being made" not in late and "data:video" in late


def test_where_the_program_ends_before_the_pictures_the_report_is_there(log, tmp_path, fake_python):
    done = program("report", log, "--out", tmp_path / "out", python=fake_python("kill -9 $PPID"))
    assert done.returncode == -9
    page = (tmp_path / "out/index.html").read_text()
    assert "They are being made" in page and "<h2>Hierarchy</h2>" in page


def test_without_the_launcher_the_report_says_who_makes_pictures(log, tmp_path):
    assert program("report", log, "--out", tmp_path / "out").returncode == 0
    assert "No pictures: the program was started without its launcher" in (tmp_path / "out/index.html").read_text()


SHORT = ["run", SOURCE / "scenarios/walk_flat_ideal.yaml", "--set", "duration=0.1", "--json"]


def test_a_run_is_filmed_and_its_result_is_the_same(tmp_path, fake_python):
    python = fake_python(f'[ "$3" = video ] && cp "$4" "{tmp_path}/seen.mcap" && printf film > "$6"')
    plain, filmed = program(*SHORT), program(*SHORT, "--video", tmp_path / "run.mp4", python=python)
    assert filmed.returncode == plain.returncode and (tmp_path / "run.mp4").read_text() == "film"
    by_clock = {"tick_us", "solve_us", "realtime_factor"}
    results = [{key: value for key, value in json.loads(text).items() if key not in by_clock} for text in (plain.stdout, filmed.stdout)]
    assert results[0] == results[1]
    assert json.loads(attachment(tmp_path / "seen.mcap", "header.json"))["scenario"] == "walk_flat_ideal"


def test_a_film_that_fails_changes_no_exit_code(tmp_path, fake_python):
    failed = program(*SHORT, "--video", tmp_path / "run.mp4", python=fake_python("exit 2"))
    assert failed.returncode == program(*SHORT).returncode and json.loads(failed.stdout)["scenario"] == "walk_flat_ideal"
    assert "run.mp4 was not filmed; --record FILE keeps the log" in failed.stderr
    failed = program(*SHORT, "--video", tmp_path / "run.mp4", "--record", tmp_path / "run.mcap", python=fake_python("exit 2"))
    assert f"was not filmed; surefoot video {tmp_path}/run.mcap --out {tmp_path}/run.mp4 tries again" in failed.stderr


def test_a_film_that_can_not_be_made_is_told_before_the_run(tmp_path):
    done = program(*SHORT, "--video", tmp_path / "run.mp4")
    assert (done.returncode, done.stdout) == (2, "") and "started without its launcher" in done.stderr
    done = program(*SHORT, "--video", tmp_path / "no/run.mp4", python=sys.executable)
    assert done.returncode == 2 and "there is no folder" in done.stderr
    done = program(*SHORT, "--video", tmp_path / "run.avi", python=sys.executable)
    assert done.returncode == 2 and "run.avi: films are written as MP4" in done.stderr and not list(tmp_path.iterdir())


def test_seeds_have_a_film_each(tmp_path, fake_python):
    python = fake_python('printf film > "$6"')
    done = program(*SHORT, "--seeds", "2", "--video", tmp_path / "run.mp4", python=python)
    assert done.returncode in (0, 1), done.stderr
    assert sorted(path.name for path in tmp_path.glob("*.mp4")) == ["run-seed1.mp4", "run-seed2.mp4"]
    assert not list(tmp_path.glob("*.mcap"))
