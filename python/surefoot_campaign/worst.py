"""The worst runs, each with the command that replays it."""

COUNT = 10


def worst(plan, records, count=COUNT):
    """What failed first, and of those what gave no value; then by the metric that judges."""
    judge = plan.spec.judge
    sign = 1 if plan.metrics[judge]["worst"] == "least" else -1

    def key(record):
        value = record.metric(judge)
        return record.succeeded, value is not None, 0.0 if value is None else sign * value

    return sorted(records, key=key)[:count]


def worst_text(plan, records, program):
    """A page of Markdown."""
    judge = plan.spec.judge
    lines = [f"# {plan.spec.name}: the worst runs", "", f"What failed first, then by `{judge}`.", ""]
    for number, record in enumerate(worst(plan, records), 1):
        row, value = record.row, record.metric(judge)
        measured = "" if value is None else f", {judge} {value:.4g}"
        lines += [
            f"{number}. {row['outcome'].replace('_', ' ')}: {row['reason']}{measured} (`{row['id']}`)",
            "   ```sh",
            f"   {program.command(record.run.file, record.run.seed, record.run.parameters)}",
            "   ```",
        ]
    return "\n".join(lines) + "\n"
