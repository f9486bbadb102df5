"""The command `surefoot` of an installed wheel: becomes the program, and names the Python that has its packages."""

import os
import pathlib
import sys


def main():
    program = pathlib.Path(__file__).parent / "surefoot/bin/surefoot"
    os.environ |= {"SUREFOOT_PYTHON": sys.executable, "SUREFOOT_COMMAND": "surefoot"}
    os.execv(program, ["surefoot", *sys.argv[1:]])
