"""What pushed the robot from outside."""

import re

import numpy as np

TOLD = 0.38  # share of a force that is told: less is within 22.5° of the others
LEAST = 1e-6  # less is of a step that a push touches by rounding [N]


def outside_forces(truth, numbers, model):
    """(from, to, text) of each force on a body, in the order of their begin; it acts on where `to` is None. The truth of a tick has what
    acted in the step before it. `truth`: times [ns] and table."""
    times, table = truth
    time, width = 1e-9 * times, len(table["xfrc_applied"][0].as_py() or ()) if len(times) else 0
    forces = numbers(table, "xfrc_applied", width).reshape(len(times), width // 6, 6)[:, :, :3] if width else np.zeros((0, 0, 3))
    quaternions = numbers(table, "q_WB", 4)
    names = ["world", *re.findall(r'<body name="([^"]*)"', model)]
    found = []
    for body in range(1, forces.shape[1]):
        sizes = np.linalg.norm(forces[:, body], axis=1)
        edges = np.diff(np.concatenate([[0], (sizes > LEAST).astype(int), [0]]))
        for begin, end in zip(np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)):
            largest = begin + int(np.argmax(sizes[begin:end] > (1 - 1e-6) * sizes[begin:end].max()))
            to = float(time[end - 1]) if end < len(time) else None
            name = "the base" if body == 1 else names[body] if body < len(names) else f"body {body}"
            text = f"{sizes[largest]:.3g} N{direction(forces[largest, body], quaternions[largest])}, on {name}"
            found.append((float(time[max(begin - 1, 0)]), to, text))
    return sorted(found, key=lambda force: force[0])


def direction(force, q):
    """As logging/applied_force.cpp has it."""
    w, x, y, z = q
    yaw = np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    size, parts = np.linalg.norm(force), []
    if np.hypot(*force[:2]) > TOLD * size:
        degrees = round(np.degrees(np.remainder(np.arctan2(force[1], force[0]) - yaw + np.pi, 2 * np.pi) - np.pi))
        side = "" if degrees in (0, 180, -180) else " to the left" if degrees > 0 else " to the right"
        parts.append(f"{abs(degrees)}° from ahead{side}")
    if abs(force[2]) > TOLD * size:
        parts.append("upwards" if force[2] > 0 else "downwards")
    return ", " + " and ".join(parts)
