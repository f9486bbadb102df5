"""Rows of the README's tables from the runs of campaigns.

    PYTHONPATH=python python3 tools/campaign_table.py results/blind/runs.csv [MORE.csv …]

A line a scenario: successes of runs with Wilson's 95 % interval; the worst tick's COM error of a run (median, 90th
percentile, worst run); false touchdowns of steps; the largest change of a torque in a tick (median, 90th percentile,
worst run); then the seeds that failed.
"""

import collections
import csv
import sys

from surefoot_campaign.statistics import Rate, quantile

HEAD = "| scenario | succeed (95 % interval) | COM error [mm] | false touchdowns | torque step [N·m] |"


def numbers(runs, name, scale=1.0):
    return [scale * float(run[name]) for run in runs if run.get(name)]


def spread(values):
    """Median, 90th percentile and worst."""
    return ", ".join(f"{quantile(values, share):.2g}" for share in (0.5, 0.9, 1.0)) if values else "–"


def row(scenario, runs):
    rate = Rate(sum(run["outcome"] == "succeeded" for run in runs), len(runs))
    low, high = (100 * bound for bound in rate.interval)
    false, steps = (int(sum(numbers(runs, name))) for name in ("false_touchdowns", "steps_taken"))
    return (f"| `{scenario}` | {rate.successes} of {rate.trials} ({low:.1f}–{high:.1f} %) "
            f"| {spread(numbers(runs, 'com_error_max_m', 1e3))} | {false} of {steps:,} "
            f"| {spread(numbers(runs, 'torque_step_max_nm'))} |")


def main(files):
    scenarios = collections.defaultdict(list)
    for file in files:
        with open(file, newline="") as table:
            for run in csv.DictReader(table):
                scenarios[run["scenario"]].append(run)
    print(HEAD, "|---|---|---|---|---|", sep="\n")
    for scenario, runs in scenarios.items():
        print(row(scenario, runs))
    for scenario, runs in scenarios.items():
        failed = [f"{run['seed']} ({run['missed'] or run['reason']})" for run in runs if run["outcome"] != "succeeded"]
        if failed:
            print(f"\n{scenario} failed: {', '.join(failed)}")


if __name__ == "__main__":
    main(sys.argv[1:])
