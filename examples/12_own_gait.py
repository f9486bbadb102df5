"""A gait of your own within the library's planner, beside its gaits: the robot trots, sways over its feet, and trots on. The planner keeps
the torso, the terrain, the grip and the calibration."""

import numpy as np

import surefoot
from surefoot import ComPlan, Gait, GaitTick

WAY, RATE = 0.02, 2.0  # m, rad/s


class Sway(Gait):
    """All feet stay, and the centre of mass goes to the left and back."""

    def begin(self, now: GaitTick) -> None:
        self.start, self.centre = now.time, np.array(now.before.com.p)

    def com(self, now: GaitTick) -> ComPlan:
        phase, left = RATE * (now.time - self.start), np.array([-np.sin(now.yaw), np.cos(now.yaw)])
        plan = now.com
        plan.p = self.centre + WAY * (1 - np.cos(phase)) * left
        plan.v = WAY * RATE * np.sin(phase) * left
        plan.a = WAY * RATE**2 * np.cos(phase) * left
        return plan


user = """user=[{time: 0.5, walk: true, velocity: [0.4, 0], gait: trot}, {time: 16, walk: true, gait: sway},
    {time: 20, walk: true, velocity: [0.4, 0], gait: trot}]"""
result = surefoot.run("trot", set=["duration=24", "criteria=none", user], gaits={"sway": Sway})
print(f"{result}; it walked {result['distance_m']:.2f} m")
assert not result["fell"] and result["distance_m"] > 1.5
