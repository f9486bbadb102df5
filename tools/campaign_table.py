"""Rows of the README's tables from the runs of campaigns, and the files of runs that they stand on.

    PYTHONPATH=python python3 tools/campaign_table.py results/blind/runs.csv [MORE.csv …]
    PYTHONPATH=python python3 tools/campaign_table.py --keep docs/results/blind.csv results/blind/runs.csv [MORE.csv …]

A line a scenario: successes of runs with Wilson's 95 % interval; the worst tick's COM error of a run that succeeds
(median, 90th percentile, worst run); false touchdowns of steps, of all runs; the 95th percentile of a walk's touchdown
latencies (median walk, share of the walks within 30 ms); the largest change of a torque in a tick (median, 90th
percentile, worst run); then the seeds that failed. With --keep the runs are written to a file, shortened to the columns
that the documents speak of and to five digits.
"""

import argparse
import collections
import csv
import pathlib

from surefoot_campaign.statistics import Rate, quantile

HEAD = "| scenario | succeed (95 % interval) | COM error [mm] | false touchdowns | latency [ms] | torque step [N·m] |"
KEPT = (
    "scenario seed version outcome reason missed com_error_max_m velocity_error_rms_mps tilt_error_rms_rad "
    "position_drift_m distance_m touchdown_latency_p95_s false_touchdowns steps_taken slips_detected slips_missed "
    "slips_false torque_step_max_nm path_deviation_max_m path_deviation_base_max_m"
).split()


def read(file):
    with open(file, newline="") as table:
        return list(csv.DictReader(table))


def keep(runs, file):
    def short(name, value):
        try:
            return value if name in ("seed", "version") else f"{float(value):.5g}"
        except ValueError:
            return value

    # What a run without a fault says is the same in all of them.
    rows = [run | {"scenario": name_of(run), "reason": "" if run["outcome"] == "succeeded" else run["reason"]} for run in runs]
    rows.sort(key=lambda run: (run["scenario"], int(run["seed"])))
    with open(file, "w", newline="") as table:
        out = csv.writer(table, lineterminator="\n")
        out.writerow(KEPT)
        out.writerows([short(name, run.get(name, "")) for name in KEPT] for run in rows)


def name_of(run):
    """The name of a run's scenario, without folders and ending."""
    return pathlib.PurePath(run["scenario"]).stem


def by_scenario(runs):
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
    values = numbers(runs, "touchdown_latency_p95_s", 1e3)
    within = sum(value < 30.01 for value in values)
    return f"{quantile(values, 0.5):.0f}, {100 * within / len(values):.0f} %" if values else "–"


def success(runs):
    rate = Rate(len(succeeded(runs)), len(runs))
    low, high = (f"{100 * bound:.1f}".removesuffix(".0") for bound in rate.interval)
    return f"{rate.successes} ({low}–{high} %)"


def cells(runs):
    """What the README says of a scenario: successes, COM error, false touchdowns."""
    false, steps = (int(sum(numbers(runs, name))) for name in ("false_touchdowns", "steps_taken"))
    return [success(runs), spread(numbers(succeeded(runs), "com_error_max_m", 1e3)), f"{false} of {steps:,}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="RUNS.csv")
    parser.add_argument("--keep", metavar="FILE", help="write the runs to FILE, shortened")
    asked = parser.parse_args()
    runs = [run for file in asked.runs for run in read(file)]
    if asked.keep:
        keep(runs, asked.keep)
    print(HEAD, "|---|---|---|---|---|---|", sep="\n")
    scenarios = by_scenario(runs)
    for scenario, own in scenarios.items():
        steps = spread(numbers(own, "torque_step_max_nm"))
        print("|", " | ".join([f"`{scenario}`", *cells(own), latency(own), steps]), "|")
    for scenario, own in scenarios.items():
        failed = [f"{run['seed']} ({run['missed'] or run['reason']})" for run in own if run["outcome"] != "succeeded"]
        if failed:
            print(f"\n{scenario}, of {len(own)} failed: {', '.join(failed)}")


if __name__ == "__main__":
    main()
