"""The command `surefoot campaign`."""

import json
import os
import pathlib
import shlex
import sys
from dataclasses import dataclass

from surefoot_campaign.axes import number_text
from surefoot_campaign.command_line import Parser, folder_name, tell, whole_number
from surefoot_campaign.errors import InputError
from surefoot_campaign.journal import Journal, check_campaign, read_rows
from surefoot_campaign.outcome import ended_from_outside, row_of
from surefoot_campaign.plan import make_plan
from surefoot_campaign.program import Program, Refused, arguments_of
from surefoot_campaign.progress import Progress
from surefoot_campaign.report import short_table, write_all
from surefoot_campaign.results import records_of
from surefoot_campaign.scheduler import SCHEDULERS, Task, make_scheduler, results_of
from surefoot_campaign.spec import load_spec
from surefoot_campaign.text import in_words

ALL_RIGHT, SOME_BROKE = 0, 1
BROKEN = ("crashed", "timed_out", "refused")

DESCRIPTION = """Run a grid or a random draw of scenario parameters times seeds, each run in a process of its own.
A campaign that was interrupted or killed goes on where it was: start it again with the same words."""

EPILOG = """The spec, in short (docs/campaigns.md has all of it):
  scenario: step_down                                    or a list
  seeds: {first: 1, count: 300}                          or a list
  grid: {terrain.elements.ground.height: [-0.10, -0.14]}
  cases: {blind: {}, true state: {estimation: truth}}    the others are compared with the first, seed by seed
  draw: {disturbances.payload.mass: [0.0, 6.9]}          uniform, from the seed
  set: {duration: 60}
  timeout: 600                                           s of wall clock a run
  judge: com_error_max_m                                 what makes a run worse than another

Exit codes: 0 every run came to its end, whether it succeeded or not; 1 some crashed, took too long or
were refused by the program; 2 the input is wrong, or the campaign was interrupted.

Examples:
  surefoot campaign step_down_height --dry-run
  surefoot campaign step_down_height --jobs 2 --out results/steps
"""


def parser():
    made = Parser("campaign", DESCRIPTION, EPILOG)
    made.add_argument("spec", type=pathlib.Path, metavar="SPEC.yaml", help="what to run; or the name of one that ships, as step_down_height")
    made.add_argument("--out", type=folder_name, metavar="DIR", help="folder of the results; results/NAME by default")
    made.add_argument("--jobs", type=whole_number(), metavar="N", default=len(os.sched_getaffinity(0)),
                      help="processes at once; one a core (%(default)s) by default")  # fmt: skip
    made.add_argument("--dry-run", action="store_true", help="list the runs and which are done; run and write nothing")
    made.add_argument("--retry", action="store_true", help="make runs again that crashed, took too long or were refused")
    made.add_argument("--no-plots", action="store_true", help="leave the plots out")
    made.add_argument("--scheduler", choices=SCHEDULERS, default="local", help="who runs them; local by default")
    made.add_argument("--json", action="store_true", help="print one JSON object instead of a table")
    return made


def is_done(run, rows, retry):
    return run.id in rows and not (retry and rows[run.id]["outcome"] in BROKEN)


def dry_run(plan, rows, program, arguments, folder):
    runs = [{"id": run.id, "done": is_done(run, rows, arguments.retry), "command": program.command(run)} for run in plan.runs]
    done = sum(run["done"] for run in runs)
    if arguments.json:
        print(json.dumps({"name": plan.spec.name, "planned": len(runs), "done": done, "runs": runs}))
    else:
        for run in runs:
            print("done " if run["done"] else "to do", run["id"], run["command"])
        print(f"{len(runs)} runs, {done} done, {len(runs) - done} to do; results go to {folder}/")
    return ALL_RIGHT


def description(run, spec):
    values = [f"{key}={number_text(run.value(key))}" for key in spec.varied()]
    return " ".join([run.scenario, *values, f"seed {run.seed}"])


def sources_hash_now(run, row, program):
    """The hash of the scenario's files as the run found them; None if they are no scenario any more."""
    if row["result"] is not None:
        return row["result"].get("sources_hash", run.sources_hash)
    try:
        return program.check(run.file, run.parameters)["sources_hash"]
    except Refused:
        return None
    except (InputError, OSError, ValueError):
        return run.sources_hash  # not known


def check_unchanged(run, row, program):
    if sources_hash_now(run, row, program) != run.sources_hash:
        raise InputError(
            f"a file of the scenario {run.scenario} (its own, a base, stack, robot or URDF) changed while the campaign ran; "
            "rows so far are kept and belong to the files as they were; start again for the new ones"
        )


def run_missing(plan, missing, scheduler, journal, program):
    """Runs what has no row yet. Returns how many were ended from outside, so that they still have none."""
    tasks = {run.id: Task(run.id, [str(program.path), *arguments_of(run.file, run.seed, run.parameters), "--json"],
                          plan.spec.timeout) for run in missing}  # fmt: skip
    of_id = {run.id: run for run in missing}
    ended, done, total = 0, len(plan.runs) - len(missing), len(plan.runs)
    with Progress(plan.spec.name, done, total) as progress, results_of(scheduler, tasks.values()) as results:
        for result in results:
            run = of_id[result.id]
            if ended_from_outside(result, scheduler.stopped):
                ended += 1
                continue
            row = row_of(plan.spec.name, run, tasks[run.id], result)
            check_unchanged(run, row, program)
            journal.append(row)
            progress.update()
            if row["outcome"] in BROKEN:
                progress.say(f"{description(run, plan.spec)}: {in_words(row['outcome'])}: {row['reason']}")
    return ended


def what_is_done(plan, missing, journal):
    """Where a campaign goes on; None at the beginning."""
    done = len(plan.runs) - len(missing)
    torn = "; its last row was torn and is dropped" if journal.was_torn else ""
    return f"{plan.spec.name}: {done} of {len(plan.runs)} runs are done already, {len(missing)} to do{torn}" if done or torn else None


def open_journal(folder):
    try:
        folder.mkdir(parents=True, exist_ok=True)
        return Journal(folder / "rows.jsonl")
    except OSError as error:
        raise InputError(f"the folder {folder} can't be written: {error.strerror}; choose another with --out") from None


@dataclass(frozen=True)
class Made:
    """What came of a campaign."""

    found: dict  # its summary; None: no run is finished
    finished: int
    planned: int
    broken: int  # crashed, timed out or refused, of those that are finished
    ended: int  # from outside, so that they have no row
    stopped: int  # the signal that stopped it; 0: none

    def is_whole(self):
        return not self.ended and not self.stopped

    def trouble(self):
        """Why it is not whole."""
        return "interrupted" if self.stopped else f"{self.ended} runs were ended from outside"

    def kept(self):
        return f"{self.finished} of {self.planned} runs are finished and kept"

    def broken_note(self, retry):
        """With what makes those runs again; None if there are none."""
        return f"{self.broken} of {self.finished} runs crashed, took too long or were refused; {retry} makes them again" if self.broken else None


def make_campaign(plan, program, scheduler, folder, retry=False, plots=False, tell_begin=lambda line: None):
    """Runs what is missing and writes all results. Says on stderr how far it is, and `tell_begin` where it goes on."""
    with open_journal(folder) as journal:
        check_campaign(folder, journal.rows, plan.spec.name)
        missing = [run for run in plan.runs if not is_done(run, journal.rows, retry)]
        missing.sort(key=lambda run: run.seed)  # early results are of every point
        if line := what_is_done(plan, missing, journal):
            tell_begin(line)
        with program.copied_to(folder / "program") as copy:
            try:
                ended = run_missing(plan, missing, scheduler, journal, copy)
            except OSError as error:
                raise InputError(f"{error}; rows that are finished are kept") from None
        records = records_of(plan, journal.rows)
        found = write_all(plan, records, program, folder) if records else None
        if records and plots:
            from surefoot_campaign.plots import write_plots

            write_plots(plan, records, folder / "plots")
        broken = sum(found["runs"][outcome] for outcome in BROKEN) if records else 0
        return Made(found, len(records), len(plan.runs), broken, ended, scheduler.stopped)


def tell_results(plan, made, arguments, folder, typed):
    """Returns the exit code."""
    if made.found:
        print(json.dumps(made.found) + "\n" if arguments.json else short_table(plan, made.found, folder), end="")
    if note := made.broken_note("--retry"):
        print(f"surefoot: {note}", file=sys.stderr)
    if made.is_whole():
        return SOME_BROKE if made.broken else ALL_RIGHT
    words = [os.environ.get("SUREFOOT_COMMAND", "bin/surefoot"), "campaign", *typed]
    return tell(f"{made.trouble()}: {made.kept()}; to go on: {shlex.join(words)}")


def campaign(typed):
    arguments = parser().parse_args(typed)
    spec = load_spec(arguments.spec)
    program = Program()
    plan = make_plan(spec, program, arguments.jobs)
    for note in plan.notes:
        print(f"surefoot: warning: {note}", file=sys.stderr)
    folder = arguments.out or pathlib.Path("results") / spec.name
    if arguments.dry_run:
        rows = read_rows(folder / "rows.jsonl")
        check_campaign(folder, rows, spec.name)
        return dry_run(plan, rows, program, arguments, folder)
    scheduler = make_scheduler(arguments.scheduler, arguments.jobs)
    made = make_campaign(plan, program, scheduler, folder, arguments.retry, not arguments.no_plots, lambda line: print(line, file=sys.stderr))
    return tell_results(plan, made, arguments, folder, typed)
