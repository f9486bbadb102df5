"""From where a run is seen: from its side, so that it walks to the right."""

import math

import numpy as np

from surefoot_log.offscreen import mujoco

BESIDE = 107.0  # degrees from the heading: a little from ahead, so that the face of a step down is seen
ELEVATION = -13.0  # degrees
DISTANCE = 2.15  # m
BELOW_BASE = 0.13  # m: what is looked at lies so far below the base
SMOOTHED = 1.5  # s


def heading(frames):
    """The direction of the whole walk, or the robot's yaw at its start if it goes nowhere [rad]."""
    way = frames[-1].p_SB - frames[0].p_SB
    if math.hypot(way[0], way[1]) > 0.3:
        return math.atan2(way[1], way[0])
    w, x, y, z = frames[0].qpos[3:7]
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def smooth(values, width):
    """Moving average; values at the ends are repeated."""
    half = min(width // 2, len(values) - 1)
    if half < 1:
        return values
    padded = np.pad(values, ((half, half), (0, 0)), mode="edge")
    sums = np.cumsum(np.vstack([np.zeros(values.shape[1]), padded]), axis=0)
    return (sums[2 * half + 1 :] - sums[: -2 * half - 1]) / (2 * half + 1)


class Camera:
    """Follows the base of a run smoothly."""

    def __init__(self, frames, distance=DISTANCE):
        period = (frames[-1].time - frames[0].time) / max(1, len(frames) - 1)
        path = np.array([frame.p_SB for frame in frames])
        self._path = smooth(path, int(SMOOTHED / period) if period > 0 else 1)
        self._times = np.array([frame.time for frame in frames])
        self._camera = mujoco.MjvCamera()
        self._camera.distance, self._camera.elevation = distance, ELEVATION
        self._camera.azimuth = math.degrees(heading(frames)) + BESIDE

    def at(self, time):
        """The point that is looked at, and the camera."""
        point = np.array([np.interp(time, self._times, axis) for axis in self._path.T]) - [0, 0, BELOW_BASE]
        self._camera.lookat[:] = point
        return point, self._camera
