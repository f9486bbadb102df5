"""Campaigns of the tests: a spec in a folder, started as its user starts it, with the fake program or the real one."""

import json
import os
import pathlib
import subprocess
import sys

from program import ROOT

FAKE = ROOT / "tests/python/fake_surefoot.py"

SPEC = """\
scenario: fake
seeds: {first: 1, count: 4}
grid:
  height: [0.1, 0.3]
draw:
  mass: [0.0, 6.9]
set:
  gait: walk
"""
CASES = """\
scenario: [fake, other]
seeds: {first: 1, count: 8}
cases:
  as it is: {}
  heavy: {mass: 8, gait: walk}
  one crashes: {mode: crash, broken_seed: 3}
"""


def is_running(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().split()[2] != "Z"
    except OSError:
        return False


class CampaignFolder:
    def __init__(self, path, program=FAKE, plots=False):
        self.path, self.program, self.plots = path, program, plots
        self.out = path / "results"
        self.log = path / "log"
        self.spec = path / "spec.yaml"

    def write(self, text=SPEC):
        self.spec.write_text(text)
        return self

    def environment(self):
        kept = {key: value for key, value in os.environ.items() if key != "SUREFOOT_COMMAND"}
        return kept | {"PYTHONPATH": str(ROOT / "python"), "SUREFOOT_PROGRAM": str(self.program), "FAKE_LOG": str(self.log)}

    def command(self, *arguments):
        return [sys.executable, "-m", "surefoot_campaign", str(self.spec), "--out", str(self.out),
                *([] if self.plots else ["--no-plots"]), *map(str, arguments)]  # fmt: skip

    def start(self, *arguments):
        return subprocess.Popen(self.command(*arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                env=self.environment(), cwd=self.path)  # fmt: skip

    def run(self, *arguments):
        return subprocess.run(self.command(*arguments), capture_output=True, text=True, env=self.environment(), cwd=self.path,
                              timeout=300)  # fmt: skip

    def result(self, *arguments, status=0):
        """The summary of a campaign that came to its end."""
        done = self.run("--json", *arguments)
        assert done.returncode == status, done.stderr
        return json.loads(done.stdout)

    def complaint(self, *arguments):
        """The one line of a campaign that is refused, and nothing ran or was written."""
        done = self.run(*arguments)
        assert done.returncode == 2 and done.stdout == "", done
        (line,) = done.stderr.splitlines()
        assert not self.started() and not self.out.exists()
        return line.removeprefix("surefoot: ").replace(str(self.path) + "/", "")

    def started(self):
        """Scenario, seed and parameters of every run that began."""
        return [json.loads(line) for line in self.log.read_text().splitlines()] if self.log.exists() else []

    def rows(self):
        return [json.loads(line) for line in (self.out / "rows.jsonl").read_text().splitlines()]
