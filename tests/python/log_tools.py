"""Our Python package of logs, and its commands as the launcher starts them."""

import os
import subprocess
import sys

from program import ROOT

TICKS = 800  # of the log that tests share


def log_command(*arguments, package="surefoot_log", before="", **options):
    """`before`: a folder whose packages take the place of others."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(before), str(ROOT / "python"), os.environ.get("PYTHONPATH", "")])}
    command = [sys.executable, "-m", package, *map(str, arguments)]
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=600, **options)


def complaint_of(*arguments, package="surefoot_log"):
    """The one line on stderr of a call whose input is wrong."""
    result = log_command(*arguments, package=package)
    assert (result.returncode, result.stdout) == (2, ""), result
    (line,) = result.stderr.strip().splitlines()
    assert line.startswith("surefoot: ")
    return line


def exported(*arguments):
    """The result of an export that must succeed."""
    result = log_command("export", *arguments)
    assert result.returncode == 0, result.stderr
    return result
