"""How figures look: on paper 183 mm wide, two columns of a journal; in the page light or dark."""

import io
import pathlib
import re
from dataclasses import dataclass, field

import matplotlib
import numpy as np
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from surefoot_campaign.text import escape

STYLE = (pathlib.Path(__file__).parent / "page.css").read_text(encoding="utf-8")
LIGHT = dict(re.findall(r"--(\w+): (#\w{6});", STYLE[: STYLE.index("@media")]))  # colours by the names of page.css, which has them for dark, too
INK, SOFT, RULE, STANCE, AMBER, BOUND, GROUND = (LIGHT[name] for name in ("ink", "soft", "grid", "stance", "search", "bound", "ground"))
LEG_COLOURS = [LIGHT[f"c{leg}"] for leg in range(6)]
BLUE, ORANGE, GREEN, PURPLE = LEG_COLOURS[:4]
BASE = LIGHT["c6"]
TONES = [LIGHT[f"g{tone}"] for tone in range(5)]

WIDTH = 7.2  # [in]
LEFT, RIGHT, HEAD, GAP, FOOT = 0.62, 0.12, 0.24, 0.07, 0.40  # around the panels [in]
COLUMNS = 900  # of an image: the eye sees no more
FLICKER = 1.0 / 600  # of the width: shorter stretches are drawn so long

matplotlib.rcParams.update({
    "font.family": ["DejaVu Sans", "sans-serif"], "font.size": 8, "axes.labelsize": 8,
    "xtick.labelsize": 7, "ytick.labelsize": 7, "legend.fontsize": 7.5, "xtick.color": SOFT, "ytick.color": SOFT, "text.color": INK,
    "axes.labelcolor": INK, "axes.edgecolor": INK, "axes.linewidth": 0.7, "xtick.major.size": 2, "ytick.major.size": 2,
    "xtick.major.width": 0.5, "ytick.major.width": 0.5, "axes.grid": True, "axes.axisbelow": True, "grid.color": RULE, "grid.linewidth": 0.6,
    "lines.linewidth": 1.0, "figure.facecolor": GROUND, "axes.facecolor": "none", "legend.frameon": False, "axes.unicode_minus": True,
    "path.simplify_threshold": 0.15, "svg.fonttype": "none", "pdf.fonttype": 42,
})  # fmt: skip


@dataclass
class Panel:
    """A plot over time."""

    title: str
    unit: str  # of its axis: "error [mm]"
    curves: list  # values, and how they are drawn
    spans: list = field(default_factory=list)  # (times, colour, opacity) of shaded stretches
    bounds: list = field(default_factory=list)  # (value, label)
    note: str = ""  # where a legend would stand
    height: float = 0.95  # [in]
    from_zero: bool = False
    y_range: tuple | None = None  # by default it fits curves and bounds


def limits_of(values, share=0.08):
    """The range of all numbers there, with a margin; never of zero width."""
    values = np.concatenate([np.ravel(part) for part in values]) if len(values) else np.empty(0)
    values = values[np.isfinite(values)]
    if not len(values):
        return 0.0, 1.0
    low, high = float(values.min()), float(values.max())
    least = max(1e-9, 1e-6 * abs(low), 1e-6 * abs(high))
    margin = max(share * (high - low), least if high - low < least else 0.0)
    return low - margin, high + margin


def thinned(x, y):
    """The points that suffice to draw a curve: the first, lowest and highest of each column of the image, and the ends of gaps."""
    step = len(x) // COLUMNS
    if step < 4:
        return x, y
    first = np.arange(0, len(y), step)
    blocks = np.pad(y, (0, -len(y) % step), constant_values=np.nan).reshape(-1, step)
    lowest, highest = np.where(np.isnan(blocks), np.inf, blocks).argmin(axis=1), np.where(np.isnan(blocks), -np.inf, blocks).argmax(axis=1)
    gaps = np.flatnonzero(np.diff(np.isnan(y)))
    keep = np.unique(np.concatenate([first, first + lowest, first + highest, gaps, gaps + 1, [len(y) - 1]]))
    return x[keep], y[keep]


def axes_at(figure, left, top, width, height):
    """Axes placed in inches from the upper left corner."""
    across, down = figure.get_size_inches()
    return figure.add_axes((left / across, 1 - (top + height) / down, width / across, height / down))


def title_over(axes, text, note=""):
    axes.annotate(text, (0, 1), (0, 4), "axes fraction", "offset points")
    if note:
        axes.annotate(note, (1, 1), (0, 4), "axes fraction", "offset points", ha="right", color=SOFT, fontsize=7)


def shade(axes, times, colour, opacity, y=(0.0, 1.0)):
    """Stretches of time over the height of the axes, or a part of it."""
    if times:
        axes.broken_barh([(begin, end - begin) for begin, end in times], (y[0], y[1] - y[0]), transform=axes.get_xaxis_transform(), facecolor=colour,
                         alpha=opacity, linewidth=0)  # fmt: skip


def mark_calibration(axes, run, stretches, with_words):
    """A bar along the upper edge."""
    shade(axes, stretches, BASE, 0.7, (1 - 0.03 / axes.get_window_extent().height * 72, 1.0))
    if with_words and stretches and stretches[-1][1] - stretches[-1][0] > 0.08 * (run.span[1] - run.span[0]):
        axes.annotate("calibrates", (stretches[-1][1], 1), (-3, -10), axes.get_xaxis_transform(), "offset points", ha="right",
                      color=SOFT, fontsize=7)  # fmt: skip


def legend_over(axes, handles=None):
    handles = handles or axes.get_legend_handles_labels()[0]
    if len(handles) > 1:
        axes.legend(handles=handles, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=len(handles), borderaxespad=0.1, borderpad=0.2, handlelength=1.8,
                    columnspacing=1.2, handletextpad=0.5)  # fmt: skip


def time_figure(run, panels, calibration):
    """Plots one above the other with the same time axis."""
    height = sum(HEAD + panel.height + GAP for panel in panels) - GAP + FOOT
    figure = Figure((WIDTH, height))
    top, shared = 0.0, None
    for panel in panels:
        axes = axes_at(figure, LEFT, top + HEAD, WIDTH - LEFT - RIGHT, panel.height)
        draw_panel(axes, run, panel)
        axes.tick_params(labelbottom=panel is panels[-1])
        mark_calibration(axes, run, calibration, panel is panels[0])
        top += HEAD + panel.height + GAP
        shared = axes
    shared.set_xlabel("time [s]")
    figure.align_ylabels()
    return figure


def draw_panel(axes, run, panel):
    for times, colour, opacity in panel.spans:
        shade(axes, times, colour, opacity)
    for value, label in panel.bounds:
        axes.axhline(value, color=BOUND, linewidth=0.8, dashes=(6, 2, 1.5, 2))
        if label:
            axes.annotate(label, (1, value), (-4, -9), axes.get_yaxis_transform(), "offset points", ha="right", color=SOFT, fontsize=7)
    for y, style in panel.curves:
        axes.plot(*thinned(run.time, y), **style)
    low, high = panel.y_range or limits_of([y for y, _ in panel.curves] + [np.array([value for value, _ in panel.bounds])]
                                           + [np.zeros(1)] * panel.from_zero)  # fmt: skip
    axes.set(xlim=run.span, ylim=(0.0 if panel.from_zero else low, high), ylabel=panel.unit)
    axes.yaxis.set_major_locator(MaxNLocator(max(3, round(panel.height / 0.24)), steps=[1, 2, 5, 10]))
    axes.xaxis.set_major_locator(MaxNLocator(10, steps=[1, 2, 5, 10]))
    title_over(axes, panel.title, panel.note)
    legend_over(axes)


def saved(figure, name):
    """A figure as SVG and as PDF: the same bytes for the same figure."""
    from matplotlib.backends.backend_pdf import FigureCanvasPdf  # which reads fonts: a plot shall not wait for it

    with matplotlib.rc_context({"svg.hashsalt": name}):
        svg, pdf = io.BytesIO(), io.BytesIO()
        FigureCanvasSVG(figure).print_svg(svg, metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
        FigureCanvasPdf(figure).print_pdf(pdf, metadata={"CreationDate": None, "Producer": None, "Creator": None})
    rounded = re.sub(r"<[^>]*>", lambda tag: re.sub(r"(\d\.\d\d)\d+", r"\1", tag.group()), svg.getvalue().decode())
    return rounded, pdf.getvalue()


def inline(svg, description):
    """An SVG for the page: without a head of its own, and in the page's colours, light or dark."""
    head, body = re.search(r"<svg[^>]*>", svg), svg[svg.index("<defs>") :]
    box = re.search(r'viewBox="[^"]*"', head.group()).group()
    for name, colour in LIGHT.items():
        body = body.replace(colour, f"var(--{name})")
    body = re.sub(r'<g id="(?!m\w{10}")[^"]*">', "<g>", body)
    return f'<svg class="plot" {box} role="img" aria-label="{escape(description)}">\n{body}'
