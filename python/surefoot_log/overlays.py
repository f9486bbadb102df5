"""What is drawn over the robot: ground forces, support polygon, centre of mass."""

import numpy as np

from surefoot_log.frames import LOADED
from surefoot_log.offscreen import mujoco

METRES_PER_NEWTON = 0.0022
LONGEST = 1.3  # m: an arrow of the ground that would be longer is cut short, with two heads
SEEN_LENGTH = 0.2  # m: so much longer is the arrow of a push, which begins inside of the robot
BODY_REACH = 1.0  # m: no body reaches further from its centre of mass
# Those of the viewer's page in the light (scene/palette.ts, math/friction.ts): none of them a leg's, and colour-blind people can tell them apart.
SAFE, NEAR, SLIDES = (0x86 / 255, 0x8F / 255, 0x98 / 255), (0xA6 / 255, 0x7F / 255, 0.0), (0xE4 / 255, 0.0, 0x3A / 255)
NEAR_FROM, SLIDES_FROM = 0.6, 0.9  # shares of the friction cone
COM, POLYGON, PUSH = (0.11, 0.12, 0.14, 1.0), (0.19, 0.40, 0.40), (0.94, 0.89, 0.26, 1.0)
ABOVE_GROUND = 0.004  # m: what lies on the ground is drawn so far above it


def colour_of_use(use):
    """The colour of a force by the share of its friction cone: grey, amber from 60 % on, red from 90 % on."""
    return (*(SAFE if use < NEAR_FROM else NEAR if use < SLIDES_FROM else SLIDES), 1.0)


def push_arrow(centre, force, torque):
    """Start and vector of a push's arrow. It starts at the point of the force's line that is nearest to the body's centre of mass, f × τ / |f|² from it."""
    size = np.linalg.norm(force)
    lever = np.cross(force, torque) / size**2
    start = centre + (lever if np.linalg.norm(lever) <= BODY_REACH else 0.0)
    return start, (SEEN_LENGTH / size + METRES_PER_NEWTON) * force


def ground_arrows(force):
    """The vectors of the arrows that stand for a force of the ground: one, or two where it is too long for the picture."""
    way = METRES_PER_NEWTON * force
    length = np.linalg.norm(way)
    return [way] if length <= LONGEST else [LONGEST / length * way, 0.85 * LONGEST / length * way]


def hull(points):
    """Corners of the convex hull in the plane, counter-clockwise."""
    ordered = sorted(map(tuple, points))

    def turn(a, b, c):
        return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])

    def half(sequence):
        chain = []
        for point in sequence:
            while len(chain) > 1 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
            chain.append(point)
        return chain[:-1]

    return [np.array(corner) for corner in half(ordered) + half(ordered[::-1])]


class Overlays:
    """Adds shapes to a scene that was filled with the model's."""

    def __init__(self, scene, foot_radius):
        self._scene, self._radius = scene, foot_radius

    def draw(self, frame):
        self._polygon(frame)
        for touch in frame.forces:
            if np.linalg.norm(touch.force) > LOADED / 4:
                for way in ground_arrows(touch.force):
                    self._arrow(touch.point, touch.point + way, 0.019, colour_of_use(touch.friction_use))
        if frame.p_SCom is not None:
            self._centre_of_mass(frame)

    def _new(self, kind, size, position, rotation, colour):
        if self._scene.ngeom >= self._scene.maxgeom:
            return None
        geom = self._scene.geoms[self._scene.ngeom]
        mujoco.mjv_initGeom(geom, kind, np.array(size, float), np.array(position, float), np.array(rotation, float).ravel(), np.array(colour, np.float32))
        geom.emission, geom.specular, geom.category = 0.35, 0.1, mujoco.mjtCatBit.mjCAT_DECOR
        self._scene.ngeom += 1
        return geom

    def _between(self, kind, start, end, width, colour):
        geom = self._new(kind, [width] * 3, [0, 0, 0], np.eye(3), colour)
        if geom is not None:
            mujoco.mjv_connector(geom, kind, width, np.array(start, float), np.array(end, float))
        return geom

    def _arrow(self, start, end, width, colour):
        geom = self._between(mujoco.mjtGeom.mjGEOM_ARROW, start, end, width, colour)
        if geom is not None:
            geom.size[2] *= 2  # an arrow is drawn half as long

    def _ground(self, frame):
        """Height of the highest ground that carries, a little above it [m]."""
        return max((foot[2] for foot in frame.carrying_feet), default=0.0) - self._radius + ABOVE_GROUND

    def _polygon(self, frame):
        """Level, over the highest foot that carries; from the lower ones a line goes up to it."""
        feet = frame.carrying_feet
        if len(feet) < 3:
            return
        level = self._ground(frame)
        corners = hull([(*foot[:2], level) for foot in feet])
        for a, b, c in ((corners[0], b, c) for b, c in zip(corners[1:], corners[2:])):
            self._triangle(a, b, c, (*POLYGON, 0.22))
        for start, end in zip(corners, corners[1:] + corners[:1]):
            self._between(mujoco.mjtGeom.mjGEOM_CAPSULE, start, end, 0.004, (*POLYGON, 0.9))
        for foot in feet:
            if level - foot[2] > self._radius:
                self._between(mujoco.mjtGeom.mjGEOM_CAPSULE, foot, [*foot[:2], level], 0.002, (*POLYGON, 0.9))

    def _triangle(self, a, b, c, colour):
        """MuJoCo's triangle has its corners at 0, x and y of its frame, which may be oblique."""
        across = np.cross(b - a, c - a)
        rotation = np.column_stack([b - a, c - a, across / np.linalg.norm(across)])
        geom = self._new(mujoco.mjtGeom.mjGEOM_TRIANGLE, [1, 1, 1], a, rotation, colour)
        if geom is not None:
            geom.specular, geom.emission = 0.0, 0.5

    def _centre_of_mass(self, frame):
        """A ball, and the point below it at the level of the support polygon."""
        below = np.array([*frame.p_SCom[:2], self._ground(frame) + ABOVE_GROUND])
        self._new(mujoco.mjtGeom.mjGEOM_SPHERE, [0.022] * 3, frame.p_SCom, np.eye(3), COM)
        self._between(mujoco.mjtGeom.mjGEOM_CAPSULE, below, frame.p_SCom, 0.003, (*COM[:3], 0.6))
        self._new(mujoco.mjtGeom.mjGEOM_CYLINDER, [0.028, 0.028, 0.002], below, np.eye(3), COM)
