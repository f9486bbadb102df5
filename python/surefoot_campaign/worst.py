"""The worst runs, each with the command that replays it."""

import pathlib

from surefoot_campaign.results import missed
from surefoot_campaign.text import in_words, pretty

COUNT = 10


def severity(record):
    """0: the robot fell or was stopped, or the program did not come to an end; 1: criteria were missed; 2: none were."""
    result = record.row["result"] or {}
    if record.succeeded:
        return 2
    broke = record.row["outcome"] not in ("failed", "not_judged") or result.get("fell") or result.get("safety_stop")
    return 0 if broke else 1


def worst(plan, records):
    """Falls, stops and crashes first, then missed criteria; of each what gave no value, then by the metric that judges."""
    judge = plan.spec.judge
    sign = 1 if plan.metrics[judge]["worst"] == "least" else -1

    def key(record):
        value = record.metric(judge)
        return severity(record), value is not None, 0.0 if value is None else sign * value

    return sorted(records, key=key)[:COUNT]


def entry(plan, record, program):
    """A run as the summary has it."""
    judge = plan.spec.judge
    return {
        "id": record.run.id,
        "outcome": record.row["outcome"],
        "reason": record.row["reason"],
        "missed": missed(record.row["result"] or {}),
        judge: record.metric(judge),
        "command": program.command(record.run),
    }


def in_one_line(plan, entry):
    """Outcome, why the run ended, the criteria that it missed, and the metric that judges."""
    judge = plan.spec.judge
    text = f"{in_words(entry['outcome'])}: {entry['reason']}"
    if entry["missed"]:
        text += f"; missed: {', '.join(entry['missed'])}"
    return text if entry[judge] is None else f"{text}; {judge} {pretty(judge, entry[judge])}"


def worst_text(plan, records, program):
    """A page of Markdown."""
    judge = plan.spec.judge
    lines = [
        f"# {plan.spec.name}: the worst runs",
        "",
        f"Falls, stops and crashes first, then missed criteria, each by `{judge}`.",
        f"The commands work in `{pathlib.Path.cwd()}`, where the campaign was started.",
        "",
    ]
    for number, record in enumerate(worst(plan, records), 1):
        of = entry(plan, record, program)
        lines += [f"{number}. {in_one_line(plan, of)} (`{of['id']}`)", "   ```sh", f"   {of['command']}", "   ```"]
    return "\n".join(lines) + "\n"
