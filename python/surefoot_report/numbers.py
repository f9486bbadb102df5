"""The run's numbers as a table: each under its one name, in its one unit, as everywhere."""

from surefoot_campaign.metrics import KEY, about, arrow, declared, is_first
from surefoot_campaign.text import pretty, with_unit
from surefoot_report.page import Cell, table

IN_TITLE = {"succeeded", "reason", "seed", "version"}
LEGEND = KEY.replace("`", "")
HEAD = ["metric", "this run", "", "what it is", "required", "paper"]


def limits(criterion):
    if criterion.equals is not None:
        return pretty("", criterion.equals)
    bounds = (("≥", criterion.min), ("≤", criterion.max))
    return ", ".join(f"{sign} {with_unit(criterion.metric, bound)}" for sign, bound in bounds if bound is not None)


def required(criterion):
    if criterion is None:
        return Cell("")
    text = limits(criterion)
    if criterion.passed is None:
        return Cell(f"{text}  (not judged)", "soft")
    return Cell(f"{text}  ✓ holds", "good nowrap") if criterion.passed else Cell(f"{text}  ✗ missed", "bad nowrap")


def is_compared(outcome, metric):
    return outcome.criterion(metric) is not None or metric in outcome.paper


def names(outcome):
    """All metrics in the order of their declaration, members of distributions after each other; then what else the log, its criteria or the paper name."""
    found = dict.fromkeys([*outcome.metrics, *(criterion.metric for criterion in outcome.criteria), *outcome.paper])
    order = {name: number for number, name in enumerate(declared())}
    return sorted((name for name in found if name not in IN_TITLE), key=lambda name: order.get(name.split(".")[0], len(order)))


def row(outcome, metric):
    return [Cell(metric), Cell(pretty(metric, outcome.metrics.get(metric)), "number"), Cell(arrow(metric)), Cell(about(metric).get("help", ""), "basis"),
            required(outcome.criterion(metric)), Cell(outcome.paper.get(metric, ""), "soft")]  # fmt: skip


def numbers(outcome):
    """First what a criterion limits or the paper has a figure of, then what matters most; below, the others."""
    compared = [metric for metric in names(outcome) if is_compared(outcome, metric)]
    first = [metric for metric in names(outcome) if is_first(metric) and metric in outcome.metrics and metric not in compared]
    others = [metric for metric in names(outcome) if metric not in compared + first]
    out = table(HEAD, [row(outcome, metric) for metric in compared + first], len(compared)) + f'<p class="soft">{LEGEND}.</p>\n'
    if others:
        count = len({metric.split(".")[0] for metric in others})  # a distribution is one, as in the terminal
        out += f"<details><summary>The other {count} metrics</summary>\n{table(HEAD, [row(outcome, metric) for metric in others])}</details>\n"
    return out
