"""A task of your own: the base goes up and down by a sine, at the place of the library's height task. A task is a few rows of
lower ≤ A x ≤ upper over x = (accelerations u̇, torques τ); the stack says how important they are."""

import time
import warnings

import numpy as np

import surefoot
from surefoot import OwnTask, Stack, TaskTick
from surefoot.task import Rows

AMPLITUDE, OMEGA, KP, KD = 0.03, 2 * np.pi, 200.0, 28.0  # m, rad/s, 1/s², 1/s


class Bounce(OwnTask):
    max_rows, unit, row_names = 1, "m/s²", ["height"]
    calls, seconds = 0, 0.0

    def rows(self, tick: TaskTick) -> Rows:
        begin = time.perf_counter()
        base, phase = tick.dynamics.base, OMEGA * tick.plan.time
        height = tick.plan.torso.height + AMPLITUDE * np.sin(phase)
        rate, acceleration = AMPLITUDE * OMEGA * np.cos(phase), -AMPLITUDE * OMEGA**2 * np.sin(phase)
        b = acceleration + KD * (rate - base.v[2]) + KP * (height - base.p[2]) - base.Jdot_u[2]
        rows = base.J[2:3], [b]  # z̈ = J u̇ + Jdot_u
        self.calls, self.seconds = self.calls + 1, self.seconds + time.perf_counter() - begin
        return rows


class Broken(Bounce):
    def rows(self, tick: TaskTick) -> Rows:
        return super().rows(tick) if tick.plan.time < 0.5 else (tick.dynamics.base.J, [np.nan] * 3)


task = Bounce("bounce")
stack = Stack("terrain_adaptation").replace("torso_height", task)
scenario = surefoot.load_scenario("walk_flat_ideal", stack=stack, set=["duration=3", "user=[{time: 0}]"])
heights: list[float] = []
result = surefoot.run(scenario, every_tick=lambda tick: heights.append(tick.plant.truth.p_SB[2]))
swing = max(heights[400:]) - min(heights[400:])
print(f"{result}: height moves by {1e3 * swing:.1f} mm of {2e3 * AMPLITUDE:.0f}, {1e6 * task.seconds / task.calls:.0f} µs a tick in Python")
assert abs(swing - 2 * AMPLITUDE) < 0.01 and not result["fell"]

# What goes wrong in it ends in a safe posture, and a warning that names it.
with warnings.catch_warnings(record=True) as told:
    warnings.simplefilter("always")
    broken = surefoot.run("walk_flat_ideal", stack=Stack("terrain_adaptation").replace("torso_height", Broken("broken")), set=["duration=2"])
print(broken, told[-1].message, sep="\n")
assert not broken.succeeded and "broken" in repr(broken)
