"""Foxglove's primitives, from vectors and rotations."""

import numpy as np

from surefoot_log.offscreen import mujoco

LISTS = ("arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models")
LINE_LOOP = 1


def vector(values):
    return {"x": float(values[0]), "y": float(values[1]), "z": float(values[2])}


def quaternion(wxyz):
    return {"x": float(wxyz[1]), "y": float(wxyz[2]), "z": float(wxyz[3]), "w": float(wxyz[0])}


def wxyz_of(R):
    """Quaternion of a rotation matrix."""
    found = np.zeros(4)
    mujoco.mju_mat2Quat(found, np.ravel(R))
    return found


def transform(position, wxyz):
    """A pose as a 4 × 4 matrix."""
    X, R = np.eye(4), np.zeros(9)
    mujoco.mju_quat2Mat(R, wxyz)
    X[:3, :3], X[:3, 3] = R.reshape(3, 3), position
    return X


def pose(position=(0, 0, 0), wxyz=(1, 0, 0, 0)):
    return {"position": vector(position), "orientation": quaternion(wxyz)}


def pose_of(X):
    return pose(X[:3, 3], wxyz_of(X[:3, :3]))


def colour(rgba):
    return dict(zip("rgba", map(float, rgba)))


def along_x(direction):
    """Rotation whose x axis points along a vector."""
    x = np.array(direction) / np.linalg.norm(direction)
    aside = np.cross(x, [0.0, 0.0, 1.0] if abs(x[2]) < 0.9 else [0.0, 1.0, 0.0])
    y = aside / np.linalg.norm(aside)
    return np.column_stack([x, y, np.cross(x, y)])


def arrow(start, force, metres_per_newton, rgba):
    length = float(np.linalg.norm(force)) * metres_per_newton
    head = min(0.04, 0.5 * length)
    return {"pose": pose(start, wxyz_of(along_x(force))), "shaft_length": length - head, "shaft_diameter": 0.016, "head_length": head,
            "head_diameter": 0.034, "color": colour(rgba)}  # fmt: skip


def cube(X, size, rgba):
    return {"pose": pose_of(X), "size": vector(size), "color": colour(rgba)}


def sphere(position, radius, rgba):
    return {"pose": pose(position), "size": vector([2 * radius] * 3), "color": colour(rgba)}


def cylinder(X, radius, length, rgba):
    return {"pose": pose_of(X), "size": vector([2 * radius, 2 * radius, length]), "bottom_scale": 1.0, "top_scale": 1.0, "color": colour(rgba)}


def loop(points, thickness, rgba):
    return {"type": LINE_LOOP, "pose": pose(), "thickness": thickness, "scale_invariant": False, "points": [vector(p) for p in points],
            "color": colour(rgba), "colors": [], "indices": []}  # fmt: skip


def triangles(points, indices, rgba):
    return {"pose": pose(), "points": [vector(p) for p in points], "color": colour(rgba), "colors": [], "indices": [int(i) for i in indices]}


def moment(nanoseconds):
    return {"sec": nanoseconds // 10**9, "nsec": nanoseconds % 10**9}


def entity(name, frame, time, locked=False, **primitives):
    """A part of the scene, until it is replaced."""
    return {"timestamp": moment(time), "frame_id": frame, "id": name, "lifetime": moment(0), "frame_locked": locked, "metadata": [],
            **{kind: primitives.get(kind, []) for kind in LISTS}}  # fmt: skip
