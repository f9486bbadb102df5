"""Calls of the program, as its user makes them."""

import json
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("SUREFOOT_PROGRAM", str(ROOT / "build/release/bin/surefoot"))
SHORT = ["--set", "duration=0.1"]


def served(arguments, waits, port=0):
    """The call that serves a page; a run that is watched begins at once, unless it `waits` for its page."""
    at_once = ["--no-wait"] if "--view" in arguments and not waits else []
    return [PROGRAM, *map(str, arguments), *at_once, "--port", str(port)]


def surefoot(*arguments, timeout=300, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=timeout, **options)


def run_result(*arguments, **options):
    """The JSON of a run, however it came out."""
    return json.loads(surefoot("run", *arguments, "--json", **options).stdout)


def answer(*arguments, status=0):
    """What a call says that ends with that status."""
    result = surefoot(*arguments)
    assert result.returncode == status, result
    assert result.stderr == ""
    return result.stdout


def of_json(*arguments, status=0):
    """The same with `--json`, decoded."""
    return json.loads(answer(*arguments, "--json", status=status))


def complaint(*arguments, **options):
    """The one line on stderr of a call whose input is wrong."""
    result = surefoot(*arguments, **options)
    assert result.returncode == 2, result
    assert result.stdout == ""
    lines = result.stderr.strip().splitlines()
    assert len(lines) == 1, result.stderr
    assert lines[0].startswith("surefoot: ")
    return lines[0]
