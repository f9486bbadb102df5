"""The command `surefoot demo`."""

import concurrent.futures
import json
import os
import pathlib
import shutil
import sys
from dataclasses import dataclass

from surefoot_campaign.command_line import Parser, folder_name, run_command, tell, whole_number
from surefoot_campaign.demo_page import demo_page
from surefoot_campaign.errors import InputError
from surefoot_campaign.experiments import EXPERIMENTS
from surefoot_campaign.output_files import folder_of_our_own, remove_if_empty, remove_outdated
from surefoot_campaign.program import Program
from surefoot_campaign.progress import duration_text
from surefoot_campaign.scheduler import Task
from surefoot_campaign.seeds import FAILED, PASSED, enough_succeeded, run_rows, seeds_json, seeds_line
from surefoot_campaign.text import aligned, asked_of, in_words, pretty, printable

SEEDS, JOBS = 10, 2
FIRST = "step_down"  # its pictures come first
REPORT, PICTURES = 4.0, 7.0  # what a run's report takes, and its pictures, in the run's own time
CUT = "cut off"  # the verdict of an experiment that lacks seeds
DEFAULT_FOLDER = pathlib.Path("results/demo")
MOST_SEEDS, MOST_JOBS = 1_000_000, 1000
EPILOG = f"""Experiments, each with a report:
{"".join(f"  {one.name}{', and over --seeds' * one.seeds}{' (as found: any result is one)' * one.as_found}{chr(10)}" for one in EXPERIMENTS)}
They take some minutes on two cores; most of it goes to those over seeds.

With --view one of them is shown instead, walking down the step; the other options of `surefoot run --view` go
with it: --no-wait, --port, --listen, --token and --view-clients.

Exit codes: 0 every experiment came out as it must, 1 one did not, 2 the input is wrong or the demo
was interrupted (runs that were reported by then stay, with their index).

Examples:
  surefoot demo --seeds 3 --jobs 2 --out out
  surefoot demo --view                                   walk down the step, in a browser
"""


@dataclass
class Row:
    """A line of the demo's table, and a card of its page."""

    name: str
    description: str
    headline: str  # the figure that tells the result
    headline_metric: str  # whose it is; empty where it says so itself
    headline_paper: str  # the paper's
    measured: str  # all
    seeds: str
    paper: str
    verdict: str  # "✓", "✗", "as found" or CUT
    report: str  # path of its report, relative to the page; empty: none
    picture: str = ""  # of a picture of it


def parser():
    made = Parser("demo", "Run the paper's experiments and print them beside its numbers.", EPILOG)
    made.add_argument("--out", type=folder_name, metavar="DIR", help="folder for the reports; results/demo by default")
    made.add_argument("--seeds", type=whole_number(MOST_SEEDS), metavar="N", help=f"seeds of each random experiment; {SEEDS} by default")
    made.add_argument("--jobs", type=whole_number(MOST_JOBS), metavar="N", help=f"processes at once; {JOBS} by default")
    made.add_argument("--no-pictures", action="store_true", help="leave strip and clip out of the reports, which take seconds each")
    made.add_argument("--view", action="store_true", help="show one run in a browser, live; ^C ends it")
    return made


def view(program, arguments, others):
    given = {"--out": arguments.out, "--seeds": arguments.seeds, "--jobs": arguments.jobs, "--no-pictures": arguments.no_pictures}
    for option, value in given.items():
        if value:
            raise InputError(f"--view shows one run and writes nothing, and can't go with {option}; leave out one of them")
    os.execv(program.path, [str(program.path), "run", "step_down", "--view", *others])


def tasks_of(experiment, program, arguments, out):
    """The nominal run first, with log and report."""
    words = [str(program.path), *experiment.words(), "--json"]
    report = [f"--report={out / experiment.name}", *["--no-pictures"] * arguments.no_pictures]
    seeds = range(1, (arguments.seeds or SEEDS) + 1) if experiment.seeds else []
    return [Task((experiment.name, 0), words + report), *(Task((experiment.name, seed), [*words, f"--seed={seed}"]) for seed in seeds)]


def headline(experiment, run):
    """The first of its metrics, in words where it is a yes or a text: "goal reached"."""
    metric = experiment.shown[0]
    if "crashed" in run or metric == "reason":
        return run["reason"], ""
    if isinstance(run[metric], bool):
        return in_words(metric) if run[metric] else {"goal_reached": "goal not reached"}.get(metric, f"not {in_words(metric)}"), ""
    return pretty(metric, run[metric]), metric


def picture_of(out, experiment):
    """Of the robot, or else the figure of its COM."""
    places = [f"{experiment.name}/figures/{file}" for file in ("strip.jpg", "com_tracking.svg")]
    return next((place for place in places if (out / place).is_file()), "")


def measured(experiment, run):
    if "crashed" in run:
        return run["reason"]
    texts = []
    for metric in experiment.shown:
        limit = asked_of(run, metric)
        texts.append(("" if metric == "reason" else f"{metric} ") + pretty(metric, run[metric]) + (f" ({limit})" if limit else ""))
    return ", ".join(texts)


def summarise(experiment, about, rows, out, is_whole):
    """The experiment's line, from its rows: nominal, then seeds."""
    nominal, *seeds = rows
    passed = nominal["succeeded"] and enough_succeeded(about, seeds)
    return Row(
        name=experiment.name,
        description=about["description"],
        headline=headline(experiment, nominal)[0],
        headline_metric=headline(experiment, nominal)[1],
        headline_paper=about["paper"].get(experiment.shown[0], ""),
        measured=measured(experiment, nominal),
        seeds=seeds_line(about, seeds_json(about, seeds)) if seeds else "",
        paper=", ".join(f"{metric} {figure}" for metric, figure in about["paper"].items() if metric in experiment.shown),
        verdict=CUT if not is_whole else "as found" if experiment.as_found else "✓" if passed else "✗",
        report="" if "crashed" in nominal else f"{experiment.name}/index.html",
        picture=picture_of(out, experiment),
    )


def print_rows(rows):
    """Each experiment as a block, so that a line fits a terminal."""
    table = []
    for row in rows:
        table.append([row.name, row.verdict, "measured", row.measured])
        table += [["", "", name, text] for name, text in (("seeds", row.seeds), ("paper", row.paper)) if text]
    print(printable("\n" + aligned(table)), end="")


def link_to(folder, row):
    """To the report with its pictures, as terminals open it."""
    return "" if "crashed" in row else f" {(folder / 'index.html').absolute().as_uri()}"


def remove_results(experiment, out):
    folder = out / experiment.name
    remove_outdated(folder, folder / "run.mcap")
    shutil.rmtree(folder / "figures", ignore_errors=True)


class Links:
    """Lines of nominal runs with the links to their reports, FIRST's before all others."""

    def __init__(self, out):
        self.out, self.waiting, self.has_begun = out, [], False

    def __call__(self, name, seed, row):
        if seed:
            return []
        self.waiting.append(f"{name}: {row['reason']}{link_to(self.out / name, row)}")
        if name == FIRST:
            self.waiting.insert(0, self.waiting.pop())
            self.has_begun = True
        lines = self.waiting if self.has_begun else []
        self.waiting = [] if self.has_begun else self.waiting
        return lines


def make_demo(program, arguments, out):
    jobs = arguments.jobs or JOBS
    for result in ("index.html", "results.json"):
        (out / result).unlink(missing_ok=True)
    for experiment in EXPERIMENTS:  # what an interrupted demo leaves behind must not look like results
        remove_results(experiment, out)
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        about = dict(zip([one.name for one in EXPERIMENTS], pool.map(lambda one: program.about(one.words()), EXPERIMENTS)))
    of = {experiment.name: tasks_of(experiment, program, arguments, out) for experiment in EXPERIMENTS}
    tasks = sorted((task for of_one in of.values() for task in of_one), key=lambda task: (task.id[1] > 0, task.id[0] != FIRST))
    reported = 1.0 + REPORT + PICTURES * (not arguments.no_pictures)
    seconds = sum(about[task.id[0]]["cost"]["wall_time_s"] * (1.0 if task.id[1] else reported) for task in tasks) / jobs
    print(f"{len(of)} experiments of the paper in {len(tasks)} runs, {jobs} at a time: about {duration_text(seconds)}, {FIRST} first; "
          f"reports go to {out}", file=sys.stderr)  # fmt: skip
    found = run_rows("experiments", tasks, jobs, Links(out))
    begun = [one for one in EXPERIMENTS if (one.name, 0) in found]
    for experiment in (one for one in EXPERIMENTS if one not in begun):
        remove_results(experiment, out)
        remove_if_empty(out / experiment.name)
    if not begun:
        return tell("interrupted: no results")
    rows_of = {one.name: [found[task.id] for task in of[one.name] if task.id in found] for one in begun}
    whole = [one for one in begun if len(rows_of[one.name]) == len(of[one.name])]
    rows = [summarise(one, about[one.name], rows_of[one.name], out, one in whole) for one in begun]
    print_rows(rows)
    (out / "results.json").write_text(json.dumps(sum(rows_of.values(), []), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    cut = "" if len(whole) == len(of) else "interrupted; "
    page = demo_page(rows, f"{cut}Bellicoso et al., Humanoids 2016, in simulation; surefoot {about[begun[0].name]['version']}", FIRST)
    (out / "index.html").write_text(page, encoding="utf-8")
    print(f"\nreport: {out / 'index.html'}", flush=True)
    if cut:
        lacking = len(begun) - len(whole)
        return tell(f"interrupted: {len(whole)} of {len(of)} experiments are whole" + (f", {lacking} lack seeds" if lacking else ""))
    return FAILED if any(row.verdict == "✗" for row in rows) else PASSED


def demo(typed):
    arguments, others = parser().parse_known_args(typed)
    program = Program()
    if arguments.view:
        view(program, arguments, others)
    if others:
        parser().parse_args(typed)  # names what it does not know
    out = arguments.out or DEFAULT_FOLDER
    with folder_of_our_own(out):
        return make_demo(program.pinned(), arguments, out)


if __name__ == "__main__":
    sys.exit(run_command(demo, sys.argv[1:]))
