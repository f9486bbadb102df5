"""surefoot.campaign(): what it does and says differently from the command."""

import json
import signal
import subprocess
import sys
import threading
import time

import pytest

import surefoot
from campaign_folder import FAKE
from program import ROOT

TWO_SEEDS = {"name": "short", "scenario": "fake", "seeds": [1, 2]}


@pytest.fixture(autouse=True)
def log(tmp_path, monkeypatch):
    """Of the runs of a program that answers at once."""
    monkeypatch.setenv("SUREFOOT_PROGRAM", str(FAKE))
    monkeypatch.setenv("FAKE_LOG", str(tmp_path / "log"))
    return tmp_path / "log"


def test_a_campaign_may_run_in_any_thread(tmp_path):
    found = []
    thread = threading.Thread(target=lambda: found.append(surefoot.campaign(TWO_SEEDS, out=tmp_path / "out", jobs=1)))
    thread.start()
    thread.join()
    assert found[0].table.num_rows == 2


def test_what_other_threads_print_meanwhile_is_seen(tmp_path, capsys):
    printing, done = threading.Event(), threading.Event()

    def prints():
        while not done.is_set():
            print("still here")
            printing.set()
            time.sleep(0.01)

    thread = threading.Thread(target=prints)
    thread.start()
    assert printing.wait(10)
    capsys.readouterr()
    surefoot.campaign(TWO_SEEDS | {"set": {"mode": "slow"}}, out=tmp_path / "out", jobs=1)
    during = capsys.readouterr().out
    done.set()
    thread.join()
    assert during.count("still here") > 0 and set(during.split("\n")) == {"still here", ""}


def test_notes_of_a_campaign_and_what_broke_are_with_its_results_and_not_on_stderr(tmp_path, log, capfd):
    spec = TWO_SEEDS | {"set": {"noted": 1, "mode": "refuse", "broken_seed": 2}}
    told = "1 of 2 runs crashed, took too long or were refused; retry=True makes them again"
    assert surefoot.campaign(spec, out=tmp_path / "out", jobs=1).notes == ["fake: a note", told]
    assert len(log.read_text().splitlines()) == 2
    assert surefoot.campaign(spec, out=tmp_path / "out", jobs=1).notes == ["fake: a note", told]
    assert len(log.read_text().splitlines()) == 2
    found = surefoot.campaign(spec, out=tmp_path / "out", jobs=1, retry=True)
    assert [json.loads(line)[1] for line in log.read_text().splitlines()] == [1, 2, 2] and found.table.num_rows == 2
    out, err = capfd.readouterr()
    assert out == "" and "retry" not in err and "campaign.yaml" not in err and "done already" not in err
    assert surefoot.campaign(TWO_SEEDS, out=tmp_path / "other", jobs=1).notes == []


def test_runs_that_are_ended_from_outside_are_an_error_and_no_ctrl_c(tmp_path):
    spec = TWO_SEEDS | {"set": {"mode": "interrupted", "broken_seed": 2}}
    with pytest.raises(surefoot.Error, match="1 runs were ended from outside; 1 of 2 runs are finished and kept in .*out: the same call goes on there"):
        surefoot.campaign(spec, out=tmp_path / "out", jobs=1)


SCRIPT = """
import signal, sys, surefoot
if sys.argv[2:]:
    signal.signal(signal.SIGTERM, lambda *_: print("asked to end"))
surefoot.campaign({"scenario": "fake", "seeds": [1, 2], "set": {"mode": "hang", "broken_seed": 2}}, out=sys.argv[1], jobs=1)
"""


@pytest.mark.parametrize("number, words, status, said", [
    (signal.SIGINT, [], -signal.SIGINT, "KeyboardInterrupt: 1 of 2 runs are finished and kept in "),
    (signal.SIGTERM, [], -signal.SIGTERM, ""),
    (signal.SIGTERM, ["handled"], 1, "surefoot._core.Error: interrupted; 1 of 2 runs are finished and kept in "),
])  # fmt: skip
def test_a_process_that_is_asked_to_end_does_so_after_it_has_kept_the_results(tmp_path, number, words, status, said):
    started, command = tmp_path / "pids", [sys.executable, "-c", SCRIPT, tmp_path / "out", *words]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=ROOT)
    while not started.exists():
        assert process.poll() is None
        time.sleep(0.02)
    process.send_signal(number)
    out, err = process.communicate(timeout=60)
    assert process.returncode == status and said in (err.strip().splitlines() or [""])[-1] and "--retry" not in err and "to go on" not in err, err
    assert out == "asked to end\n" * len(words)
    assert len((tmp_path / "out/rows.jsonl").read_text().splitlines()) == 1
