"""What a campaign leaves in its folder, and what it prints at the end."""

import collections
import json

from surefoot_campaign.outcome import OUTCOMES
from surefoot_campaign.pairs import pairs, pairs_rows
from surefoot_campaign.program import yaml_text
from surefoot_campaign.results import Table, csv_table, plain, values_of
from surefoot_campaign.spec import CASE
from surefoot_campaign.statistics import rate_of, summary_of
from surefoot_campaign.text import aligned, in_words, pretty
from surefoot_campaign.worst import entry, in_one_line, worst, worst_text


def points(plan, records):
    """Each point of the grid that has runs, in the order of the plan."""
    of_point = collections.defaultdict(list)
    for record in records:
        of_point[record.run.point].append(record)
    return [of_point[number] for number in sorted(of_point)]


def columns(plan):
    """What distinguishes the points of a scenario."""
    return [CASE] * bool(plan.spec.cases) + list(plan.spec.grid)


def outcomes_of(records):
    """The number of runs of each outcome."""
    counted = collections.Counter(record.row["outcome"] for record in records)
    return {outcome: counted[outcome] for outcome in OUTCOMES}


def point_json(plan, records):
    run, judge = records[0].run, plan.spec.judge
    judged = summary_of(values_of(records, judge), plan.metrics[judge]["worst"])
    return {"scenario": run.scenario, "parameters": run.place(plan.spec), **rate_of(records).as_json(), "outcomes": outcomes_of(records), "judge": judged}


def summary(plan, records, program, table):
    return {
        "name": plan.spec.name,
        "version": plan.version,
        "runs": {"planned": len(plan.runs), "finished": len(records), **outcomes_of(records)},
        "judge": plan.spec.judge,
        "all": rate_of(records).as_json(),
        "points": [point_json(plan, of_point) for of_point in points(plan, records)],
        "worst": [entry(plan, record, program) for record in worst(plan, records)],
        "pairs": pairs(plan, records),
        "digest": table.digest(),
    }


def rates_csv(plan, found):
    judged = [f"{plan.spec.judge}.median", f"{plan.spec.judge}.worst"]
    rows = [["scenario", *columns(plan), "successes", "trials", "rate", "low", "high", *OUTCOMES[1:], *judged]]
    for point in found["points"]:
        cells = [*map(plain, point["parameters"].values()), point["successes"], point["trials"], point["rate"], *point["interval"]]
        cells += [point["outcomes"][outcome] for outcome in OUTCOMES[1:]]
        rows.append([point["scenario"], *cells, point["judge"]["median"], point["judge"]["worst"]])
    return csv_table(rows)


def write_all(plan, records, program, folder):
    """Table, rates, worst runs and summary; returns the summary."""
    table = Table(plan, records)
    found = summary(plan, records, program, table)
    table.write(folder)
    (folder / "rates.csv").write_text(rates_csv(plan, found), encoding="utf-8")
    (folder / "worst.md").write_text(worst_text(plan, records, program), encoding="utf-8")
    (folder / "summary.json").write_text(json.dumps(found, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return found


def rate_cells(entry):
    low, high = entry["interval"]
    return [f"{entry['successes']}/{entry['trials']}", "–" if entry['rate'] is None else f"{100 * entry['rate']:.0f} %", f"{100 * low:.0f}–{100 * high:.0f} %"]


def others(outcomes):
    """The outcomes that are neither success nor failure."""
    return ", ".join(f"{outcomes[name]} {in_words(name)}" for name in OUTCOMES[2:] if outcomes[name])


def short_table(plan, found, folder):
    """A line for each point of the grid, the worst run, and where the rest is."""
    judge = plan.spec.judge
    rows = [["scenario", *columns(plan), "succeeded", "rate", "95 %", f"{judge} median", "worst", ""]]
    for point in found["points"]:
        values = [yaml_text(value) for value in point["parameters"].values()]
        measured = [pretty(judge, point["judge"]["median"]), pretty(judge, point["judge"]["worst"])]
        rows.append([point["scenario"], *values, *rate_cells(point), *measured, others(point["outcomes"])])
    text = aligned(rows)
    if found["worst"]:
        first = found["worst"][0]
        text += f"\nworst: {in_one_line(plan, first)}\n  {first['command']}\n"
    if found["pairs"]:
        text += "\nseed by seed against " + f'"{found["pairs"][0]["against"]}":\n' + aligned(pairs_rows(found["pairs"], judge))
    return text + f"\nall of it: {folder}/  digest {found['digest']}\n"
