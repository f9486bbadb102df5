"""The same tasks on a Ray cluster, all of whose machines have this tree, and the results' folder, at the same path."""

import itertools
import os
import signal

import ray

from surefoot_campaign.scheduler import Result, run_one

POLL = 1.0  # s; also how soon a stop is seen
LOST = 255  # the status of a task whose worker did not come back


class RayScheduler:
    def __init__(self, jobs):
        self.jobs, self.stopped = jobs, 0

    def stop(self, number=signal.SIGTERM):
        self.stopped = number

    def run(self, tasks):
        if not ray.is_initialized():
            ray.init(runtime_env={"env_vars": {"PYTHONPATH": os.environ.get("PYTHONPATH", "")}})
        remote = ray.remote(num_cpus=1, max_retries=2)(run_one)  # again where a machine was lost
        tasks = iter(tasks)
        running = {remote.remote(task): task for task in itertools.islice(tasks, self.jobs)}
        try:
            while running and not self.stopped:
                for done in ray.wait(list(running), num_returns=1, timeout=POLL)[0]:
                    task = running.pop(done)
                    running |= {remote.remote(task): task for task in itertools.islice(tasks, 1)}
                    yield result_of(task, done)
        finally:
            for reference in running:
                ray.cancel(reference, force=True)


def result_of(task, reference):
    try:
        return ray.get(reference)
    except ray.exceptions.RayTaskError:
        raise  # of ours: the program can't be started there
    except ray.exceptions.RayError as error:
        words = str(error).strip().splitlines() or [type(error).__name__]
        return Result(task.id, LOST, False, "", f"lost by Ray: {words[0]}", 0.0)
