"""What an interrupt leaves behind: whole logs and results, or nothing."""

import json
import pathlib
import re
import signal
import subprocess
import time

import pytest

from log_file import messages
from program import PROGRAM, complaint

LONG = ["--set", "duration=1000"]


def interrupt(*arguments, after=1.5, which=signal.SIGINT, words=None):
    """After a time, or as soon as a line on stderr begins with these words."""
    process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if words is None:
        time.sleep(after)
    else:
        next(line for line in process.stderr if line.startswith(words))
    process.send_signal(which)
    out, err = process.communicate(timeout=120)
    return process.returncode, out, err


@pytest.mark.parametrize("which", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupt_closes_the_log_and_leaves_no_results(tmp_path, which):
    log = tmp_path / "run.mcap"
    earlier_results(tmp_path, "out/index.html")
    code, out, err = interrupt("run", "walk_flat", "--json", "--record", log, "--report", tmp_path / "out", *LONG, which=which)
    assert (code, out) == (2, "")
    assert [line for line in err.splitlines() if line.startswith("surefoot: ")] == err.splitlines()[-1:]
    partial = pathlib.Path(f"{log}.partial")
    assert "interrupted" in err and str(partial) in err
    assert not log.exists()
    assert len(messages(partial, "/command")) > 10
    assert list((tmp_path / "out").iterdir()) == []


def earlier_results(folder, *names):
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("of an earlier run")


def left_of(folder):
    """Files that still are of an earlier run."""
    files = [file for file in folder.rglob("*") if file.is_file() and file.read_bytes() == b"of an earlier run"]
    return sorted(str(file.relative_to(folder)) for file in files)


@pytest.mark.parametrize("arguments, outdated, others", [
    (["run", "walk_flat", *LONG, "--report"], ["index.html", "run.mcap"], ["notes.txt"]),
    (["run", "walk_flat", "--seeds", 3, *LONG, "--report"], ["seed1/index.html", "seed3/index.html", "run-seed3.mcap"], ["seed4/index.html"]),
    (["demo", "--out"], ["index.html", "walk_flat/index.html", "push/index.html", "push/run.mcap"], ["notes.txt"])])  # fmt: skip
def test_an_interrupt_leaves_no_page_of_an_earlier_run_beside_a_new_log(tmp_path, arguments, outdated, others):
    earlier_results(tmp_path, *outdated, *others)
    interrupt(*arguments, tmp_path)
    assert left_of(tmp_path) == others


def test_a_wrong_scenario_leaves_an_earlier_report_as_it_is(tmp_path):
    earlier_results(tmp_path, "index.html", "run.mcap", "seed1/index.html", "run-seed1.mcap")
    before = left_of(tmp_path)
    for wrong in [["--set", "duration=never"], ["--set", "period=0.0007"]]:
        complaint("run", "walk_flat", "--report", tmp_path, *wrong)
        complaint("run", "walk_flat", "--report", tmp_path, "--seeds", 2, *wrong)
    complaint("run", "walk_flat", "--report", tmp_path / "new", "--set", "duration=never")
    assert left_of(tmp_path) == before
    assert not (tmp_path / "new").exists()


def test_a_log_with_a_name_of_its_own_is_kept_until_the_new_one_is_whole(tmp_path):
    earlier_results(tmp_path, "run.mcap")
    interrupt("run", "walk_flat", *LONG, "--record", tmp_path / "run.mcap", "--report", tmp_path, which=signal.SIGKILL)
    assert left_of(tmp_path) == ["run.mcap"]


def test_an_interrupt_of_several_seeds_ends_all_of_them(tmp_path):
    code, out, err = interrupt("run", "walk_flat", "--json", "--seeds", 8, "--jobs", 2, *LONG, which=signal.SIGTERM)
    assert (code, out) == (2, "")
    assert err.strip().splitlines()[-1].startswith("surefoot: interrupted")


@pytest.mark.parametrize("arguments", [[], ["--seeds", 2, "--jobs", 2]])
def test_an_interrupt_leaves_no_report_folder_that_was_made_for_nothing(tmp_path, arguments):
    folder = tmp_path / "out"
    code, _, err = interrupt("run", "walk_flat", *arguments, "--report", folder, "--record", tmp_path / "run.mcap", *LONG)
    assert code == 2 and not folder.exists()
    left = sorted(file.name for file in tmp_path.iterdir())
    assert left and all(name.endswith(".mcap.partial") for name in left)
    assert all(name in err.splitlines()[-1] for name in left)


def test_an_interrupt_shows_the_seeds_that_are_finished_and_no_cut_log_looks_whole(tmp_path):
    run = ["run", "walk_flat_sea", "--seeds", 100, "--jobs", 2, "--json", "--set", "duration=2", "judged_after=2", "--record", tmp_path / "m.mcap"]
    code, out, err = interrupt(*run, words="seed ")
    assert code == 2
    result = json.loads(out)
    finished = {run["seed"] for run in result["runs"]}
    assert result["interrupted"] and 0 < len(finished) < 100
    assert not any(run["reason"] == "interrupted" for run in result["runs"])
    assert result["rates"]["succeeded"]["trials"] == len(finished)
    message = err.splitlines()[-1]
    assert f"interrupted: {len(finished)} of 100 seeds are finished" in message
    whole = {f"m-seed{seed}.mcap" for seed in finished}
    left = {file.name for file in tmp_path.iterdir()}
    assert whole <= left
    cut = left - whole
    assert all(name.endswith(".partial") and name in message for name in cut)


def test_an_interrupted_demo_leaves_whole_experiments_and_their_index(tmp_path):
    out = tmp_path / "demo"
    code, printed, err = interrupt("demo", "--out", out, "--seeds", 1, "--jobs", 2, words="step_down: ")
    assert code == 2 and "experiments are whole" in err.splitlines()[-1]
    folders = {entry.name for entry in out.iterdir() if entry.is_dir()}
    index = (out / "index.html").read_text()
    assert "step_down" in folders and "interrupted" in index
    for folder in folders:
        assert f'href="{folder}/index.html"' in index and (out / folder / "index.html").exists()
        assert {file.name for file in (out / folder).iterdir()} == {"index.html", "run.mcap", "figures"}
    assert set(re.findall(r'href="([^"]*)"', index)) == {f"{folder}/index.html" for folder in folders} and len(folders) < 15


def test_a_demo_interrupted_at_once_leaves_nothing(tmp_path):
    code, printed, err = interrupt("demo", "--out", tmp_path / "demo", after=0.5)
    assert code == 2 and printed == ""
    assert not (tmp_path / "demo").exists()
