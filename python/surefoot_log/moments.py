"""Which part of a run a few pictures should show."""

from dataclasses import dataclass

import numpy as np

from surefoot_log.frames import ALL_LEGS, BETWEEN, CARRIES

STEP = 0.03  # m: feet that carry at heights that differ by more are on different ground
BEFORE, AFTER = 1.5, 1.5  # s around what is of interest
QUIET = ("", "lift-off", "touchdown", "probe: same ground")
APART = 0.4  # least distance of two moments, as a share of the mean one
STARTED = 0.05  # m: a base that has gone so far walks


@dataclass(frozen=True)
class Span:
    first: float  # s
    last: float

    @property
    def length(self):
        return self.last - self.first


def is_quiet(event):
    """Whether every step of a walk has such events."""
    found = [one.partition(": ") for one in event.split(BETWEEN)]
    return all((what if leg in ALL_LEGS else leg + colon + what) in QUIET for leg, colon, what in found)


def is_of_interest(frame):
    """The robot stands on different heights, searches, is pushed, or meets what it did not expect."""
    heights = [position[2] for leg, position in frame.p_SF.items() if frame.phases.get(leg) in CARRIES]
    on_a_step = len(heights) > 1 and max(heights) - min(heights) > STEP
    return on_a_step or "search" in frame.phases.values() or bool(frame.pushes) or not is_quiet(frame.event) or frame.mode != "optimal"


def started(frames):
    return next((frame.time for frame in frames if np.hypot(*(frame.p_SB - frames[0].p_SB)[:2]) > STARTED), frames[0].time)


def span_of_interest(frames):
    """From a little before the first to a little after the last such tick; else the walk."""
    times = [frame.time for frame in frames if is_of_interest(frame)]
    first = times[0] - BEFORE if times else started(frames)
    last = times[-1] + AFTER if times else frames[-1].time
    return Span(max(first, frames[0].time), min(last, frames[-1].time))


def shortened(frames, span, length):
    """The part of a span, so long, in which the torso turns and sinks most."""
    if span.length <= length:
        return span
    inside = [frame for frame in frames if span.first <= frame.time <= span.last]
    motion = np.abs(np.diff([np.append(frame.qpos[3:7], frame.p_SB[2]) for frame in inside], axis=0)).sum(axis=1)
    sums = np.append(0.0, np.cumsum(motion))
    times = np.array([frame.time for frame in inside])
    ends = np.searchsorted(times, times + length, side="right") - 1
    whole = times + length <= span.last + 1e-9
    best = int(np.argmax(np.where(whole, sums[ends] - sums, -1.0)))
    return Span(float(times[best]), float(times[best]) + length)


def reach(frame):
    """How far a foot in the air is below the base [m]; where all stand, half of that of the lowest foot."""
    depths = {leg: frame.p_SB[2] - position[2] for leg, position in frame.p_SF.items()}
    in_air = [depth for leg, depth in depths.items() if frame.phases.get(leg) not in CARRIES]
    return max(in_air, default=0.5 * max(depths.values(), default=0.0))


def chosen(frames, span, count):
    """`count` frames, one of each equal part of a span, off its ends: where a leg reaches deepest below the base."""
    edges = np.linspace(span.first, span.last, count + 1)
    apart = APART * (edges[1] - edges[0]) / 2
    found = []
    for first, last in zip(edges, edges[1:]):
        part = [frame for frame in frames if first + apart <= frame.time <= last - apart]
        if part:
            found.append(max(part, key=reach))
    return found or [frames[-1]]
