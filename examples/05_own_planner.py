"""A planner of your own, whose plans the library's tasks follow. The first lets all feet stand and circles with the centre of mass; the second
takes the library's walk and only adds a nod of the torso."""

import numpy as np

import surefoot
from surefoot import Dynamics, HierarchyOutcome, MotionPlan, Planner, RobotState, UserCommand

RADIUS, OMEGA = 0.03, np.pi  # m, rad/s


class Circle(Planner):
    """Stands where it is switched on."""

    stand: MotionPlan | None = None

    def update(self, user: UserCommand, state: RobotState, dynamics: Dynamics, last: HierarchyOutcome) -> MotionPlan:
        if self.stand is None:
            self.stand = surefoot.standing_plan(dynamics)
            self.center, self.begin = np.array(self.stand.com.p), state.time
        phase = OMEGA * (state.time - self.begin)
        share = min(1.0, phase / np.pi)  # it sets out gently
        plan, around = self.stand, np.array([np.cos(phase), np.sin(phase)])
        plan.time = state.time
        plan.com.p = self.center + share * RADIUS * around
        plan.com.v = share * RADIUS * OMEGA * np.array([-np.sin(phase), np.cos(phase)])
        plan.com.a = -share * RADIUS * OMEGA**2 * around
        return plan

    def restart(self) -> None:
        self.stand = None


class Nodding(Planner):
    """The library's planner, asked by super()."""

    def update(self, user: UserCommand, state: RobotState, dynamics: Dynamics, last: HierarchyOutcome) -> MotionPlan:
        plan = super().update(user, state, dynamics, last)
        plan.torso.height += 0.01 * np.sin(OMEGA * state.time)
        return plan


scenario = surefoot.load_scenario("walk_flat_ideal", set=["duration=3", "criteria=none"])
track: list[np.ndarray] = []
result = surefoot.run(scenario, planner=Circle(), every_tick=lambda tick: track.append(tick.plant.truth.p_SCom[:2].copy()))
size = np.ptp(np.array(track[600:]), axis=0)
print(f"{result}: a circle of {1e3 * size[0]:.0f} by {1e3 * size[1]:.0f} mm")
assert np.all(np.abs(size - 2 * RADIUS) < 0.015) and not result["fell"]

result = surefoot.run(scenario, planner=Nodding(scenario))
print(f"{result}: {result['steps_taken']} steps while it nods")
assert result["steps_taken"] > 0 and not result["fell"]
