"""Cases compared with the first one seed by seed: what each of them mends, breaks and gains."""

from surefoot_campaign.metrics import unit_of
from surefoot_campaign.statistics import median, median_interval
from surefoot_campaign.units import metric_label


def pair_key(run, spec):
    """What two runs of different cases must share."""
    return (run.scenario, run.seed, *(str(run.parameters[key]) for key in spec.grid))


def pairs(plan, records):
    """For each scenario, point of the grid and case but the first: seeds that succeed only here or only there, and the
    difference of the judging metric (this case less the first), median with a 95 % interval."""
    spec, judge = plan.spec, plan.spec.judge
    if not spec.cases:
        return []
    first, *others = spec.cases
    reference = {pair_key(record.run, spec): record for record in records if record.run.case == first}
    found = {}
    for record in records:
        other = reference.get(pair_key(record.run, spec))
        if other is not None and record.run.case in others:
            found.setdefault(record.run.point, []).append((other, record))
    return [one_point(spec, judge, first, found[point]) for point in sorted(found)]


def one_point(spec, judge, first, couples):
    run = couples[0][1].run
    judged = [couple for couple in couples if all(record.is_judged for record in couple)]
    values = [(one.metric(judge), two.metric(judge)) for one, two in couples]
    differences = [two - one for one, two in values if one is not None and two is not None]
    return {
        "scenario": run.scenario,
        "parameters": run.place(spec),
        "against": first,
        "seeds": len(couples),
        "mended": sum(two.succeeded and not one.succeeded for one, two in judged),
        "broken": sum(one.succeeded and not two.succeeded for one, two in judged),
        "difference": {"median": median(differences), "interval": median_interval(differences)},
    }


def pairs_rows(found, judge):
    """A table of texts with its heading."""
    rows = [["scenario", *found[0]["parameters"], "seeds", "mended", "broken", f"difference of {metric_label(judge)}", "95 %"]]
    for entry in found:
        counts = [str(entry[key]) for key in ("seeds", "mended", "broken")]
        rows.append([entry["scenario"], *map(str, entry["parameters"].values()), *counts, *difference_cells(judge, entry["difference"])])
    return rows


def difference_cells(judge, difference):
    middle, interval, scale = difference["median"], difference["interval"], unit_of(judge)[1]
    ends = "–" if interval is None else f"{scale * interval[0]:+.3g} … {scale * interval[1]:+.3g}"
    return ["–" if middle is None else f"{scale * middle:+.3g}", ends]
