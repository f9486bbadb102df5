"""Films and reports that runs ask Python for: nothing else depends on whether it can make them."""

import json
import os
import stat
import sys

import pytest
from conftest import SOURCE
from log_file import attachment
from program import surefoot


@pytest.fixture
def fake_python(tmp_path):
    """In the place of the Python that makes pictures; does as it is told. Many runs are not its work."""

    def made(script):
        path = tmp_path / "python"
        path.write_text(f'#!/bin/sh\n[ "$2" = surefoot_campaign.seeds ] && exec {sys.executable} "$@"\n{script}\n')
        path.chmod(path.stat().st_mode | stat.S_IEXEC)
        return path

    return made


def program(*arguments, python=None):
    environment = {key: value for key, value in os.environ.items() if key != "SUREFOOT_PYTHON"}
    if python is not None:
        environment["SUREFOOT_PYTHON"] = str(python)
    return surefoot(*arguments, env=environment)


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
    assert (done.returncode, done.stdout) == (2, "") and "the program was started without it" in done.stderr
    done = program(*SHORT, "--video", tmp_path / "no/run.mp4", python=sys.executable)
    assert done.returncode == 2 and "there is no folder" in done.stderr
    done = program(*SHORT, "--video", tmp_path / "run.avi", python=sys.executable)
    assert done.returncode == 2 and "run.avi: films are written as MP4" in done.stderr and not list(tmp_path.iterdir())


def test_a_report_that_fails_costs_no_result(tmp_path, fake_python):
    done = program(*SHORT, "--report", tmp_path / "out", python=fake_python("echo 'surefoot: no room' >&2; exit 2"))
    assert done.returncode == 2 and json.loads(done.stdout)["scenario"] == "walk_flat_ideal"
    log = tmp_path / "out/run.mcap"
    assert done.stderr.splitlines() == ["surefoot: no room", f"surefoot: the report was not written; surefoot report {log} --out {log.parent} tries again"]
    assert log.exists()


def test_a_report_that_can_not_be_made_is_told_before_the_run(tmp_path):
    for arguments in ([*SHORT, "--report", tmp_path / "out"], ["demo", "--out", tmp_path / "out"]):
        done = program(*arguments)
        assert (done.returncode, done.stdout) == (2, "") and "the program was started without it" in done.stderr and not (tmp_path / "out").exists()


def test_seeds_have_a_film_and_a_report_each(tmp_path, fake_python):
    python = fake_python('case $3 in video) printf film > "$6";; *) mkdir -p "$5"; echo "$@" > "$5/index.html";; esac')
    done = program(*SHORT, "--seeds", "2", "--video", tmp_path / "run.mp4", "--report", tmp_path / "out", python=python)
    assert done.returncode == 4, done.stderr
    assert sorted(path.name for path in tmp_path.glob("run*")) == ["run-seed1.mp4", "run-seed2.mp4"]
    for seed in (1, 2):
        page = tmp_path / f"out/seed{seed}/index.html"
        assert page.read_text() == f"-m surefoot_report {tmp_path}/out/run-seed{seed}.mcap --out {page.parent} --of-run\n"
