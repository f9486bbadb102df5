"""What pictures show of a run's ticks, from its log."""

import json
from dataclasses import dataclass, field

import numpy as np

from surefoot_log.log_file import event_text, stop_reason
from surefoot_log.worlds import rotated

LEGS = ("LF", "RF", "LH", "RH")
ALL_LEGS = ("LF", "RF", "LM", "RM", "LH", "RH", "L", "R")  # of robots with six and with two
CARRIES = ("stance", "unloading")
BETWEEN = "; "  # of two events at one tick
TOPICS = {"/truth", "/alignment", "/plan", "/state", "/hierarchy", "/command"}
ROUNDING = 1e-6  # in any unit; for logs that don't say from which residual on a level gives way
OPTIMAL, ITERATION_CAP, INVALID_INPUT = 0, 1, 2  # of /hierarchy.status
LOADED = 20.0  # N: least force on a foot that carries
LEAST_PUSH = 1e-6  # N: less is rounding at the ends of a push


@dataclass(frozen=True)
class Touch:
    """A foot on the ground."""

    leg: str
    point: np.ndarray
    force: np.ndarray  # of the ground [N]
    normal: np.ndarray  # of the ground, out of it
    friction: float  # coefficient

    @property
    def load(self):
        """Along the normal [N]."""
        return float(self.normal @ self.force)

    @property
    def friction_use(self):
        """Share of the friction cone that the force uses."""
        if self.load <= 0.0 or self.friction <= 0.0:
            return 0.0
        return float(np.linalg.norm(self.force - self.load * self.normal)) / (self.friction * self.load)


@dataclass
class Frame:
    """A tick; all vectors in the simulator's world S; of a log without truth in the controller's."""

    time: float
    qpos: list
    p_SB: np.ndarray
    p_SCom: np.ndarray | None = None
    p_SF: dict = field(default_factory=dict)
    forces: list = field(default_factory=list)  # of each touching foot a Touch
    R_WS: np.ndarray | None = None  # S lies so in the controller's world, by the feet that stand
    p_WS: np.ndarray | None = None
    pushes: list = field(default_factory=list)  # (number of the body in the physics, force [N], torque about its centre of mass [N·m])
    phases: dict = field(default_factory=dict)
    event: str = ""
    event_time: float | None = None  # where that is not the frame's own [s]
    mode: str = "optimal"
    stop: str = ""  # why the controller has stopped for safety; empty: it has not
    gave_way: tuple | None = None  # (level, residual, rows of a level above that are at their limits, that level, other levels that gave way)
    gave_way_time: float | None = None  # where that is not the frame's own [s]

    @property
    def carrying(self):
        """Legs that are to carry the robot and, where the truth is known, touch the ground."""
        touching = {touch.leg for touch in self.forces}
        return [leg for leg, phase in self.phases.items() if phase in CARRIES and (self.p_SCom is None or leg in touching)]

    @property
    def carrying_feet(self):
        """Where these legs stand; none where the truth is not known."""
        return [self.p_SF[leg] for leg in self.carrying if leg in self.p_SF]


@dataclass
class Run:
    header: dict
    frames: list
    has_truth: bool
    last: float  # time of the last tick, which may be none of the frames [s]


def read_frames(log, every=1):
    """Makes a frame of one of `every` ticks."""
    maker = FrameMaker(log, every)
    frames, last = [], 0.0
    for time, messages in log.by_time(TOPICS):
        frame = maker.frame(messages)
        if frame is not None:
            frames.append(frame)
        last = max(last, 1e-9 * time)
    if not frames:
        raise log.no_tick("show")
    return Run(log.header, frames, maker.has_truth, last)


class FrameMaker:
    """Makes frames tick by tick; an event stands in the frame that follows it."""

    def __init__(self, log, every=1):
        self._header, self._events, self._every, self._number = log.header, list(log.events), every, -1
        self._event, self._event_time, self._stop = "", None, ""
        self.has_truth = False

    def frame(self, messages):
        """The frame of the messages of one time; None if that tick is not shown."""
        found = {message.topic: message.data for message in messages}
        self._see_events(1e-9 * messages[0].time)
        if "/state" not in found:
            return None
        self._number += 1
        if self._number % self._every != 0:
            return None
        made = frame_of({topic: found[topic] for topic in TOPICS & found.keys()}, self._header, self._event)
        if made is not None:
            made.event_time, made.stop = self._event_time if self._event else None, self._stop
            self._event, self.has_truth = "", self.has_truth or "/truth" in found
        return made

    def _see_events(self, time):
        """Keeps the planner's last events, and why the controller has stopped."""
        texts = []
        while self._events and self._events[0]["time"] < time + 1e-9:
            event = self._events.pop(0)
            if event["by"] == "planner":
                texts.append(event_text(event))
                self._event_time = event["time"]
            elif event["by"] == "controller":
                self._stop = stop_reason(event)
        self._event = BETWEEN.join(texts) or self._event


def legs_of(header):
    """The names of a robot's legs, in its order; logs of four legs don't have them."""
    return tuple(header["robot"].get("legs", LEGS))


def frame_of(tick, header, event):
    decoded = {topic: json.loads(bytes(data)) for topic, data in tick.items()}
    state, truth = decoded.get("/state"), decoded.get("/truth")
    if state is None or (truth is None and None in state["p_WB"] + state["q"]):
        return None
    seen = truth or {"qpos": state["p_WB"] + state["q_WB"] + state["q"], "p_SB": state["p_WB"]}
    frame = Frame(state["time"], seen["qpos"], np.array(seen["p_SB"]), event=event)
    frame.phases = {leg: foot["phase"] for leg, foot in decoded.get("/plan", {}).get("feet", {}).items()}
    frame.mode = decoded.get("/command", {}).get("mode", "optimal")
    frame.gave_way = gave_way(decoded.get("/hierarchy", {}), header)
    if truth is not None:
        add_truth(frame, truth)
    feet = decoded.get("/alignment", {}).get("feet")
    if feet is not None and None not in feet["q_WS"]:
        frame.p_WS = np.array(feet["p_WS"])
        frame.R_WS = np.stack([rotated(np.array(feet["q_WS"]), axis) for axis in np.eye(3)], axis=-1)
    return frame


def add_truth(frame, truth):
    frame.p_SCom = np.array(truth["p_SCom"])
    frame.p_SF = {leg: np.array(place) for leg, place in truth["p_SF"].items()}
    for leg, foot in truth["feet"].items():
        if foot["touching"]:
            frame.forces.append(Touch(leg, *(np.array(foot[name]) for name in ("point", "force", "normal")), foot["friction"]))
    pushes = np.array(truth["xfrc_applied"]).reshape(-1, 6)
    frame.pushes = [(body, push[:3], push[3:]) for body, push in enumerate(pushes) if np.linalg.norm(push[:3]) > LEAST_PUSH]


def visible_residuals(header):
    """The residual from which on each level gave way; None: it is never zero by nature."""
    names = header["level_names"]
    return dict(zip(names, header.get("level_visible", [None if name.endswith("_minimisation") else ROUNDING for name in names])))


def solved_levels(hierarchy):
    """The levels of a message on /hierarchy that are at their optimum. If the solve was cut off, the numbers of others mean nothing."""
    levels, status, failed = hierarchy.get("levels", []), hierarchy.get("status", OPTIMAL), hierarchy.get("failed_level", -1)
    if status == INVALID_INPUT:
        return []
    return levels[:failed] if status == ITERATION_CAP and failed >= 0 else levels


def gave_way(hierarchy, header):
    """The highest level that did not get what it asked for, its residual, the acting limits of the nearest level above that has some, that level,
    and the other levels that gave way. During a transition between hierarchies the limits are unknown: None."""
    visible = visible_residuals(header)
    yielding = {}
    for level in solved_levels(hierarchy):
        residual, least = level["residual"] or 0.0, visible.get(level["name"], ROUNDING)
        if least is not None and residual > least:
            yielding[level["name"]] = residual
    if not yielding:
        return None
    name = next(iter(yielding))
    is_blended = hierarchy.get("transition_share", 1.0) < 1.0
    limits, by = (None, None) if is_blended else limits_above(name, hierarchy)
    return name, yielding[name], limits, by, tuple(other for other in yielding if other != name)


def limits_above(name, hierarchy):
    """The rows of the nearest level above that are at their bounds or beyond, and that level; ((), "") if there is none."""
    levels = [level["name"] for level in hierarchy["levels"]]
    for by in reversed(levels[: levels.index(name)]):
        rows = tuple(row["row"] for row in hierarchy.get("active", []) if row["level"] == by)
        if rows:
            return rows, by
    return (), ""
