"""What bin/surefoot and ./demo do before the program starts, on a tree with a ninja of ours."""

import contextlib
import fcntl
import hashlib
import os
import shutil
import subprocess

import pytest
from program import ROOT


def found_in(tree):
    """The environment in which its ninja is found."""
    return {**os.environ, "PATH": f"{tree}/bin:{os.environ['PATH']}"}


@pytest.fixture
def build_program(tmp_path):
    """Sets a tree up that was built before, and builds it again by a ninja that prints what is given."""
    (tmp_path / "tools").mkdir()
    shutil.copy(ROOT / "tools/setup.sh", tmp_path / "tools")
    for folder in ["dependencies", "cmake", "surefoot", "server", "cli", ".venv", "bin", "build/release/bin"]:
        (tmp_path / folder).mkdir(parents=True)
    for file in ["CMakeLists.txt", "CMakePresets.json", "tools/layers.toml", ".venv/dependencies.stamp"]:
        (tmp_path / file).touch()
    build = tmp_path / "build/release"
    (build / "build.ninja").touch()
    (build / "CMakeCache.txt").write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={tmp_path}\n")
    os.utime(tmp_path / ".venv/dependencies.stamp", (1, 1))
    (build / "bin/surefoot").touch(mode=0o755)

    def run(printed, status=0):
        (tmp_path / "printed").write_text(printed)
        (tmp_path / "bin/ninja").write_text(f"#!/bin/sh\ncat {tmp_path}/printed\nexit {status}\n")
        (tmp_path / "bin/ninja").chmod(0o755)
        return subprocess.run(["bash", "-c", "source tools/setup.sh; locked build_program >&2"], env=found_in(tmp_path), cwd=tmp_path,
                              capture_output=True, text=True)  # fmt: skip

    return run


CHATTER = "ninja: Entering directory\n[0/2] Re-checking globbed directories...\n-- Configuring done\n"


def test_a_build_says_one_line(build_program):
    result = build_program(CHATTER + "[1/2] Building CXX object a.o\n[2/2] Linking CXX executable surefoot\n")
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "surefoot: building…\n")


def test_where_nothing_is_built_nothing_is_said(build_program):
    result = build_program(CHATTER + "ninja: no work to do.\n")
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")
    # It is known then, and asked only once.
    assert build_program("[1/1] Building CXX object a.o\n").stderr == ""


def test_a_build_that_fails_shows_the_error(build_program):
    result = build_program(CHATTER + "[1/2] Building CXX object a.o\nFAILED: a.o\na.cpp:3: error: no\n", status=1)
    assert result.returncode == 2
    lines = result.stderr.splitlines()
    assert lines[0] == "surefoot: building…" and "a.cpp:3: error: no" in lines
    assert lines[-1] == "surefoot: the build failed: the first error above says where."
    assert "Configuring" not in result.stderr


@pytest.fixture
def launcher(build_program, tmp_path):
    """bin/surefoot of a tree whose set-up is done and whose program, which prints its name, was built once."""
    for file in ["debian.txt", "python.txt", "robots.txt"]:
        (tmp_path / "dependencies" / file).touch()
    (tmp_path / ".venv/dependencies.stamp").write_text(hashlib.sha256(b"").hexdigest() + "  -\n")
    os.utime(tmp_path / ".venv/dependencies.stamp", (1, 1))
    shutil.copy(ROOT / "bin/surefoot", tmp_path / "bin")
    program = tmp_path / "build/release/bin/surefoot"
    program.write_text('#!/bin/sh\necho "$0" "$@"\n')
    assert build_program(CHATTER).returncode == 0
    program.write_text("half of what the next build links")

    def start(*words):
        return subprocess.Popen(["bin/surefoot", *words], cwd=tmp_path, env=found_in(tmp_path), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    return start


@contextlib.contextmanager
def another_launcher(tree):
    """One that sets up or builds, all the while."""
    folder = os.open(tree / "dependencies", os.O_RDONLY)
    fcntl.flock(folder, fcntl.LOCK_EX)
    yield
    os.close(folder)


def test_while_another_launcher_builds_the_program_is_that_of_the_last_build(launcher, tmp_path):
    with another_launcher(tmp_path):
        done = launcher("list", "robots")
        out, err = done.communicate(timeout=60)
    assert (done.returncode, out) == (0, f"{tmp_path}/build/release/last/surefoot list robots\n")
    assert err == "surefoot: another launcher is building; this is the program as it was built last\n"


def test_without_a_last_build_the_launcher_says_that_it_waits(launcher, tmp_path):
    shutil.rmtree(tmp_path / "build/release/last")
    (tmp_path / "build/release/bin/surefoot").write_text("#!/bin/sh\necho built\n")
    with another_launcher(tmp_path):
        waiting = launcher("list", "robots")
        assert waiting.stderr.readline() == "surefoot: waiting for another launcher, which sets up or builds here\n"
    out, err = waiting.communicate(timeout=60)
    assert (waiting.returncode, out, err) == (0, "built\n", "")


@pytest.mark.parametrize(("version", "status"), [("1.9-3", 2), ("2.0-1", 0)])
def test_a_debian_package_older_than_the_list_says_is_told(tmp_path, version, status):
    for folder in ("tools", "dependencies", "bin"):
        (tmp_path / folder).mkdir()
    shutil.copy(ROOT / "tools/setup.sh", tmp_path / "tools")
    (tmp_path / "dependencies/debian.txt").write_text("thing 2.0\nother\n")
    programs = {"dpkg-query": f'case "$3" in *Status*) ;; *) echo {version} ;; esac', "apt-get": "exit 0", "sudo": '[ "$1" = -n ] && shift; exec "$@"'}
    for name, text in programs.items():
        (tmp_path / "bin" / name).write_text(f"#!/bin/sh\n{text}\n")
        (tmp_path / "bin" / name).chmod(0o755)
    done = subprocess.run(["bash", "-c", "source tools/setup.sh; install_debian_packages"], env=found_in(tmp_path), cwd=tmp_path,
                          capture_output=True, text=True)  # fmt: skip
    assert (done.returncode, done.stdout) == (status, "setup: installing Debian packages: thing other\n")
    told = f"surefoot: the Debian package thing is version {version} here, and at least 2.0 is needed: use Debian 12 or newer.\n"
    assert done.stderr == (told if status else "")
