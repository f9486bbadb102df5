"""The simulated ground of a run, as its log has it."""

import numpy as np

from surefoot_report.run_data import matrices

UPRIGHT = 1e-6  # a face whose normal has a smaller z is vertical


class Ground:
    """The highest piece of the terrain at each place."""

    FACES = 6  # of a piece at most

    def __init__(self, terrain):
        self._pieces = terrain or []

    def __bool__(self):
        return bool(self._pieces)

    def at(self, x, y):
        """Arrays of the face there (the same within a smooth patch, −1: no ground), height, and slope along x and y."""
        x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        face, z, slope = np.full(x.shape, -1), np.full(x.shape, np.nan), np.zeros((*x.shape, 2))
        for number, piece in enumerate(self._pieces):
            found, height, rise = SHAPES[piece["shape"]](piece, x, y)
            higher = (found >= 0) & ~(height <= z)
            face[higher], z[higher], slope[higher] = found[higher] + self.FACES * number, height[higher], rise[higher]
        return face, z, slope


def rotation(piece):
    return matrices(np.array(piece["q_SG"], float))


def plane_through(point, normal, x, y):
    slope = -normal[:2] / normal[2]
    return point[2] + slope[0] * (x - point[0]) + slope[1] * (y - point[1]), slope


def on_plane(piece, x, y):
    normal = rotation(piece)[:, 2]
    if normal[2] < UPRIGHT:
        return nowhere(x)
    z, slope = plane_through(np.array(piece["position"]), normal, x, y)
    return np.zeros(x.shape, int), z, np.broadcast_to(slope, (*x.shape, 2))


def nowhere(x):
    return np.full(x.shape, -1), np.full(x.shape, np.nan), np.zeros((*x.shape, 2))


def on_box(piece, x, y):
    """The face that a ray from above enters through: the lowest top of its three slabs."""
    R = rotation(piece)
    face, top, slope = np.full(x.shape, -1), np.full(x.shape, np.inf), np.zeros((*x.shape, 2))
    bottom, outside = np.full(x.shape, -np.inf), np.zeros(x.shape, bool)
    for number in range(6):
        normal = (2 * (number % 2) - 1) * R[:, number // 2]
        point = np.array(piece["position"]) + 0.5 * piece["size"][number // 2] * normal
        if abs(normal[2]) < UPRIGHT:
            outside |= normal[0] * (x - point[0]) + normal[1] * (y - point[1]) > normal[2] * point[2]
            continue
        z, rise = plane_through(point, normal, x, y)
        if normal[2] < 0:
            bottom = np.maximum(bottom, z)
            continue
        lower = z < top
        face[lower], top[lower], slope[lower] = number, z[lower], rise
    face[outside | (bottom >= top)] = -1
    return face, top, slope


def on_heights(piece, x, y):
    """Between the points of the grid, bilinear."""
    columns, rows, size = piece["columns"], piece["rows"], piece["size"]
    if columns < 2 or rows < 2:
        return nowhere(x)
    cell = np.array([size[0] / (columns - 1), size[1] / (rows - 1)])
    u, v = (x - piece["position"][0] + 0.5 * size[0]) / cell[0], (y - piece["position"][1] + 0.5 * size[1]) / cell[1]
    inside = (u >= 0) & (v >= 0) & (u <= columns - 1) & (v <= rows - 1)
    i, j = (np.clip(place, 0, last).astype(int) for place, last in ((u, columns - 2), (v, rows - 2)))
    heights = np.array(piece["heights"]).reshape(rows, columns)
    u, v = u - i, v - j
    low, high = ((1 - u) * heights[row, i] + u * heights[row, i + 1] for row in (j, j + 1))
    slope = np.stack([(heights[j, i + 1] - heights[j, i]) / cell[0], (high - low) / cell[1]], axis=-1)
    return np.where(inside, 0, -1), piece["position"][2] + (1 - v) * low + v * high, slope


SHAPES = {"plane": on_plane, "box": on_box, "heights": on_heights}
