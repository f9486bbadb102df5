"""The beginning of the page: what was run, how it came out, and how to run it again."""

from surefoot_campaign.text import escape
from surefoot_report.page import Cell, table
from surefoot_report.words import counted, decimal

TROUBLES = [6, 7, 8, 9, 15]  # events: no ground, contact lost, lift-off aborted, collision, caught
MOST_CHANGES = 24


def title(header):
    lead = f'<p class="lead">{escape(header["description"])}</p>\n' if header.get("description") else ""
    facts = f"{header['robot'].get('name', '')} · stack {header.get('stack', '')} · estimation {header.get('estimation', '')} · seed {header['seed']}"
    return f'<h1>{escape(header["scenario"])}</h1>\n{lead}<p class="facts">{escape(facts)}</p>\n'


def badge(style, text):
    return f'<div class="verdict {style}">{escape(text)}</div>\n'


def warning(text):
    return f'<p class="warning">{escape(text)}</p>\n'


def end_time(run):
    return f"{decimal(run.span[1], 2)} s"


def listed(style, items):
    return f'<ul class="{style}">\n' + "".join(f"<li>{item}</li>\n" for item in items) + "</ul>\n" if items else ""


def troubles(run):
    """How often something went wrong, and when first."""
    names = run.header["event_names"]
    found = [(names[event], run.event_times.get(event, [])) for event in TROUBLES if event < len(names)]
    found.append(("tick whose command is not the hierarchy's optimum", run.time[run.mode != "optimal"]))
    return listed("troubles", [f"<b>{len(times)} ×</b> {escape(what)}{', first' if len(times) > 1 else ','} at {decimal(times[0], 4)} s"
                               for what, times in found if len(times)])  # fmt: skip


def from_outside(run):
    """What pushed the robot, and what the operator did, which can be a lot."""
    found = [event for event in run.events if event["by"] in ("outside", "operator")]
    items = [f"{decimal(event['time'], 2)} s: {escape(event['text'])}" for event in found[:MOST_CHANGES]]
    return listed("pushes", items + [f"and {len(found) - MOST_CHANGES} more"] * (len(found) > MOST_CHANGES))


def criteria_badge(outcome):
    missed, count = [one.metric for one in outcome.criteria if one.passed is False], len(outcome.criteria)
    if missed:
        return badge("bad", f"✗ {len(missed)} of {count} {'criterion' if count == 1 else 'criteria'} missed: {'; '.join(missed)}")
    if not outcome.judged:
        return badge("soft", "not judged: the run is shorter than its criteria need")
    if not outcome.succeeded:
        return badge("bad", "✗ the run did not succeed")
    if count < 2:
        return badge("good", f"✓ the criterion holds: {outcome.criteria[0].metric}") if count else badge("soft", "no criteria to judge by")
    return badge("good", "✓ both criteria hold" if count == 2 else f"✓ all {count} criteria hold")


def goal_badge(outcome):
    """Criteria may ask for less than the scenario's goal, or for its failure; where they ask for it, theirs is the badge."""
    criterion = outcome.criterion("goal_reached")
    if not outcome.goal or outcome.goal_reached or (criterion is not None and criterion.passed is False):
        return ""
    expected = criterion is not None and criterion.equals is False
    return badge("soft", "goal not reached, as the criteria expect") if expected else badge("bad", "✗ goal not reached")


def ending(run, outcome):
    text = f"Ended after {end_time(run)}{f': {outcome.reason}' if outcome.reason else ''}.{f' Goal: {outcome.goal}.' if outcome.goal else ''}"
    return f"<p>{escape(text)}</p>\n"


def cut_warning(run, outcome):
    if run.problem:
        return warning(f"The log is not whole: {run.problem}. This shows what could be read of it, to {end_time(run)}.")
    if outcome.interrupted:
        return warning(f"The run was {outcome.reason} at {end_time(run)}, so this shows only its beginning, and its criteria are not judged.")
    if not outcome.known:
        return warning(f"The log holds no summary: its run did not end in the usual way. This shows it to {end_time(run)}.")
    return ""


def steered(run):
    if run.num_changes == 0:
        return ""
    changes = "change or push" if run.num_changes == 1 else "changes and pushes"
    return warning(f"The run was steered by hand: {run.num_changes} {changes} while it ran, so this is no verdict on the scenario alone.")


def verdict(run, outcome):
    """Whether the criteria hold, whether the goal was reached, why it ended, and what went wrong on the way."""
    out = cut_warning(run, outcome)
    if outcome.known and not outcome.interrupted:
        out += criteria_badge(outcome) + goal_badge(outcome) + ending(run, outcome) + steered(run)
    return out + from_outside(run) + troubles(run) + "".join(f'<p class="soft">{escape(note)}</p>\n' for note in run.header.get("notes") or [])


def left_out(run, outcome):
    """What the command alone does not repeat."""
    out = ""
    if outcome.interrupted or not outcome.known:
        out += "<p>That run goes on where this log ends.</p>\n"
    elif run.problem:
        out += "<p>What of it was changed by hand may be missing here: the log is damaged.</p>\n"
    if run.num_changes:
        out += (f"<p>It is without what was changed and pushed by hand ({counted(run.num_changes, 'time')}, on /changes): <code>replay --verify</code> on "
                "the log repeats that.</p>\n")  # fmt: skip
    return out


def provenance(run, outcome):
    """The command that makes the run again, and everything that its result depends on."""
    header, robot = run.header, run.header["robot"]
    commit, command = header.get("commit"), header.get("command")
    nominal = " (nominal: the scenario's random values are not drawn)" if header["seed"] == 0 else ""
    rows = [("surefoot", header.get("version", "") + (f", commit {commit}" if commit else "")),
            ("robot", f"{robot.get('name', '')}, {decimal(robot.get('mass'), 2)} kg"), ("stack", header.get("stack", "")),
            ("control period", f"{decimal(1e3 * run.period, 3)} ms, {decimal(1 / run.period, 1)} Hz"), ("seed", f"{header['seed']}{nominal}")]  # fmt: skip
    drawn = [[Cell(draw["path"]), Cell(decimal(draw["value"], 6))] for draw in header.get("drawn") or []]
    out = "<h2>How to make it again</h2>\n"
    if command:
        out += f"<pre>{escape(command)}</pre>\n{left_out(run, outcome)}"
    out += table([], [[Cell(name), Cell(text)] for name, text in rows])
    if drawn:
        out += f"<details><summary>What the seed drew: {counted(len(drawn), 'value')}</summary>\n{table([], drawn)}</details>\n"
    return out
