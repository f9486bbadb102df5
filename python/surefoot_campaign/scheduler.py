"""Runs tasks, some at a time: those of a campaign, of `run --seeds` and of the demo."""

import collections
import contextlib
import importlib.util
import math
import os
import resource
import selectors
import shutil
import signal
import subprocess
import tempfile
import threading
import time
from dataclasses import dataclass

from surefoot_campaign.errors import InputError

SCHEDULERS = ["local", "ray"]


@dataclass(frozen=True)
class Task:
    id: object
    command: list
    timeout: float = math.inf  # s of wall clock


@dataclass(frozen=True)
class Result:
    id: object
    status: int  # exit code; below 0: the signal that ended it
    timed_out: bool
    stdout: str
    stderr: str
    wall_time: float  # s


@contextlib.contextmanager
def results_of(scheduler, tasks):
    """What `scheduler.run` yields. ^C and SIGTERM stop it meanwhile, where it runs in the main thread: only that may have handlers."""
    numbers = (signal.SIGINT, signal.SIGTERM) if threading.current_thread() is threading.main_thread() else ()
    before = {number: signal.signal(number, lambda number, _: scheduler.stop(number)) or signal.SIG_DFL for number in numbers}
    try:
        with contextlib.closing(scheduler.run(tasks)) as results:
            yield results
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


# The kernel signals a parent's end only to a child that has asked for it. A child whose parent ended before that goes no further.
TIED_TO_PARENT = ["setpriv", "--pdeathsig", "KILL", "--", "sh", "-c", '[ "$PPID" = "$0" ] || exit 1; exec "$@"']


class Process:
    """A task that runs. Its output goes to files, so that nobody must read it meanwhile."""

    def __init__(self, task):
        self.task = task
        self.out, self.err = tempfile.TemporaryFile(), tempfile.TemporaryFile()
        self.started = time.monotonic()
        # In a process group of its own, so that ^C does not reach it. It ends with its parent, however that ends.
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

    def send(self, number):
        """Sends a signal to the process and all that it started."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.process.pid, number)

    def result(self, timed_out=False):
        """The result of a process that has ended, or whose time is over."""
        self.send(signal.SIGKILL)
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
        process.result()
        raise


class LocalScheduler:
    """Processes on this machine. Another scheduler has the same `run`, `stop` and `stopped`."""

    def __init__(self, jobs):
        self.jobs, self.running, self.stopped = jobs, {}, 0
        _, most = resource.getrlimit(resource.RLIMIT_NOFILE)  # a run takes three files
        resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))

    def stop(self, number=signal.SIGTERM):
        """Starts no more and asks what runs to end; `run` yields their results. Asked again it kills them. For handlers of a signal, which is `stopped`."""
        for process in list(self.running.values()):
            process.send(signal.SIGKILL if self.stopped else signal.SIGTERM)
        self.stopped = self.stopped or number

    def run(self, tasks):
        """Starts the tasks in their order and yields each result as it comes; closing the iterator kills what runs."""
        waiting = collections.deque(tasks)
        with selectors.DefaultSelector() as selector:
            try:
                while self.running or (waiting and not self.stopped):
                    while waiting and len(self.running) < self.jobs and not self.stopped:
                        self._start(waiting.popleft(), selector)
                    if not self.running:  # stopped before the next one began
                        break
                    for fd, timed_out in self._ended(selector):
                        selector.unregister(fd)
                        os.close(fd)
                        yield self.running.pop(fd).result(timed_out)
            finally:
                for fd, process in self.running.items():
                    os.close(fd)
                    process.result()

    def _start(self, task, selector):
        process = Process(task)
        fd = os.pidfd_open(process.process.pid)
        self.running[fd] = process
        selector.register(fd, selectors.EVENT_READ)
        if self.stopped:  # while it was being started
            process.send(signal.SIGTERM)

    def _ended(self, selector):
        left = min(process.deadline() for process in self.running.values()) - time.monotonic()
        ended = [key.fd for key, _ in selector.select(max(0.0, left) if left < math.inf else None)]
        now = time.monotonic()
        late = [fd for fd, process in self.running.items() if fd not in ended and process.deadline() <= now]
        return [(fd, False) for fd in ended] + [(fd, True) for fd in late]


def make_scheduler(kind, jobs):
    if kind == "local":
        return LocalScheduler(jobs)
    if importlib.util.find_spec("ray") is None:
        raise InputError("--scheduler ray: the Python package ray is not installed here; local is valid without it")
    from surefoot_campaign.ray_scheduler import RayScheduler

    return RayScheduler(jobs)
