"""Figures: a curve with its interval for each parameter, a heat map with numbers for each pair of them."""

import itertools
import textwrap

import matplotlib
import numpy
from matplotlib.figure import Figure

from surefoot_campaign.axes import axis_of
from surefoot_campaign.results import values_of
from surefoot_campaign.statistics import quantile, rate_of
from surefoot_campaign.metrics import unit_of
from surefoot_campaign.units import metric_label

FORMATS = ["png", "svg"]
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"]  # colour-blind people can distinguish them
MARKERS = "osD^vP"
FLAT = 0.05  # of the largest value: a median below it looks like 0 on a linear axis


def draw_curve(axes, axis, places, middles, lows, highs, style):
    """A line with a band where the axis is a number, open at empty cells; bars at choices and lone cells."""
    x, y, low, high = (numpy.array(values, dtype=float) for values in (places, middles, lows, highs))
    barred = numpy.isfinite(y)
    if not axis.is_choice:
        axes.fill_between(x, low, high, alpha=0.2, linewidth=0, color=style["color"])
        barred &= ~has_neighbour(barred)
    errors = numpy.stack([y - low, high - y])[:, barred]
    axes.errorbar(x[barred], y[barred], errors, fmt="none", capsize=5, ecolor=style["color"])
    axes.plot(x, y, linestyle="none" if axis.is_choice else "-", **style)


def has_neighbour(filled):
    padded = numpy.pad(filled, 1)
    return padded[:-2] | padded[2:]


def side_by_side(axis, number, count):
    """Where a series stands, so that the bars of several do not hide each other."""
    step = axis.width * min(0.12, 0.8 / count)
    return [place + step * (number - (count - 1) / 2) for place in axis.places]


def draw_rates(axes, axis, records, style, places):
    rates = [rate_of(cell) if cell else None for cell in axis.cells(records)]
    shares = [[None] * 3 if rate is None else [rate.rate, *rate.interval] for rate in rates]
    draw_curve(axes, axis, places, *(100 * numpy.array(shares, dtype=float).T), style)
    return rates


def shown_values(records, metric):
    """In the unit that people read."""
    return [unit_of(metric)[1] * value for value in values_of(records, metric)]


def draw_judge(axes, plan, axis, records, style, places):
    values = [shown_values(cell, plan.spec.judge) for cell in axis.cells(records)]
    shares = [[quantile(v, share) for share in (0.5, 0.05, 0.95)] for v in values]
    draw_curve(axes, axis, places, *zip(*shares), style)
    return [of_cell for of_cell in shares if of_cell[0] is not None]


def scale_of(drawn):
    """The scale for (median, low, high) of all cells: logarithmic where the largest would press a median flat."""
    medians, lows, highs = zip(*drawn) if drawn else ([], [], [])
    return "log" if min(lows, default=0) > 0 and min(medians) < FLAT * max(highs) else "linear"


def curve_figure(plan, records, parameter):
    """Success rate with Wilson's interval, and below it the judging metric: median and 5 to 95 % of the runs."""
    axis = axis_of(plan.spec, parameter)
    figure = Figure(figsize=(7.0, 6.0), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True)
    trials, judged = set(), []
    for number, scenario in enumerate(plan.spec.scenarios):
        style = {"color": COLOURS[number % len(COLOURS)], "marker": MARKERS[number % len(MARKERS)], "label": scenario}
        of_scenario = [record for record in records if record.run.scenario == scenario]
        places = side_by_side(axis, number, len(plan.spec.scenarios))
        rates = draw_rates(upper, axis, of_scenario, style, places)
        trials |= {rate.trials for rate in rates if rate}
        judged += draw_judge(lower, plan, axis, of_scenario, style, places)
    upper.set(ylim=(-4, 104), ylabel="succeeded [%]")
    upper.set_title(f"{plan.spec.name}: {counts_text(trials)} a point", fontsize=10, loc="left")
    lower.set(xlabel=axis.label, ylabel=metric_label(plan.spec.judge), yscale=scale_of(judged))
    note(upper, "with Wilson's 95 % interval")
    note(lower, "median, and where 5–95 % of the runs are")
    if not judged:
        say_nothing_known(lower)
        lower.set_yticks([])
    if axis.span:
        lower.set_xlim(axis.span)
    if not axis.drawn and len(axis.places) <= 12:
        lower.set_xticks(axis.places, [textwrap.fill(tick, 14) for tick in axis.ticks])
    for axes in (upper, lower):
        axes.grid(alpha=0.3)
    if len(plan.spec.scenarios) > 1:
        upper.legend(loc="best", fontsize=9)
    return figure


def say_nothing_known(axes):
    axes.text(0.5, 0.5, "no run has a value", transform=axes.transAxes, ha="center", va="center", color="0.35")


def note(axes, text):
    axes.text(1.0, 1.01, text, transform=axes.transAxes, ha="right", va="bottom", fontsize=8, color="0.35")


def counts_text(trials):
    low, high = min(trials, default=0), max(trials, default=0)
    return f"{low} runs" if low == high else f"{low} to {high} runs"


def heat_map(figure, axes, x, y, numbers, texts, colours, title):
    """Cells with a text each; those without a number stay white. `colours`: map, smallest, largest."""
    name, low, high = colours
    values = numpy.array(numbers, dtype=float)
    image = axes.imshow(values, cmap=name, vmin=low, vmax=high, origin="lower", aspect="auto")
    size = 10 if len(x.ticks) <= 6 else 8 if len(x.ticks) <= 10 else 6
    for (row, column), value in numpy.ndenumerate(values):
        red, green, blue, _ = image.cmap(image.norm(value)) if numpy.isfinite(value) else (1, 1, 1, 1)
        dark = 0.299 * red + 0.587 * green + 0.114 * blue < 0.5
        axes.text(column, row, texts[row][column], ha="center", va="center", fontsize=size, color="w" if dark else "k")
    slanted = {"rotation": 30, "ha": "right", "rotation_mode": "anchor"} if max(map(len, x.ticks)) * len(x.ticks) > 45 else {}
    axes.set_xticks(range(len(x.ticks)), x.ticks, **slanted)
    axes.set_yticks(range(len(y.ticks)), y.ticks)
    axes.set_xlabel(x.label)
    axes.set_title(title, fontsize=10)
    if numpy.isfinite(values).any():
        figure.colorbar(image, ax=axes)
    else:
        say_nothing_known(axes)


def map_figure(plan, records, scenario, parameters):
    """Success rate, and the median of the judging metric, over two parameters."""
    x, y = (axis_of(plan.spec, parameter) for parameter in parameters)
    cells = [x.cells(row) for row in y.cells(records)]
    figure = Figure(figsize=(4.0 + 1.6 * max(3, len(x.ticks)), 1.8 + 0.62 * max(3, len(y.ticks))), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    rates = [[rate_of(cell) if cell else None for cell in row] for row in cells]
    texts = [["" if r is None else f"{100 * r.rate:.0f} %\n{r.successes}/{r.trials}" for r in row] for row in rates]
    percent = [[None if r is None else 100 * r.rate for r in row] for row in rates]
    heat_map(figure, left, x, y, percent, texts, ("cividis", 0, 100), "succeeded [%]")
    medians = [[quantile(shown_values(cell, plan.spec.judge), 0.5) for cell in row] for row in cells]
    texts = [["" if m is None else f"{m:.3g}" for m in row] for row in medians]
    heat_map(figure, right, x, y, medians, texts, ("viridis_r", None, None), f"median of {metric_label(plan.spec.judge)}")
    left.set_ylabel(y.label)
    figure.suptitle(f"{plan.spec.name}: {scenario}", fontsize=11)
    return figure


def save(figure, path):
    """Writes the same bytes for the same figure."""
    figure.savefig(path, dpi=150, metadata={"Software": None} if path.suffix == ".png" else {"Date": None, "Creator": None})


def figures(plan, records):
    """(name, figure) of everything worth showing."""
    for parameter in plan.spec.varied():
        yield parameter, curve_figure(plan, records, parameter)
    for scenario, pair in itertools.product(plan.spec.scenarios, itertools.combinations(plan.spec.varied(), 2)):
        name = "__".join(pair) + (f"__{scenario}" if len(plan.spec.scenarios) > 1 else "")
        of_scenario = [record for record in records if record.run.scenario == scenario]
        if of_scenario:
            yield name, map_figure(plan, of_scenario, scenario, pair)


def write_plots(plan, records, folder):
    """Writes all figures. Removes those of an earlier start."""
    matplotlib.use("agg")
    matplotlib.rcParams["svg.hashsalt"] = plan.spec.name
    folder.mkdir(exist_ok=True)
    for old in [file for form in FORMATS for file in folder.glob(f"*.{form}")]:
        old.unlink()
    for name, figure in figures(plan, records):
        for form in FORMATS:
            save(figure, folder / f"{name.replace('/', '_')}.{form}")
