"""What a log says of how its run came out."""

import json
from contextlib import suppress
from dataclasses import dataclass, field

from surefoot_report.words import decimal

BROKEN_OFF = ("interrupted", "begun again")  # reasons that are no end
OTHER_SHAPE = (ValueError, KeyError, TypeError, AttributeError, RecursionError)


@dataclass
class Requirement:
    """A criterion of the run; `passed` is None where it was not judged."""

    metric: str
    min: float | None = None
    max: float | None = None
    equals: bool | None = None
    passed: bool | None = None

    def __post_init__(self):
        numbers, flags = (self.min, self.max), (self.equals, self.passed)
        if any(isinstance(value, str) for value in numbers) or any(value not in (None, True, False) for value in flags):
            raise TypeError(self)


@dataclass
class Outcome:
    known: bool = False  # the log has a summary that can be read; else nothing is judged
    judged: bool = False  # the run was as long as its criteria need
    succeeded: bool = False
    reason: str = ""
    goal: str = ""  # what the scenario is for, in words
    goal_reached: bool = False
    metrics: dict = field(default_factory=dict)  # of a distribution its members: "tick_us.median"
    criteria: list = field(default_factory=list)
    paper: dict = field(default_factory=dict)  # what the paper says of a metric

    @property
    def interrupted(self):
        """Whether the run was interrupted or begun again, so that nothing is judged."""
        return self.reason in BROKEN_OFF

    def criterion(self, metric):
        return next((one for one in self.criteria if one.metric == metric), None)


def asked(criteria):
    """The criteria as the scenario gives them: `fell: false`, `speed_mps: {min: 0.18}`."""
    limits = {metric: {"equals": limit} if isinstance(limit, bool) else limit for metric, limit in criteria.items()}
    return [Requirement(metric, limit.get("min"), limit.get("max"), limit.get("equals")) for metric, limit in limits.items() if limit]


def goal_of(goal):
    walk_on = goal.get("walk_on") or 0.0
    further = f", and {decimal(walk_on, 3)} m further" if walk_on > 0 else ""
    return f"all feet on the ground beyond x = {decimal(goal['feet_beyond_x'], 3)} m{further}"


def flattened(metrics):
    found = {}
    for name, value in metrics.items():
        found |= {f"{name}.{part}": number for part, number in value.items()} if isinstance(value, dict) else {name: value}
    return found


def read_summary(outcome, summary):
    found = json.loads(summary)
    metrics = found["metrics"]
    judged = metrics.get("reason", "") + "" not in BROKEN_OFF
    criteria = [Requirement(one["metric"], one.get("min"), one.get("max"), one.get("equals"), one.get("passed") if judged else None)
                for one in found["criteria"]]  # fmt: skip
    outcome.known, outcome.criteria, outcome.reason, outcome.metrics = True, criteria, metrics.get("reason", ""), flattened(metrics)
    outcome.judged = metrics.get("succeeded") is not None
    outcome.succeeded, outcome.goal_reached = metrics.get("succeeded") is True, metrics.get("goal_reached") is True


def read_outcome(summary, options):
    """From the log's summary (JSON) and the options of its header; what is not there, or of another shape, is left out."""
    outcome = Outcome()
    with suppress(*OTHER_SHAPE):
        outcome.criteria = asked(options["criteria"])
    with suppress(*OTHER_SHAPE):
        outcome.goal = goal_of(options["goal"])
    with suppress(*OTHER_SHAPE):
        paper = {metric: figure for metric, figure in options["paper"].items() if figure is not None}
        outcome.paper = {metric: figure if isinstance(figure, str) else json.dumps(figure) for metric, figure in paper.items()}
    with suppress(*OTHER_SHAPE):
        read_summary(outcome, summary)
    return outcome
