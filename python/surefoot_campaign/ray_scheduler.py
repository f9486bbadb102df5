"""The same tasks on a Ray cluster, all of whose machines have this tree, and the results' folder, at the same path."""

import itertools
import os

import ray

from surefoot_campaign.scheduler import run_one


class RayScheduler:
    def __init__(self, jobs):
        self.jobs = jobs

    def run(self, tasks):
        if not ray.is_initialized():
            ray.init(runtime_env={"env_vars": {"PYTHONPATH": os.environ.get("PYTHONPATH", "")}})
        remote = ray.remote(num_cpus=1, max_retries=2)(run_one)  # again where a machine was lost
        tasks = iter(tasks)
        running = [remote.remote(task) for task in itertools.islice(tasks, self.jobs)]
        try:
            while running:
                done, running = ray.wait(running, num_returns=1)
                running += [remote.remote(task) for task in itertools.islice(tasks, 1)]
                yield ray.get(done[0])
        finally:
            for task in running:
                ray.cancel(task, force=True)
