"""The program surefoot, called as its users call it."""

import contextlib
import hashlib
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess

from surefoot_campaign.command_line import WRONG_INPUT
from surefoot_campaign.errors import InputError
from surefoot_campaign.outcome import last_line

MAX_SEED = 999_999_999  # of --seed
PLAIN_WORD = re.compile(r"[A-Za-z_][A-Za-z0-9_./-]*")


class Refused(InputError):
    """The program does not take a scenario with these parameters."""


def yaml_text(value):
    """A value as the program's --set reads it."""
    if isinstance(value, str) and PLAIN_WORD.fullmatch(value):
        return value
    return json.dumps(value, ensure_ascii=False)


def arguments_of(scenario, seed, parameters):
    assignments = [f"{key}={yaml_text(value)}" for key, value in parameters.items()]
    return ["run", scenario, "--seed", str(seed), *(["--set", *assignments] if assignments else [])]


class Program:
    def __init__(self, path=None):
        """`path` is the C++ program; its launcher names it in the environment, and itself for commands to be typed."""
        self.path = pathlib.Path(path or os.environ.get("SUREFOOT_PROGRAM", "surefoot"))
        self.typed = os.environ.get("SUREFOOT_COMMAND", str(self.path))
        if not self.path.is_file():
            raise InputError(f"the program {self.path} is not there; bin/surefoot starts it")

    def about(self, arguments):
        """What the program says of a run before it begins, of a metric its `worst` value ("greatest" or "least") and whether it is `by_clock`.
        Throws its words: Refused, if it refuses the arguments."""
        command = [str(self.path), *arguments, "--check", "--json"]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if done.returncode != 0:
            kind = Refused if done.returncode == WRONG_INPUT else InputError
            raise kind(last_line(done.stderr) or f"the program ended with {done.returncode}")
        return json.loads(done.stdout)

    def check(self, scenario, parameters):
        """The same of a scenario with parameters, with a version that distinguishes programs."""
        about = self.about(arguments_of(scenario, 0, parameters))
        return about | {"version": self._version(about["version"], about["commit"])}

    def _version(self, version, commit):
        """Programs with the same version do the same. Where the commit does not suffice, the file's hash is part of it."""
        if commit and not commit.endswith("-dirty"):
            return f"{version}+{commit}"
        digest = hashlib.sha256(self.path.read_bytes()).hexdigest()[:12]
        return f"{version}+{commit or 'unknown'}.{digest}"

    @contextlib.contextmanager
    def copied_to(self, path):
        """A copy that stays as it is while somebody builds the program again. An installed one, which has its data and libraries beside itself, is the
        same program where it is."""
        if (self.path.parent.parent / "share/surefoot").is_dir():
            yield Program(self.path)
            return
        partial = path.with_name(path.name + ".new")
        shutil.copy2(self.path, partial)
        partial.replace(path)
        try:
            yield Program(path.absolute())
        finally:
            path.unlink(missing_ok=True)

    def pinned(self):
        """The program as this file is now, even if it is built again meanwhile; also for those who read its runs' logs."""
        path = f"/proc/{os.getpid()}/fd/{os.open(self.path, os.O_RDONLY)}"
        os.environ["SUREFOOT_PROGRAM"] = path
        return Program(path)

    def command(self, run):
        """What to type to make a run of a plan again, here."""
        return shlex.join([self.typed, *arguments_of(run.file, run.seed, run.parameters)])
