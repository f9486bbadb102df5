import os
import pathlib
import signal
import subprocess
import sys

import pytest

from browser import Browser
from live_page import LONG, WALK, Served
from log_tools import exported
from program import PROGRAM

# A shell's background jobs ignore ^C, and so would all programs that they start.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

SOURCE = pathlib.Path(__file__).resolve().parents[2]
# As the launcher does.
os.environ.setdefault("SUREFOOT_PYTHON", sys.executable)
os.environ.setdefault("SUREFOOT_PROGRAM", PROGRAM)
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [str(SOURCE / "build/release/python"), os.environ.get("PYTHONPATH")]))


def pytest_collection_modifyitems(items):
    """Files that drive a browser run by themselves. What drives it is tried twice (decision 0020); the summary names those that needed it."""
    driving = {item for item in items if "browser" in item.fixturenames}
    files = {item.path for item in driving}
    for item in items:
        if item.path in files:
            item.add_marker(pytest.mark.browser)
        if item in driving:
            item.add_marker(pytest.mark.flaky(reruns=1))


MOST_RERUNS = 3  # of a run: more are no chance


def reruns(config):
    return len(config.pluginmanager.get_plugin("terminalreporter").stats.get("rerun", []))


def pytest_sessionfinish(session):
    if reruns(session.config) > MOST_RERUNS:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter, config):
    if reruns(config) > MOST_RERUNS:
        terminalreporter.write_line(f"{reruns(config)} tests had to be tried twice, more than {MOST_RERUNS}: the run counts as failed.")


def record(path, *arguments, scenario="walk_flat_ideal", duration=2):
    """Runs two seconds of the flat walk, long enough for a step, or another scenario, and records it."""
    command = [PROGRAM, "run", str(SOURCE / "scenarios" / f"{scenario}.yaml"), "--set", f"duration={duration}",
               "--record", str(path), "--json", *arguments]
    run = subprocess.run(command, capture_output=True, text=True)
    # 4: so short a run is not judged by the criteria of the whole walk.
    assert run.returncode in (0, 1, 4), run.stderr
    return path


@pytest.fixture(scope="session")
def browser():
    """Debian's chromium, with one page that the tests share."""
    with Browser() as browser:
        yield browser


@pytest.fixture(scope="session")
def log(tmp_path_factory):
    """A recorded run."""
    return record(tmp_path_factory.mktemp("log") / "walk.mcap")


@pytest.fixture(scope="session")
def steps_down(tmp_path_factory):
    """A recorded run on sensors that calibrates, walks, and searches for the ground below a step."""
    return record(tmp_path_factory.mktemp("log") / "step.mcap", scenario="step_down", duration=15)


# So hard that the controller takes its sensors for faulty.
HIT = ["--set", "disturbances.pushes.lateral.time=0.5", "--set", "disturbances.pushes.lateral.force.y=400"]


@pytest.fixture(scope="session")
def stopped(tmp_path_factory):
    """A recorded run whose controller stopped for safety."""
    return record(tmp_path_factory.mktemp("log") / "stopped.mcap", *HIT, scenario="push", duration=6)


@pytest.fixture(scope="session")
def table(log, tmp_path_factory):
    """The log as a table."""
    import pyarrow.parquet

    file = tmp_path_factory.mktemp("export") / "run.parquet"
    exported(log, "--parquet", file)
    return pyarrow.parquet.read_table(file)


@pytest.fixture(scope="module")
def live():
    """A walk that goes on, for pages in a browser."""
    with Served(*WALK) as served:
        yield served


@pytest.fixture(scope="module")
def run():
    """A walk that goes on, watched by pages without a browser."""
    with Served("run", "walk_flat", "--view", *LONG) as served:
        yield served
