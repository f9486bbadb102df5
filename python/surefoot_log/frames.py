"""What pictures show of a run's ticks, from its log."""

import json
from dataclasses import dataclass, field

import numpy as np

from surefoot_campaign.errors import InputError

LEGS = ("LF", "RF", "LH", "RH")
CARRIES = ("stance", "unloading")
TOPICS = {"/truth", "/plan", "/state", "/hierarchy", "/command"}
ROUNDING = 1e-6  # in every unit
RESTLESS = "_minimisation"  # levels that ask for nothing at all are never content
LOADED = 20.0  # N: what a foot that carries has at least


@dataclass
class Frame:
    """A tick; all vectors in the simulator's W, where the log has its truth."""

    time: float
    qpos: list
    p_WB: np.ndarray
    p_WCom: np.ndarray | None = None
    p_WF: dict = field(default_factory=dict)
    forces: list = field(default_factory=list)  # (leg, point, force [N], friction coefficient)
    pushes: list = field(default_factory=list)  # force [N] on the base
    phases: dict = field(default_factory=dict)
    event: str = ""
    mode: str = "optimal"
    gave_way: tuple | None = None  # (level, residual, row that cost most, level of that row)


@dataclass
class Run:
    header: dict
    frames: list
    has_truth: bool


def read_frames(log, every=1):
    """One frame of so many ticks; an event stands in the frame that follows it."""
    log_frames, has_truth, tick, number, event = [], False, {}, -1, ""
    for message in log.messages(TOPICS):
        if message.topic == "/state":
            if tick and number % every == 0:
                log_frames.append(frame_of(tick, log.header, event))
                event = ""
            number, tick = number + 1, {}
        if message.topic == "/plan":
            event = event_of(message.data, log.header) or event
        if number % every == 0:
            tick[message.topic] = message.data
            has_truth = has_truth or message.topic == "/truth"
    if tick and number % every == 0:
        log_frames.append(frame_of(tick, log.header, event))
    frames = [frame for frame in log_frames if frame is not None]
    if not frames:
        raise InputError(f"{log.path}: the log holds no tick, so there is nothing to show")
    return Run(log.header, frames, has_truth)


def event_of(data, header):
    """The text of an event, if there is one in a message on /plan; "event" is its last member."""
    tail = bytes(data[-24:])
    if tail.endswith(b'"event":0}'):
        return ""
    number = json.loads(bytes(data))["event"]
    names = header["event_names"]
    return names[number] if 0 < number < len(names) else ""


def frame_of(tick, header, event):
    decoded = {topic: json.loads(bytes(data)) for topic, data in tick.items()}
    state, plan = decoded.get("/state"), decoded.get("/plan", {})
    truth = decoded.get("/truth")
    if state is None or (truth is None and None in state["p_WB"] + state["q"]):
        return None
    seen = truth or {"qpos": state["p_WB"] + state["q_WB"] + state["q"], "p_WB": state["p_WB"]}
    frame = Frame(state["time"], seen["qpos"], np.array(seen["p_WB"]), event=event)
    frame.phases = {leg: foot["phase"] for leg, foot in plan.get("feet", {}).items()}
    frame.mode = decoded.get("/command", {}).get("mode", "optimal")
    frame.gave_way = gave_way(decoded.get("/hierarchy", {}))
    if truth is not None:
        add_truth(frame, truth)
    return frame


def add_truth(frame, truth):
    frame.p_WCom = np.array(truth["p_WCom"])
    frame.p_WF = {leg: np.array(truth["p_WF"][leg]) for leg in LEGS}
    for leg in LEGS:
        foot = truth["feet"][leg]
        if foot["touching"]:
            frame.forces.append((leg, np.array(foot["point"]), np.array(foot["force"]), foot["friction"]))
    pushes = np.array(truth["xfrc_applied"]).reshape(-1, 6)[:, :3]
    frame.pushes = [push for push in pushes if push.any()]


def gave_way(hierarchy):
    """The highest level that did not get what it asked for, and what held it back most."""
    for level in hierarchy.get("levels", []):
        residual = level["residual"] or 0.0
        if residual <= ROUNDING or level["name"].endswith(RESTLESS):
            continue
        for row in hierarchy.get("blocked_by", []):
            if row["level"] == level["name"]:
                return level["name"], residual, row["row"], row["by"]
    return None


def friction_use(force, coefficient):
    """Share of the friction cone, about the vertical, that a ground force uses."""
    tangential = float(np.hypot(force[0], force[1]))
    return tangential / (coefficient * force[2]) if force[2] > 0.0 and coefficient > 0.0 else 0.0


def friction_of(frame):
    return {leg: friction_use(force, mu) for leg, _, force, mu in frame.forces if force[2] > LOADED}
