"""What became of a run: one row, whatever happened."""

import json
import signal

from surefoot_campaign.command_line import WRONG_INPUT
from surefoot_campaign.statistics import is_number

OUTCOMES = ["succeeded", "failed", "not_judged", "crashed", "timed_out", "refused"]
ENDED = (0, 1, 3, 4)  # exit codes of a run that came to its end


def last_line(text):
    lines = text.strip().splitlines()
    return lines[-1].removeprefix("surefoot: ") if lines else ""


def signal_name(number):
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def with_words(reason, stderr):
    words = last_line(stderr)
    return f"{reason}: {words}" if words else reason


def read_result(stdout):
    """The program's JSON object, or None."""
    try:
        result = json.loads(stdout)
    except ValueError:
        return None
    return result if isinstance(result, dict) and result.get("succeeded", "") in (True, False, None) else None


def ended_from_outside(result, stopped):
    """Whether somebody asked the run to end, or `stopped` its scheduler: it has no outcome, and must be made again."""
    if stopped or result.timed_out:
        return stopped and result.status not in ENDED
    asked = result.status in (-signal.SIGTERM, -signal.SIGINT)
    return asked or (result.status == WRONG_INPUT and last_line(result.stderr).startswith("interrupted"))


def number_at(result, name):
    """A metric that is a number, or None; "tick_us.p99" is a member."""
    for key in name.split("."):
        result = result.get(key) if isinstance(result, dict) else None
    return result if is_number(result) else None


def judge(task, result):
    """Outcome, reason, and the program's JSON object if there is one."""
    if result.timed_out:
        return "timed_out", f"no end within {task.timeout:g} s of wall clock", None
    if result.status < 0:
        return "crashed", with_words(f"killed by {signal_name(-result.status)}", result.stderr), None
    if result.status == WRONG_INPUT:
        return "refused", last_line(result.stderr) or "exit code 2", None
    if result.status not in ENDED:
        return "crashed", with_words(f"exit code {result.status}", result.stderr), None
    found = read_result(result.stdout)
    if found is None:
        return "crashed", f"exit code {result.status}, but its output is no result", None
    return {True: "succeeded", False: "failed"}.get(found["succeeded"], "not_judged"), found.get("reason", ""), found


def row_of(campaign, run, task, result):
    outcome, reason, found = judge(task, result)
    return {
        "id": run.id,
        "campaign": campaign,
        "scenario": run.scenario,
        "seed": run.seed,
        "version": run.version,
        "parameters": run.parameters,
        "outcome": outcome,
        "reason": reason,
        "wall_time_s": round(result.wall_time, 3),
        "result": found,
    }
