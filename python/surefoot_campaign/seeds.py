"""`surefoot run SCENARIO --seeds N`: the program hands its arguments over once it has read them."""

import argparse
import contextlib
import json
import os
import sys

from surefoot_campaign.command_line import run_command, tell
from surefoot_campaign.errors import InputError
from surefoot_campaign.metrics import KEY, arrow, is_first
from surefoot_campaign.metrics import about as metric_about
from surefoot_campaign.outcome import ended_from_outside, judge, number_at, read_result
from surefoot_campaign.output_files import check_not_being_written, folder_of_our_own, remove_outdated, with_seed
from surefoot_campaign.program import MAX_SEED, Program
from surefoot_campaign.progress import Progress
from surefoot_campaign.scheduler import LocalScheduler, Task, results_of
from surefoot_campaign.statistics import Rate, summary_of
from surefoot_campaign.text import aligned, asked, in_words, pretty, printable, rate_text

PASSED, FAILED, SAFETY_STOP, NOT_JUDGED = 0, 1, 3, 4
HEADING = ["scenario", "robot", "stack", "estimation", "foot_force_sensor", "version"]
RATES = ["succeeded", "fell", "goal_reached", "safety_stop", "crashed"]
VERDICTS = {True: "succeeded", False: "did not succeed", None: "not judged"}


def complaints(result, row):
    """What the program said on stderr, without the notes of the scenario."""
    lines = [line for line in result.stderr.splitlines() if line.startswith("surefoot: ")]
    return [line for line in lines if line.removeprefix("surefoot: warning: ") not in row.get("notes", [])]


def run_rows(label, tasks, jobs, lines_of):
    """Id -> row of each task that came to its end: the program's JSON, or why there is none. Ids are (name, seed); `lines_of` an id and a row are shown."""
    of_id, rows = {task.id: task for task in tasks}, {}
    scheduler = LocalScheduler(jobs)
    with Progress(printable(label), 0, len(tasks)) as progress, results_of(scheduler, tasks) as results:
        for result in results:
            if ended_from_outside(result, scheduler.stopped):
                continue
            _, reason, found = judge(of_id[result.id], result)
            found = found or read_result(result.stdout)  # e.g. of a run whose report could not be written
            row = rows[result.id] = found or {"seed": result.id[1], "succeeded": False, "crashed": True, "reason": reason}
            progress.update()
            for line in (complaints(result, row) if found else []) + lines_of(*result.id, row):
                progress.say(printable(line))
    return rows


def event_totals(rows):
    """Each kind of event, all legs together: in how many runs, and how often in all."""
    totals = {}
    for number, row in enumerate(rows):
        for event in row.get("events", []):
            runs, count = totals.get(event["event"], (set(), 0))
            totals[event["event"]] = runs | {number}, count + event["count"]
    return [{"event": event, "runs": len(runs), "count": count} for event, (runs, count) in totals.items()]


def seeds_json(about, rows):
    """What the runs come to: `rates`, `metrics` (each with median and worst) and `events` before the `runs` themselves."""
    judged = [row for row in rows if row["succeeded"] is not None]
    rates = {name: Rate(sum(row.get(name) is True for row in rows), len(judged if name == "succeeded" else rows)).as_json()
             for name in RATES if name != "goal_reached" or about["has_goal"]}  # fmt: skip
    values = {metric: [float(value) for row in rows if (value := number_at(row, metric)) is not None] for metric in about["metrics"]}
    limited = {criterion["metric"] for row in rows for criterion in row.get("criteria", [])}
    metrics = {metric: summary_of(found, about["metrics"][metric]["worst"]) for metric, found in values.items() if found or metric in limited}
    heading = {key: about[key] for key in HEADING}
    return {**heading, "rates": rates, "metrics": metrics, "events": event_totals(rows), "runs": rows}


def enough_succeeded(about, rows, also=True):
    """Whether so many did as the scenario asks for; `also`: None counts those that were not judged as well."""
    return sum(row["succeeded"] in (True, also) for row in rows) >= about["success_rate"] * len(rows)


def all_the_same(rows):
    """Whether chance had no part in the seeds, so that a rate over them says nothing."""
    outcomes = [{key: value for key, value in row.items() if key != "seed" and not metric_about(key).get("by_clock")} for row in rows]
    return len(rows) > 1 and all(outcome == outcomes[0] and "crashed" not in outcome for outcome in outcomes)


def failure(row):
    missed = [criterion for criterion in row.get("criteria", []) if criterion["passed"] is False]
    values = ["" if "equals" in one else f"{pretty(one['metric'], one['value'])}, " for one in missed]
    return "; ".join([row["reason"], *(f"{one['metric']} {value}must be {asked(one)}" for one, value in zip(missed, values))])


def times(count):
    return "once" if count == 1 else f"{count} times"


def metrics_table(about, seeds, everything):
    """Median and worst of those that matter: the first, and what is compared with something."""
    judged = {criterion["metric"] for row in seeds["runs"] for criterion in row.get("criteria", [])} | about["paper"].keys()
    shown = {metric: summary for metric, summary in seeds["metrics"].items() if everything or is_first(metric) or metric in judged}
    rows = [[metric, pretty(metric, summary["median"]), pretty(metric, summary["worst"]), arrow(metric), about["paper"].get(metric, "")]
            for metric, summary in shown.items()]  # fmt: skip
    return [["", "median", "worst", "", "paper"], *rows], len(seeds["metrics"]) - len(shown)


def seeds_table(about, seeds, everything=False):
    """A line for each run that did not succeed, the rates, median and worst of the metrics, and how often notable events happened."""
    sensors = ", foot force sensors" if about["foot_force_sensor"] else ""
    described = f": {about['description']}" if about["description"] else ""
    title = f"{about['scenario']}, robot {about['robot']}, stack {about['stack']}, estimation {about['estimation']}{sensors}{described}\n"
    failures = [[f"seed {row['seed']}", failure(row)] for row in seeds["runs"] if row["succeeded"] is False]
    rates = [[name, rate_text(rate)] for name, rate in seeds["rates"].items()]
    metrics, left_out = metrics_table(about, seeds, everything)
    more = f"; --all shows the other {left_out}" if left_out else ""
    runs = len(seeds["runs"])
    events = [[one["event"], f"in {one['runs']} of {runs} runs", f"{times(one['count'])} in all"] for one in seeds["events"]]
    tables = [aligned(failures), aligned(rates), f"{aligned(metrics)}{KEY}{more}\n", aligned(events)]
    return title + "".join("\n" + table for table in tables if table)


def seeds_line(about, seeds):
    """How many reached the goal (or succeeded, where there is none), how many fell."""
    rates, name = seeds["rates"], "goal_reached" if about["has_goal"] else "succeeded"
    return f"{in_words(name)} {rate_text(rates[name])}, fell {rates['fell']['successes']}"


def parser():
    made = argparse.ArgumentParser("surefoot run")
    made.add_argument("scenario")
    for name in ("--first", "--seeds", "--jobs"):
        made.add_argument(name, type=int)
    made.add_argument("--set", action="append", default=[])
    for name in ("--record", "--report", "--video"):
        made.add_argument(name, default="")
    made.add_argument("--all", action="store_true")
    made.add_argument("--no-pictures", action="store_true")
    made.add_argument("--json", action="store_true")
    return made


def written(arguments, seed):
    """Option and name of all that a run writes."""
    log = arguments.record or (f"{arguments.report}/run.mcap" if arguments.report else "")
    names = {"record": log and with_seed(log, seed), "report": arguments.report and f"{arguments.report}/seed{seed}",
             "video": arguments.video and with_seed(arguments.video, seed)}  # fmt: skip
    return {option: name for option, name in names.items() if name}


def words(arguments, seed, names):
    options = [f"--set={assignment}" for assignment in arguments.set] + [f"--{option}={name}" for option, name in names.items()]
    options += ["--no-pictures"] * arguments.no_pictures
    return ["run", arguments.scenario, f"--seed={seed}", *options]


def make_room(arguments, outputs):
    """A log that was asked for by name is replaced only when the new one is whole."""
    for names in outputs.values():
        if "record" in names:
            check_not_being_written(names["record"])
        if "report" in names:
            remove_outdated(names["report"], None if arguments.record else names["record"])


def interrupted(outputs, finished):
    found = f"{finished} of {len(outputs)} seeds are finished and shown" if finished else "no results"
    partial = [f"{names['record']}.partial" for names in outputs.values() if "record" in names]
    cut = [name for name in partial if os.path.exists(name)]
    return tell(f"interrupted: {found}" + (f"; logs that are not whole: {', '.join(cut)}" if cut else ""))


def run_seeds(program, about, arguments, outputs):
    tasks = [Task((about["scenario"], seed), [str(program.path), *words(arguments, seed, names), "--json"]) for seed, names in outputs.items()]

    def lines_of(_, seed, row):
        return [f"seed {seed}: {VERDICTS[row['succeeded']]}, {row['reason']}"]

    rows = run_rows(about["scenario"], tasks, arguments.jobs, lines_of)
    return [rows[task.id] for task in tasks if task.id in rows]


def seeds(typed):
    arguments = parser().parse_args(typed)
    last = arguments.first + arguments.seeds - 1
    if last > MAX_SEED:
        raise InputError(f"--seeds: {arguments.seeds} from seed {arguments.first} on end at {last}, which is above {MAX_SEED}, the largest seed")
    program = Program().pinned()
    asked_for = {option: name for option, name in vars(arguments).items() if option in ("record", "report", "video") and name}
    about = program.about(words(arguments, arguments.first, asked_for))
    outputs = {seed: written(arguments, seed) for seed in range(arguments.first, last + 1)}
    with folder_of_our_own(arguments.report) if arguments.report else contextlib.nullcontext():
        make_room(arguments, outputs)
        for note in about["notes"]:
            print(printable(f"surefoot: warning: {note}"), file=sys.stderr)
        rows = run_seeds(program, about, arguments, outputs)
    is_cut = len(rows) < len(outputs)
    if all_the_same(rows):
        print("surefoot: warning: all runs are the same: the scenario draws nothing at random, so rates and their intervals mean nothing", file=sys.stderr)
    if rows:
        found = seeds_json(about, rows) | ({"interrupted": True} if is_cut else {})
        text = json.dumps(found, ensure_ascii=False, separators=(",", ":")) + "\n" if arguments.json else seeds_table(about, found, arguments.all)
        print(printable(text), end="", flush=True)
    if is_cut:
        return interrupted(outputs, len(rows))
    if enough_succeeded(about, rows):
        return PASSED
    if enough_succeeded(about, rows, also=None):
        return NOT_JUDGED
    return SAFETY_STOP if any(row.get("safety_stop") for row in rows) else FAILED


if __name__ == "__main__":
    sys.exit(run_command(seeds, sys.argv[1:]))
