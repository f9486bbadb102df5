"""The simulated ground of a log's header as Foxglove's primitives."""

import numpy as np

from surefoot_log import foxglove_shapes as shapes

GROUND = (0.86, 0.86, 0.84, 1.0)
PLANE = (40.0, 40.0, 0.02)  # m: what is shown of an endless plane


def height_field(piece):
    columns, rows = piece["columns"], piece["rows"]
    x = np.linspace(-0.5, 0.5, columns) * piece["size"][0] + piece["position"][0]
    y = np.linspace(-0.5, 0.5, rows) * piece["size"][1] + piece["position"][1]
    z = np.array(piece["heights"]).reshape(rows, columns) + piece["position"][2]
    points = np.column_stack([np.tile(x, rows), np.repeat(y, columns), z.ravel()])
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    faces = np.column_stack([corner, corner + 1, corner + columns + 1, corner, corner + columns + 1, corner + columns])
    return shapes.triangles(np.round(points, 4), faces.ravel(), GROUND)


def ground_entity(terrain, frame):
    cubes, triangles = [], []
    for piece in terrain:
        X = shapes.transform(piece["position"], piece["q_SG"])
        if piece["shape"] == "box":
            cubes.append(shapes.cube(X, piece["size"], GROUND))
        elif piece["shape"] == "plane":
            X[:3, 3] -= X[:3, 2] * PLANE[2] / 2
            cubes.append(shapes.cube(X, PLANE, GROUND))
        else:
            triangles.append(height_field(piece))
    return shapes.entity("ground", frame, 0, cubes=cubes, triangles=triangles)
