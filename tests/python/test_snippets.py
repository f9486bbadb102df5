"""The commands and programs in the documents do what they say: each is tried, in a folder as its reader would have it.

A command that would run for long is only checked: `run` with --check, `campaign` with --dry-run, a page that would be served not at all.
docs/your_robot.md is followed to the letter by test_your_robot.py, the loops of both READMEs by test_bindings.py."""

import os
import re
import shutil
import subprocess
import sys

import pytest
from conftest import record
from program import PROGRAM, ROOT

PAGES = [*(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "python/README.md")), *sorted((ROOT / "docs").glob("*.md"))]
BLOCK = re.compile(r"^```(sh|yaml|json|python|py)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
# What is not run here, by how the line begins, and why.
NOT_RUN = {
    "./demo": "it is tests/python/test_demo.py",
    "./test": "it is this",
    "pip install": "tests/python/test_wheel.py does",
    "apt install": "tools/setup.sh does",
    "cmake --preset": "another build takes minutes",
    "SUREFOOT_FUZZ": "it needs that other build",
    "bash tools/": "benchmarks take half an hour",
    "ninja -C": "benchmarks take half an hour to run, ./test builds them",
    "build/release/benchmark": "they take half an hour",
    "ssh": "there is no other machine",
}
WRAPPER = f"""#!/usr/bin/env bash
case $1 in
  run) words=(); for word in "$@"; do [[ $word == --view ]] || words+=("$word"); done; exec {PROGRAM} "${{words[@]}}" --check ;;
  campaign) exec {PROGRAM} "$@" --dry-run ;;
  demo) exec {PROGRAM} demo --help ;;
  replay) [[ $* == *--verify* || $* == *--stack* ]] || exec {PROGRAM} info "$2" ;;
esac
exec {PROGRAM} "$@"
"""
PROBLEM = '{"levels": [{"A": [[1, 0]], "b": [2]}]}\n'
FRAGMENT = re.compile(r"(terrain|sensors|disturbances|randomise|stack_switches|user|base):")


@pytest.fixture(scope="module")
def run_log(tmp_path_factory):
    """Long enough for every time that a page asks about."""
    return record(tmp_path_factory.mktemp("log") / "run.mcap", scenario="step_down", duration=16)


@pytest.fixture
def folder(tmp_path, run_log):
    shutil.copy(run_log, tmp_path / "run.mcap")
    for name in ("campaigns", "examples", "robots", "stacks", "tools"):
        (tmp_path / name).symlink_to(ROOT / name)
    for name in ("problem.jsonl", "problems.jsonl"):
        (tmp_path / name).write_text(PROBLEM)
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/surefoot").write_text(WRAPPER)
    (tmp_path / "bin/surefoot").chmod(0o755)
    return tmp_path


def tried(command, folder):
    environment = os.environ | {"PATH": f"{folder}/bin:{os.environ['PATH']}"}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, f"{command[-1]}\n{done.stdout[-2000:]}{done.stderr[-2000:]}"


def is_run(line):
    return not any(line.startswith(begin) for begin in NOT_RUN)


def written(block, folder):
    """Keeps a file that a page shows; a part of a scenario is checked as one."""
    if named := re.match(r"# (\S+\.yaml)\b", block):
        (folder / named[1]).write_text(block)
    elif named := re.match(r"name: (\w+)", block):
        (folder / f"{named[1]}.yaml").write_text(block)
    elif FRAGMENT.match(block):
        base = "" if block.startswith("base:") else f"base: {'reach' if 'reach:' in block else 'step_down'}.yaml\n"
        (folder / "fragment.yaml").write_text(base + block)
        tried(["bash", "-c", "surefoot run fragment.yaml"], folder)


@pytest.mark.parametrize("page", [page for page in PAGES if page.name != "your_robot.md"], ids=lambda page: page.relative_to(ROOT).as_posix())
def test_what_a_page_shows_works(page, folder):
    for language, block in BLOCK.findall(page.read_text()):
        if language == "sh":
            lines = [line for line in block.splitlines() if is_run(line)]
            tried(["bash", "-ec", "\n".join(lines)], folder)
        elif language == "yaml":
            written(block, folder)
        elif language == "json":
            for name in ("problem.jsonl", "problems.jsonl"):
                (folder / name).write_text(block)
        elif page.name != "README.md":
            tried([sys.executable, "-c", block], folder)


def test_the_reasons_for_what_is_not_run_are_needed():
    lines = [line for page in PAGES for _, block in BLOCK.findall(page.read_text()) for line in block.splitlines()]
    for begin in NOT_RUN:
        assert any(line.startswith(begin) for line in lines), begin
