"""What a campaign leaves in its folder, and what it prints at the end."""

import collections
import csv
import io
import json

from surefoot_campaign.outcome import OUTCOMES
from surefoot_campaign.pairs import pairs, pairs_rows
from surefoot_campaign.program import yaml_text
from surefoot_campaign.results import Table, csv_text, is_number
from surefoot_campaign.spec import CASE
from surefoot_campaign.statistics import rate_of, summary_of
from surefoot_campaign.text import aligned
from surefoot_campaign.worst import entry, told, worst, worst_text


def points(plan, records):
    """Each point of the grid that has runs, in the order of the plan."""
    of_point = collections.defaultdict(list)
    for record in records:
        of_point[record.run.point].append(record)
    return [of_point[number] for number in sorted(of_point)]


def columns(plan):
    """What tells the points of a scenario apart."""
    return [CASE] * bool(plan.spec.cases) + list(plan.spec.grid)


def judged(plan, records):
    values = [value for record in records if (value := record.metric(plan.spec.judge)) is not None]
    return summary_of(values, plan.metrics[plan.spec.judge]["worst"])


def point_json(plan, records):
    run = records[0].run
    parameters = ({CASE: run.case} if plan.spec.cases else {}) | {key: run.parameters[key] for key in plan.spec.grid}
    outcomes = collections.Counter(record.row["outcome"] for record in records)
    counts = {outcome: outcomes[outcome] for outcome in OUTCOMES}
    return {"scenario": run.scenario, "parameters": parameters, **rate_of(records).as_json(), "outcomes": counts, "judge": judged(plan, records)}


def summary(plan, records, program, table):
    outcomes = collections.Counter(record.row["outcome"] for record in records)
    return {
        "name": plan.spec.name,
        "version": plan.version,
        "runs": {"planned": len(plan.runs), "finished": len(records), **{key: outcomes[key] for key in OUTCOMES}},
        "judge": plan.spec.judge,
        "all": rate_of(records).as_json(),
        "points": [point_json(plan, of_point) for of_point in points(plan, records)],
        "worst": [entry(plan, record, program) for record in worst(plan, records)],
        "pairs": pairs(plan, records),
        "digest": table.digest(),
    }


def rates_csv(plan, found):
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(
        ["scenario", *columns(plan), "successes", "trials", "rate", "low", "high", *OUTCOMES[1:]]
        + [f"{plan.spec.judge}.median", f"{plan.spec.judge}.worst"]
    )
    for point in found["points"]:
        cells = [value if is_number(value) else yaml_text(value) for value in point["parameters"].values()]
        cells += [point["successes"], point["trials"], point["rate"], *point["interval"]]
        cells += [point["outcomes"][outcome] for outcome in OUTCOMES[1:]]
        writer.writerow(map(csv_text, [point["scenario"], *cells, point["judge"]["median"], point["judge"]["worst"]]))
    return text.getvalue()


def write_all(plan, records, program, folder):
    """Table, rates, worst runs and summary; returns the summary."""
    table = Table(plan, records)
    found = summary(plan, records, program, table)
    table.write(folder)
    (folder / "rates.csv").write_text(rates_csv(plan, found))
    (folder / "worst.md").write_text(worst_text(plan, records, program))
    (folder / "summary.json").write_text(json.dumps(found, indent=1, ensure_ascii=False) + "\n")
    return found


def number(value):
    return "–" if value is None else f"{value:.3g}"


def rate_cells(entry):
    low, high = entry["interval"]
    return [f"{entry['successes']}/{entry['trials']}", f"{100 * entry['rate']:.0f} %", f"{100 * low:.0f}–{100 * high:.0f} %"]


def others(outcomes):
    """What is not simply a success or a failure."""
    return ", ".join(f"{outcomes[name]} {name.replace('_', ' ')}" for name in OUTCOMES[2:] if outcomes[name])


def short_table(plan, found, folder):
    """A line for each point of the grid, the worst run, and where the rest is."""
    judge = plan.spec.judge
    rows = [["scenario", *columns(plan), "succeeded", "rate", "95 %", f"{judge} median", "worst", ""]]
    for point in found["points"]:
        values = [yaml_text(value) for value in point["parameters"].values()]
        measured = [number(point["judge"]["median"]), number(point["judge"]["worst"])]
        rows.append([point["scenario"], *values, *rate_cells(point), *measured, others(point["outcomes"])])
    text = aligned(rows)
    if found["worst"]:
        first = found["worst"][0]
        text += f"\nworst: {told(plan, first)}\n  {first['command']}\n"
    if found["pairs"]:
        text += "\nseed by seed against " + f'"{found["pairs"][0]["against"]}":\n' + aligned(pairs_rows(found["pairs"], judge))
    return text + f"\nall of it: {folder}/  digest {found['digest']}\n"
