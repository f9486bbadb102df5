"""Rows of the tables in docs/results.md from the runs of campaigns, and the files of runs that they stand on.

    PYTHONPATH=python python3 tools/campaign_table.py results/blind/runs.csv [MORE.csv …]
    PYTHONPATH=python python3 tools/campaign_table.py --keep docs/results/blind.csv results/blind/runs.csv [MORE.csv …]
    PYTHONPATH=python python3 tools/campaign_table.py --by-case results/robots/runs.csv

A line a scenario, or a scenario and case: successes of runs with Wilson's 95 % interval; the worst tick's COM error of a run that succeeds
(median, 90th percentile, worst run); false touchdowns of steps, of all runs; the largest change of a torque in a tick
(median, 90th percentile, worst run). Another: the 95th percentile of a walk's touchdown latencies (median walk, share of
the walks within 30 ms, share of all touchdowns within 30 ms); contacts that a standing foot lost, how many were
detected, missed, and reported where there were none, and how late; slips likewise. Then the seeds that failed, with what they missed and why they
ended, and in how many of them a sensor was blamed (wrongly, where the scenario has no faults). With
--keep the runs are written to a file, shortened to the columns that the documents speak of and to five digits. With --by-case a line is a
case and a column a scenario, with its successes, then the COM error of the scenario `flat`.
"""

import argparse
import collections
import csv
import pathlib
import re
import sys

from surefoot_campaign.statistics import Rate, quantile

HEAD = "| scenario | succeed (95 % interval) | COM error [mm] | false touchdowns | torque step [N·m] |"
CONTACTS = (
    "| scenario | touchdown: latency [ms], walks, touchdowns within 30 ms | contact lost: detected, missed, false | latency [ms] "
    "| slips: detected, missed, false |"
)
KEPT = (
    "scenario case seed version outcome reason missed com_error_max_m velocity_error_rms_mps tilt_error_rms_rad "
    "position_drift_m distance_m touchdown_latency_p95_s touchdowns_noticed touchdowns_late false_touchdowns steps_taken "
    "slips_detected slips_missed slips_false contact_losses_noticed contact_losses_missed contact_losses_false contact_loss_latency_p95_s "
    "torque_step_max_nm path_deviation_max_m path_deviation_base_max_m com_error_calibrating_max_m"
).split()


def read(file):
    with open(file, newline="") as table:
        return list(csv.DictReader(table))


def read_once(files):
    """Runs of several files, each scenario, case and seed once: counted twice they would narrow the intervals."""
    runs = {}
    for file in files:
        for run in read(file):
            key = name_of(run), run["seed"]
            if key in runs:
                sys.exit(f"{file}: {key[0]} with seed {key[1]} stands there twice, or in another file, too; a seed of a scenario counts once")
            runs[key] = run
    return list(runs.values())


def keep(runs, file):
    def short(name, value):
        try:
            return value if name in ("scenario", "case", "seed", "version") else f"{float(value):.5g}"
        except ValueError:
            return value

    # What a run without a fault says is the same in all of them.
    rows = [run | {"scenario": scenario_of(run), "reason": "" if run["outcome"] == "succeeded" else run["reason"]} for run in runs]
    rows.sort(key=lambda run: (name_of(run), int(run["seed"])))
    columns = [name for name in KEPT if name != "case" or any(run.get("case") for run in rows)]
    with open(file, "w", newline="") as table:
        out = csv.writer(table, lineterminator="\n")
        out.writerow(columns)
        out.writerows([short(name, run.get(name, "")) for name in columns] for run in rows)


def scenario_of(run):
    """The name of a run's scenario, without folders and ending."""
    return pathlib.PurePath(run["scenario"]).stem


def name_of(run):
    """Of a line of the tables: the scenario, with the case where the campaign has cases."""
    return ", ".join(filter(None, (scenario_of(run), run.get("case"))))


def by_scenario(runs):
    """The runs of each line."""
    scenarios = collections.defaultdict(list)
    for run in runs:
        scenarios[name_of(run)].append(run)
    return scenarios


def succeeded(runs):
    return [run for run in runs if run["outcome"] == "succeeded"]


def numbers(runs, name, scale=1.0):
    return [scale * float(run[name]) for run in runs if run.get(name)]


def spread(values):
    """Median, 90th percentile and worst."""
    return ", ".join(f"{quantile(values, share):.2g}" for share in (0.5, 0.9, 1.0)) if values else "–"


def latency(runs):
    """Of touchdowns: the median walk's 95th percentile, the share of the walks in which it is within 30 ms, and that of all touchdowns
    that are told within 30 ms, of the runs that count them."""
    values = numbers(runs, "touchdown_latency_p95_s", 1e3)
    within = sum(value < 30.01 for value in values)
    told, late = (sum(numbers(runs, f"touchdowns_{kind}")) for kind in ("noticed", "late"))
    of_all = f", {100 * (told - late) / told:.1f} %" if told else ""
    return f"{quantile(values, 0.5):.0f}, {100 * within / len(values):.0f} %{of_all}" if values else "–"


def counts(runs, *names):
    """Sums; of what no run has counted, nothing."""
    if not any(numbers(runs, name) for name in names):
        return "–"
    return ", ".join(f"{int(sum(numbers(runs, name))):,}" for name in names)


def contacts(runs):
    """What the documents say of a scenario's contacts: touchdowns, contacts lost, slips."""
    losses = (f"contact_losses_{kind}" for kind in ("noticed", "missed", "false"))
    slips = (f"slips_{kind}" for kind in ("detected", "missed", "false"))
    late = numbers(runs, "contact_loss_latency_p95_s", 1e3)
    return [latency(runs), counts(runs, *losses), f"{quantile(late, 0.5):.0f}" if late else "–", counts(runs, *slips)]


def success(runs):
    rate = Rate(len(succeeded(runs)), len(runs))
    low, high = (f"{100 * bound:.1f}".removesuffix(".0") for bound in rate.interval)
    return f"{rate.successes} ({low}–{high} %)"


def cells(runs):
    """What docs/results.md says of a scenario: successes, COM error, false touchdowns."""
    touchdowns = counts(runs, "false_touchdowns", "steps_taken").replace(", ", " of ", 1)
    return [success(runs), spread(numbers(succeeded(runs), "com_error_max_m", 1e3)), touchdowns]


def by_case(runs):
    """Of each case, what a row says: the successes in each scenario, the COM error of the walk."""
    scenarios = list(dict.fromkeys(scenario_of(run) for run in runs))
    cases = {}
    for case in dict.fromkeys(run["case"] for run in runs):
        own = [[run for run in runs if (run["case"], scenario_of(run)) == (case, scenario)] for scenario in scenarios]
        errors = numbers([run for some in own for run in succeeded(some) if scenario_of(run) == "flat"], "com_error_max_m", 1e3)
        cases[case] = [str(len(succeeded(some))) for some in own] + [f"{quantile(errors, 0.5):.2f}, {max(errors):.2f}" if errors else "–"]
    return scenarios, cases


def print_by_scenario(scenarios):
    print(HEAD, "|---|---|---|---|---|", sep="\n")
    for scenario, own in scenarios.items():
        steps = spread(numbers(own, "torque_step_max_nm"))
        print("|", " | ".join([f"`{scenario}`", *cells(own), steps]), "|")
    print("", CONTACTS, "|---|---|---|---|---|", sep="\n")
    for scenario, own in scenarios.items():
        print("|", " | ".join([f"`{scenario}`", *contacts(own)]), "|")


def print_by_case(runs):
    scenarios, cases = by_case(runs)
    print("|", " | ".join(["robot", *scenarios, "COM error [mm]"]), "|\n" + "|---" * (len(scenarios) + 2) + "|")
    for case, cells_of_case in cases.items():
        print("|", " | ".join([case, *cells_of_case]), "|")


def blamed(run):
    """Whether the controller stopped in the name of a sensor."""
    stop = re.search(r"stopped for safety at [\d.]+ s: ([^,]*)", run["reason"])
    return bool(stop) and stop[1] not in ("the torso tilted too far", "too many ticks without a solution", "it could not stand up")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="RUNS.csv")
    parser.add_argument("--by-case", action="store_true", help="a line a case, a column a scenario")
    parser.add_argument("--keep", metavar="FILE", help="write the runs to FILE, shortened")
    asked = parser.parse_args()
    runs = read_once(asked.runs)
    if asked.keep:
        keep(runs, asked.keep)
    versions = collections.Counter(run["version"] for run in runs)
    print("Of", ", ".join(f"{version} ({count})" for version, count in versions.items()), end="\n\n")
    scenarios = by_scenario(runs)
    if asked.by_case:
        print_by_case(runs)
    else:
        print_by_scenario(scenarios)
    for scenario, own in scenarios.items():
        failed = [run for run in own if run["outcome"] != "succeeded"]
        if failed:
            told = [f"{run['seed']} ({'; '.join(filter(None, (run['missed'], run['reason'])))})" for run in failed]
            print(f"\n{scenario}, of {len(own)} failed, in {sum(map(blamed, failed))} a sensor was blamed: {', '.join(told)}")


if __name__ == "__main__":
    main()
