"""A state estimator of your own. This one believes the joints, the gyroscope's heading and that the feet stand: the base is where the legs say,
level by the accelerometer. It is enough to stand; walking needs more, such as the library's, which the second one asks and corrects."""

import numpy as np

import surefoot
from surefoot import Estimator, RobotState, SensorReading, TickContext

robot = surefoot.Robot("anymal_b")


class ByTheLegs(Estimator):
    """Blends the accelerometer's vertical into the gyroscope's turns; the feet's mean place stays at the origin."""

    up = np.array([0.0, 0.0, 1.0])  # in B

    def update(self, reading: SensorReading, context: TickContext) -> RobotState:
        state = RobotState()
        self.up = self.up - 0.0025 * np.cross(reading.gyro, self.up)
        self.up += 0.002 * (reading.accelerometer / 9.81 - self.up)
        self.up /= np.linalg.norm(self.up)
        half = np.array([1.0 + self.up[2], self.up[1], -self.up[0], 0.0])  # turns `up` to the vertical, without heading
        state.time, state.q, state.qd, state.torque = reading.time, reading.q, context.joint_velocity, reading.torque
        state.q_WB, state.w_WB_B = half / np.linalg.norm(half), reading.gyro
        legs = robot.dynamics(q=reading.q, u=[0, 0, 0, *reading.gyro, *context.joint_velocity], q_WB=state.q_WB)
        state.p_WB = -np.mean([foot.p for foot in legs.contacts.values()], axis=0)
        state.v_WB = -np.mean([foot.v for foot in legs.contacts.values()], axis=0)
        return state

    def restart(self) -> None:
        self.up = np.array([0.0, 0.0, 1.0])


class Noted(Estimator):
    """The library's, asked by super(); it keeps what it said."""

    def __init__(self, scenario: surefoot.Scenario) -> None:
        super().__init__(scenario)
        self.heights: list[float] = []

    def update(self, reading: SensorReading, context: TickContext) -> RobotState:
        state = super().update(reading, context)
        self.heights.append(state.p_WB[2])
        return state


standing = surefoot.load_scenario("walk_flat", set=["duration=3", "user=[{time: 0}]", "planner.calibration.duration=0", "criteria=none"])
result = surefoot.run(standing, estimator=ByTheLegs())
print(f"{result}: velocity off by {1e3 * result['velocity_error_rms_mps']:.1f} mm/s, tilt by {1e3 * result['tilt_error_rms_rad']:.1f} mrad")
assert not result["fell"] and result["fallback_ticks"] < 100

noted = Noted(standing)
print(surefoot.run(standing, estimator=noted), f"{len(noted.heights)} ticks, {noted.heights[-1]:.3f} m high")
assert len(noted.heights) >= 1200
