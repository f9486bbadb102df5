"""The command `surefoot` of an installed wheel: becomes the program, and names the Python that has its packages."""

import os
import sys

import surefoot_installation


def main():
    if trouble := surefoot_installation.trouble():
        sys.exit(f"surefoot: {trouble}")
    program = surefoot_installation.SITE / "surefoot/bin/surefoot"
    os.environ |= {"SUREFOOT_PYTHON": sys.executable, "SUREFOOT_COMMAND": "surefoot"}
    os.execv(program, ["surefoot", *sys.argv[1:]])
