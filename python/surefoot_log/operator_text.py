"""What the operator of a run did, in the words of surefoot/explain/operator_text.cpp."""

import json
import math

TOLD = 0.38  # share of a force that is told: less is within 22.5° of the others
WORDS = (("forwards", "backwards"), ("to the left", "to the right"), ("upwards", "downwards"))


def heading_of(state):
    """Of a message on /state [rad]; None where it is not known."""
    if state is None:
        return None
    w, x, y, z = json.loads(bytes(state))["q_WB"]
    return None if None in (w, x, y, z) else math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def direction_text(force, yaw):
    """Where a force in W goes as the robot sees it; empty where that is not known."""
    size = 0.0 if None in force else math.hypot(*force)
    if yaw is None or size == 0.0:
        return ""
    x, y, z = (component / size for component in force)
    seen = (math.cos(yaw) * x + math.sin(yaw) * y, math.cos(yaw) * y - math.sin(yaw) * x, z)
    return " and ".join(words[0 if share > 0 else 1] for share, words in zip(seen, WORDS) if abs(share) >= TOLD)


def operator_text(change, yaw):
    """Of a message on /changes, decoded."""
    kind, force = change["kind"], change["force"]
    size = 0.0 if None in force else math.hypot(*force)
    direction = f" {found}" if (found := direction_text(force, yaw)) else ""
    if kind == "push":
        duration = change["duration"]
        return f"the operator pushes {change['body']} with {size * duration:.3g} N·s{direction} ({size:.3g} N for {duration:.3g} s)"
    return f"{change['text']}, by the operator" if kind in ("friction", "stack") else change["text"]
