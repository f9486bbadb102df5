"""docs/your_robot.md is followed to the letter: its commands run, its files are written, and what it quotes is printed."""

import os
import re
import subprocess
import sys

import pytest
from program import PROGRAM, ROOT

PAGE = ROOT / "docs/your_robot.md"
BLOCK = re.compile(r"^```(sh|text|yaml)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def follow(folder):
    """Does what the page says; yields what each quotation says and what was printed before it."""
    (folder / "examples").symlink_to(ROOT / "examples")
    (folder / "bin").mkdir()
    (folder / "bin/surefoot").symlink_to(PROGRAM)
    printed = ""
    for kind, block in BLOCK.findall(PAGE.read_text()):
        if kind == "sh":
            environment = os.environ | {"PATH": f"{folder}/bin:{os.environ['PATH']}"}
            printed = subprocess.run(["bash", "-c", block], cwd=folder, env=environment, capture_output=True, text=True).stdout
        elif kind == "yaml":
            (folder / re.match(r"# (\S+)", block)[1]).write_text(block)
        else:
            yield block, printed


@pytest.mark.slow
def test_a_robot_walks_by_what_the_page_says(tmp_path):
    quotations = 0
    for quoted, printed in follow(tmp_path):
        remaining = iter(printed.splitlines())
        for line in quoted.splitlines():
            assert line in remaining, f"{line}\nis not printed, or not there:\n{printed}"
        quotations += 1
    assert quotations > 8
    assert (tmp_path / "marten.svg").read_text() == (ROOT / "docs/images/marten.svg").read_text()


def test_the_keys_that_the_page_names_are_options():
    named = set(re.findall(r"`((?:planner|sensors|actuators)\.[\w.]+)", PAGE.read_text()))
    assert len(named) > 4
    listed = subprocess.run([PROGRAM, "list", "options"], capture_output=True, text=True).stdout
    assert [key for key in named if not re.search(rf"^\s*{re.escape(key)}\b", listed, re.MULTILINE)] == []


def test_the_hexapod_is_what_its_script_prints():
    printed = subprocess.run([sys.executable, ROOT / "tools/hexapod.py"], capture_output=True, text=True, check=True).stdout
    assert printed == (ROOT / "robots/hexapod.urdf").read_text()
