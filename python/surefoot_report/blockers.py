"""What gave way to what over a whole run, as a table."""

import numpy as np

from surefoot_report.hierarchy_figures import numbered, unit_of
from surefoot_report.page import Cell, table
from surefoot_report.words import counted, decimal, two_digits, with_unit

MOST_ROWS = 4  # of a level


def held_back(run):
    """By level the rows of higher levels that held it back, the most costly first: (level of the row, its name, ticks, sum of its costs, its
    largest, and the time of that)."""
    rows, places, found = run.blocked, {}, {}
    costs = rows["cost"].astype(float)
    for place, key in enumerate(zip(rows["level"].tolist(), rows["by"].tolist(), rows["id"].tolist())):
        places.setdefault(key, []).append(place)
    for (level, by, _), same in sorted(places.items()):
        worst = same[int(np.argmax(costs[same]))]
        row = (by, rows["row"][worst], len(same), costs[same].sum(), costs[worst], run.time[rows["tick"][worst]])
        found.setdefault(level, []).append(row)
    return {level: sorted(of_level, key=lambda row: -row[3]) for level, of_level in found.items()}


def cells(run, level, row, is_first):
    by, name, ticks, _, largest, time = row
    share = 100.0 * ticks / run.explained.sum()
    return [Cell(numbered(run, level) if is_first else ""), Cell(f"{numbered(run, by)}: {name}"), Cell(f"{decimal(ticks * run.period, 2)} s", "number"),
            Cell("< 0.1 %" if share < 0.1 else f"{decimal(share, 1)} %", "number"), Cell(with_unit(two_digits(largest), unit_of(run, level)), "number"),
            Cell(f"{decimal(time, 2)} s", "number")]  # fmt: skip


def rows_of(run, level, rows):
    shown = len(rows) if len(rows) == MOST_ROWS + 1 else min(len(rows), MOST_ROWS)
    made = [cells(run, level, row, row is rows[0]) for row in rows[:shown]]
    if shown < len(rows):
        made.append([Cell(""), Cell(f"and {counted(len(rows) - shown, 'row')} that cost less", "soft"), *[Cell("")] * 4])
    return made


def note(run):
    known = 100.0 * run.explained.mean()
    share = f" Known at {decimal(known, 1)} % of the ticks, of which the shares are." if known < 100 else ""
    return ('<p class="soft">Rows of higher levels that kept a level from what it asked for, the most costly of the run first. The cost is what the level\'s '
            "residual would fall by if that row alone gave way, as the control loop estimates it: mostly too much, and 0 where it can't say. "
            f"<code>surefoot explain</code> tells the exact ones of a recorded run's tick.{share}</p>\n")  # fmt: skip


def blocker_table(run):
    if not run.explained.any():
        return ""
    found, head = held_back(run), "<h3>What gave way to what</h3>\n"
    if not found:
        return head + '<p class="soft">No level was held back by a row above it.</p>\n'
    rows = [row for level in sorted(found) for row in rows_of(run, level, found[level])]
    return head + note(run) + table(["level", "gave way to", "for", "of the ticks", "largest cost", "at"], rows)
