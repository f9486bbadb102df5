"""Runs tasks, some at a time. A scheduler is anything with `run(tasks)` that yields a Result for each, in any order."""

import collections
import importlib.util
import os
import selectors
import shutil
import signal
import subprocess
import tempfile
import time
from dataclasses import dataclass
from typing import Iterable, Iterator, Protocol

from surefoot_campaign.errors import InputError

SCHEDULERS = ["local", "ray"]


@dataclass(frozen=True)
class Task:
    id: str
    command: list
    timeout: float  # s of wall clock


@dataclass(frozen=True)
class Result:
    id: str
    status: int  # exit code; below 0: the signal that ended it
    timed_out: bool
    stdout: str
    stderr: str
    wall_time: float  # s


class Scheduler(Protocol):
    def run(self, tasks: Iterable[Task]) -> Iterator[Result]:
        """Starts the tasks in their order and yields each result as it comes; closing the iterator ends what runs."""


# The kernel tells of a parent's end only to a child that has asked for it: one whose parent ended before goes no further.
TIED_TO_PARENT = ["setpriv", "--pdeathsig", "KILL", "--", "sh", "-c", '[ "$PPID" = "$0" ] || exit 1; exec "$@"']


class Process:
    """A task that runs. Its output goes to files, so that nobody must read it meanwhile."""

    def __init__(self, task):
        self.task = task
        self.out, self.err = tempfile.TemporaryFile(), tempfile.TemporaryFile()
        self.started = time.monotonic()
        # A process group of its own: ^C is for us to handle. It ends with its parent, however that ends.
        guard = [*TIED_TO_PARENT, str(os.getpid())] if shutil.which("setpriv") else []
        self.process = subprocess.Popen(
            [*guard, *task.command],
            stdin=subprocess.DEVNULL,
            stdout=self.out,
            stderr=self.err,
            start_new_session=True,
        )

    def deadline(self):
        return self.started + self.task.timeout

    def kill(self):
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.process.wait()

    def result(self, timed_out=False):
        """Of one that has ended, or whose time is over."""
        if timed_out:
            self.kill()
        status = self.process.wait()
        wall_time = time.monotonic() - self.started
        return Result(self.task.id, status, timed_out, read(self.out), read(self.err), wall_time)


def read(file):
    with file:
        file.seek(0)
        return file.read().decode(errors="replace")


def run_one(task):
    """Runs a task and waits for it: for schedulers whose workers do one thing at a time."""
    process = Process(task)
    try:
        process.process.wait(task.timeout)
        return process.result()
    except subprocess.TimeoutExpired:
        return process.result(timed_out=True)
    except BaseException:
        process.kill()
        raise


class LocalScheduler:
    """Processes on this machine."""

    def __init__(self, jobs):
        self.jobs = jobs

    def run(self, tasks):
        waiting, running = collections.deque(tasks), {}
        with selectors.DefaultSelector() as selector:
            try:
                while waiting or running:
                    while waiting and len(running) < self.jobs:
                        process = Process(waiting.popleft())
                        fd = os.pidfd_open(process.process.pid)
                        running[fd] = process
                        selector.register(fd, selectors.EVENT_READ)
                    for fd, timed_out in self._ended(selector, running):
                        selector.unregister(fd)
                        os.close(fd)
                        yield running.pop(fd).result(timed_out)
            finally:
                for fd, process in running.items():
                    os.close(fd)
                    process.kill()

    @staticmethod
    def _ended(selector, running):
        left = min(process.deadline() for process in running.values()) - time.monotonic()
        ended = [key.fd for key, _ in selector.select(max(0.0, left))]
        now = time.monotonic()
        late = [fd for fd, process in running.items() if fd not in ended and process.deadline() <= now]
        return [(fd, False) for fd in ended] + [(fd, True) for fd in late]


def make_scheduler(kind, jobs):
    if kind == "local":
        return LocalScheduler(jobs)
    if importlib.util.find_spec("ray") is None:
        raise InputError("--scheduler ray: the Python package ray is not installed here; local is valid without it")
    from surefoot_campaign.ray_scheduler import RayScheduler

    return RayScheduler(jobs)
