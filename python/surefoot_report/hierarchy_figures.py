"""Figures of rows over time: how the levels came out, which limits acted, and what the planner did; and the time of the ticks."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator

from surefoot_campaign.text import in_words
from surefoot_log.frames import visible_residuals
from surefoot_report.motion_figures import calibration, times_of
from surefoot_report.plotting import BLUE, BOUND, FLICKER, FOOT, HEAD, LEFT, ORANGE, RIGHT, SOFT, WIDTH, axes_at, legend_over, mark_calibration, thinned
from surefoot_report.run_data import ROUNDING, STANCE, chosen
from surefoot_report.words import decimal, two_digits, with_unit

LETTER = 0.058  # how wide one is, on average [in]
GRAVITY = 9.81
LOADED = 0.1  # of the weight, as for the friction margin
SHORTEST = 0.01  # what acted for less is a flicker [s]
BINS = 90


def numbered(run, level):
    return f"{level + 1}  {in_words(run.levels[level])}"


def unit_of(run, level):
    units = run.header.get("level_units") or []
    return units[level] if level < len(units) else ""


def never_zero(run, level):
    """Whether the level asks for no force or torque at all."""
    return visible_residuals(run.header).get(run.levels[level], ROUNDING) is None


def room_for(texts, least):
    return max([least, *(LETTER * len(text) + 0.1 for text in texts)])


def rows_axes(run, names, row, right=RIGHT, head=HEAD):
    """An axes with a row for each name, highest first: row k from −k − 1 to −k."""
    left, height = room_for(names, 1.2), row * len(names)
    figure = Figure((WIDTH, head + height + FOOT))
    axes = axes_at(figure, left, head, WIDTH - left - right, height)
    axes.set(xlim=run.span, ylim=(-len(names), 0), xlabel="time [s]")
    axes.xaxis.set_major_locator(MaxNLocator(10, steps=[1, 2, 5, 10]))
    axes.set_yticks(-0.5 - np.arange(len(names)), names)
    axes.tick_params(axis="y", length=0)
    axes.grid(axis="y", visible=False)
    return figure, axes


def residual_figure(run):
    """Each level from 0 to its own largest residual, which stands at the right."""
    if not run.levels:
        return None
    values = np.fmax(np.nan_to_num(run.residual), 0.0)  # where a tick solved nothing there is no curve
    sizes = []
    for level, largest in enumerate(values.max(axis=0)):
        size = with_unit(two_digits(largest), unit_of(run, level)) if largest > ROUNDING else "0"
        sizes.append(size + ("  *" if never_zero(run, level) else ""))
    right = room_for(sizes, 0.55)
    figure, axes = rows_axes(run, [numbered(run, level) for level in range(len(run.levels))], 0.22, right)
    axes.annotate("largest", (1, 1), (6, 4), "axes fraction", "offset points")
    for level, size in enumerate(sizes):
        bottom, largest = -level - 1, values[:, level].max()
        axes.axhline(bottom, color=SOFT, alpha=0.3, linewidth=0.5)
        axes.annotate(size, (1, bottom + 0.5), (6, 0), axes.get_yaxis_transform(), "offset points", va="center", fontsize=7)
        if largest > ROUNDING:
            colour, opacity = (SOFT, 0.6) if never_zero(run, level) else (BLUE, 1.0)
            curve = bottom + values[:, level] / (1.06 * largest)
            axes.plot(*thinned(run.time, curve), color=colour, alpha=opacity, linewidth=0.6)
            axes.fill_between(*thinned(run.time, curve), bottom, color=colour, alpha=0.35 * opacity, linewidth=0)
    mark_calibration(axes, run, calibration(run), True)
    return figure


def strips_figure(run, strips, legend=()):
    """`strips`: of each row its name, and its times in blue and in orange."""
    if not strips:
        return None
    figure, axes = rows_axes(run, [name for name, *_ in strips], 0.15, head=HEAD if legend else 0.06)
    least = FLICKER * (run.span[1] - run.span[0])  # a bar is seen however short it is
    for row, (_, *both) in enumerate(strips):
        for times, colour in zip(both, (BLUE, ORANGE)):
            axes.broken_barh([(begin, max(end - begin, least)) for begin, end in times], (-row - 0.75, 0.5), facecolor=colour, linewidth=0)
    mark_calibration(axes, run, calibration(run), False)
    legend_over(axes, [Patch(color=colour, label=label) for label, colour in zip(legend, (BLUE, ORANGE))])
    return figure


def leg_of(run, row):
    return next((k for k, leg in enumerate(run.legs) if row.startswith(leg)), len(run.legs))


def informative(run, rows):
    """Which rows say something of the run. At lift-off and touchdown the force follows its ramp to zero, where all sides of the friction cone
    meet: rows are active there in every run."""
    names = rows["row"]
    legs = np.array([leg_of(run, name) for name in names], int)
    is_force = np.array([name.endswith(" normal force") for name in names], bool)
    is_slip = np.array([" slip " in name for name in names], bool)
    leg, tick, state = np.minimum(legs, len(run.legs) - 1), rows["tick"], rows["state"].astype(int)
    least, most = np.moveaxis(run.force_limits[tick, leg], -1, 0)
    load = np.einsum("ni,ni->n", run.R_WC[tick][:, :, 2], run.force[tick, leg])
    pressed = (state < 0) & (run.phase[tick, leg] == STANCE) & (most > 2 * least)
    loaded = ~(load < LOADED * (run.header["robot"].get("mass") or np.nan) * GRAVITY)
    always = (legs == len(run.legs)) | (np.abs(state) > 1) | ~(is_force | is_slip)
    return always | np.where(is_force, pressed, loaded)


def group_of(run, level, name):
    """Rows of a leg in a level are one group, but its normal force another. In the order of level, leg, and name."""
    leg = leg_of(run, name)
    task = in_words(run.levels[level])
    task = task.removesuffix("s") if task.endswith("limits") else task
    if leg == len(run.legs):
        text = f"{task}: {name}"
    else:
        text = f"least normal force {run.legs[leg]}" if name.endswith(" normal force") else f"{task} {run.legs[leg]}"
    return level, leg, f"{level + 1}  {text}"


def active_rows_figure(run):
    rows, groups, strips = chosen(run.active, informative(run, run.active)), {}, []
    keys = list(zip(rows["level"].tolist(), rows["row"]))
    names = {key: group_of(run, *key) for key in set(keys)}
    for place, key in enumerate(keys):
        groups.setdefault(names[key], []).append(place)
    beyond = np.abs(rows["state"].astype(int)) > 1
    for group in sorted(groups):
        places = np.array(groups[group])
        plain, strong = (times_of(run, rows["tick"][places[beyond[places] == is_beyond]]) for is_beyond in (False, True))
        plain = [(begin, end) for begin, end in plain if end - begin >= SHORTEST - 1e-9]
        if plain or strong:
            strips.append((group[2], plain, strong))
    return strips_figure(run, strips, ("held at its bound", "beyond it"))


def event_figure(run):
    names, strips = run.header["event_names"], []
    for event, times in run.event_times.items():
        name = names[event] if 0 < event < len(names) else f"event {event}"
        strips.append((f"{name} ({len(times)})", [(time, time + run.period) for time in times], []))
    return strips_figure(run, strips)


def timing_figure(run):
    """Histogram of the time per tick."""
    totals, period = run.totals[run.totals > 0], 1e6 * run.period
    if not len(totals):
        return None
    edges = np.geomspace(min(totals.min(), period) / 10**0.1, max(totals.max(), period) * 10**0.1, BINS + 1)
    shares = 100.0 * np.histogram(totals, edges)[0] / len(totals)
    figure = Figure((WIDTH, HEAD + 1.4 + FOOT))
    axes = axes_at(figure, LEFT, HEAD, WIDTH - LEFT - RIGHT, 1.4)
    highest = 1.08 * shares.max()
    heights = np.where(shares > 0, np.maximum(shares, 0.01 * highest), 0)  # a single tick is still seen
    axes.bar(edges[:-1], heights, 0.9 * np.diff(edges), align="edge", color=BLUE, alpha=0.75)
    axes.set(xscale="log", xlim=(edges[0], edges[-1]), ylim=(0, highest), xlabel="time per tick [µs]", ylabel="share of ticks [%]")
    axes.xaxis.set_major_locator(FixedLocator([factor * 10.0**power for power in range(-2, 9) for factor in (1, 2, 5)]))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: decimal(value, 2)))
    median, p99 = np.quantile(totals, [0.5, 0.99], method="inverted_cdf")
    marks = [("median", median), ("99 %", p99), ("slowest", totals.max()), ("period", period)]
    for row, (name, value) in enumerate(marks):
        at_right_end = value > edges[0] * (edges[-1] / edges[0]) ** 0.8
        axes.axvline(value, color=BOUND, linewidth=0.8, dashes=(6, 2, 1.5, 2))
        axes.annotate(f"{name} {decimal(value, 1 if value < 10 else 0)} µs", (value, 1), (-4 if at_right_end else 4, -9 - 9 * row),
                      axes.get_xaxis_transform(), "offset points", ha="right" if at_right_end else "left", color=SOFT, fontsize=7)  # fmt: skip
    return figure
