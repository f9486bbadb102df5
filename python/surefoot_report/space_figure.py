"""The walk in space, from above and from the side, over its ground."""

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from surefoot_report.ground import Ground
from surefoot_report.motion_figures import source
from surefoot_report.plotting import (BASE, FOOT, GROUND, HEAD, INK, LEFT, LEG_COLOURS, ORANGE, RIGHT, SOFT, TONES, WIDTH, axes_at, legend_over,
                                      title_over)  # fmt: skip
from surefoot_report.words import decimal

HIGHEST = 4.25  # height of the view from above [in]
AROUND, AROUND_HEIGHTS = 0.08, 0.05  # around what is shown [m]
CELLS = 220  # of the raster of the ground along x
JUMP = 0.01  # a larger step is an edge [m]
CREASE = 0.02  # a larger change of slope is a crease
LEVEL = 1e-3  # ground with a smaller slope is level
HALVINGS = 8
SHORTEST = 0.1  # time for which three feet carry [s]
NO_EDGE, IS_CREASE, IS_EDGE = range(3)


def footprints(run):
    """Legs, and where each was set down: the foot sphere's centre."""
    tick, leg = np.nonzero(np.diff(np.vstack([np.zeros(len(run.legs), bool), run.contact]).astype(int), axis=0) == 1)
    return leg, run.seen.p_SF[tick, leg]


def support_triangles(run):
    """Triangles of three feet that carry the robot for a while."""
    around = [0, *range(1, len(run.legs), 2), *range(len(run.legs) - 2, 0, -2)]  # the polygon of the feet: LF, RF, RH, LH
    begins = np.flatnonzero(np.append(True, (np.diff(run.contact.astype(int), axis=0) != 0).any(axis=1)))
    ends = np.append(run.time[begins[1:]], run.time[-1])
    return [run.seen.p_SF[begin, [leg for leg in around if run.contact[begin, leg]], :2] for begin, end in zip(begins, ends)
            if run.contact[begin].sum() == 3 and end - run.time[begin] >= SHORTEST]  # fmt: skip


def range_of(*values, around):
    values = np.concatenate([np.ravel(part) for part in values])
    return float(np.nanmin(values)) - around, float(np.nanmax(values)) + around


class Raster:
    """The ground at the corners of cells, and where its borders cross them."""

    def __init__(self, ground, x, y):
        cell = (x[1] - x[0]) / CELLS
        self.x, self.y = np.linspace(*x, CELLS + 1), np.linspace(*y, max(2, round((y[1] - y[0]) / cell)) + 1)
        self._ground = ground
        self.face, self.z, self.slope = ground.at(self.x[None, :], self.y[:, None])
        self.has_heights = np.isfinite(self.z).any()
        self.low, self.high = (np.nanmin(self.z), np.nanmax(self.z)) if self.has_heights else (0.0, 0.0)

    def _crossings(self, along):
        """On the cells' sides along x (1) or y (0): where the face changes, and what kind of border that is."""
        x, y = np.meshgrid(self.x, self.y)
        begin, end = ((slice(None), slice(None, -1)), (slice(None), slice(1, None))) if along else (slice(None, -1), slice(1, None))
        at, kind = np.full((*self.face[begin].shape, 2), np.nan), np.zeros(self.face[begin].shape, int)
        changes = self.face[begin] != self.face[end]
        near, far = (np.stack([x[side][changes], y[side][changes]]) for side in (begin, end))
        face = self.face[begin][changes]
        for _ in range(HALVINGS):
            middle = 0.5 * (near + far)
            inside = self._ground.at(*middle)[0] == face
            near, far = np.where(inside, middle, near), np.where(inside, far, middle)
        before, after = self._ground.at(*near), self._ground.at(*far)
        jumps = (np.isnan(before[1]) != np.isnan(after[1])) | (np.abs(before[1] - after[1]) > JUMP)
        bends = np.linalg.norm(before[2] - after[2], axis=1) > CREASE
        at[changes], kind[changes] = far.T, np.where(jumps, IS_EDGE, np.where(bends, IS_CREASE, NO_EDGE))
        return at, kind

    def borders(self):
        """Segments of creases and of edges: in each cell from its crossings to their middle."""
        (flat, flat_kind), (steep, steep_kind) = self._crossings(1), self._crossings(0)
        at = np.stack([flat[:-1], flat[1:], steep[:, :-1], steep[:, 1:]])
        kind = np.max([flat_kind[:-1], flat_kind[1:], steep_kind[:, :-1], steep_kind[:, 1:]], axis=0)
        count = np.isfinite(at[..., 0]).sum(axis=0)
        middle = np.nansum(at, axis=0) / np.maximum(count, 1)[..., None]
        segments = np.stack([at, np.broadcast_to(middle, at.shape)], axis=-2)
        return [segments[np.isfinite(at[..., 0]) & (kind == wanted)] for wanted in (IS_CREASE, IS_EDGE)]

    def smooth_heights(self):
        """The heights without those next to a jump."""
        across, up = (np.abs(np.diff(self.z, axis=axis)) > JUMP for axis in (1, 0))
        at_jump = np.pad(across, ((0, 0), (0, 1))) | np.pad(across, ((0, 0), (1, 0))) | np.pad(up, ((0, 1), (0, 0))) | np.pad(up, ((1, 0), (0, 0)))
        return np.where(at_jump, np.nan, self.z)


def draw_ground(axes, ground, x, y):
    raster = Raster(ground, x, y)
    if not raster.has_heights:
        return
    if raster.high - raster.low > JUMP:
        axes.set_facecolor(TONES[-1])
        axes.contourf(raster.x, raster.y, raster.z, np.linspace(raster.low - 1e-9, raster.high + 1e-9, len(TONES) + 1), colors=TONES[::-1])
        label_level_ground(axes, raster)
    if (np.linalg.norm(raster.slope, axis=-1) > LEVEL).any():
        levels = MaxNLocator(8, steps=[1, 2, 5, 10]).tick_values(raster.low, raster.high)
        lines = axes.contour(raster.x, raster.y, raster.smooth_heights(), levels, colors=SOFT, linewidths=0.5, linestyles="solid")
        axes.clabel(lines, fontsize=6.5, fmt=lambda height: f"{decimal(height, 3)} m")
    for segments, width in zip(raster.borders(), (0.8, 1.5)):
        axes.add_collection(LineCollection(segments, colors=INK, linewidths=width), autolim=False)


def label_level_ground(axes, raster):
    """Writes the height of level ground at the lower edge, where there is room."""
    row = 1
    begins = np.flatnonzero(np.append(True, np.diff(raster.face[row]) != 0))
    for begin, end in zip(begins, np.append(begins[1:], len(raster.x))):
        is_level = raster.face[row, begin] >= 0 and np.linalg.norm(raster.slope[row, begin]) < LEVEL
        if is_level and end - begin >= 0.17 * CELLS:
            axes.annotate(f"ground at {decimal(raster.z[row, begin], 3)} m", (raster.x[begin], raster.y[0]), (5, 4), textcoords="offset points",
                          color=SOFT, fontsize=7)  # fmt: skip


def draw_prints(axes, legs, x, y, sizes):
    """Front feet below and larger: a hind foot that steps into their print stays visible in it."""
    for shown, size in zip((legs < 2, legs >= 2), sizes):
        axes.scatter(x[shown], y[shown], size, np.array(LEG_COLOURS)[legs[shown]], edgecolors=GROUND, linewidths=0.7, zorder=3)


def draw_above(axes, run, prints, ground):
    draw_ground(axes, ground, axes.get_xlim(), axes.get_ylim())
    axes.add_collection(PolyCollection(support_triangles(run), facecolors="none", edgecolors=SOFT, linewidths=0.5, alpha=0.45), autolim=False)
    axes.plot(*run.seen.p_SCom[:, :2].T, color=INK)
    axes.plot(*run.desired_com.T, color=ORANGE, linestyle="--")
    draw_prints(axes, prints[0], *prints[1].T[:2], (34, 12))


def profile(run, prints, ground, left, x):
    """Ground along the walk under the feet of one side: between its footprints, from one to the next along x."""
    track = sorted(tuple(p[:2]) for leg, p in zip(*prints) if (leg % 2 == 0) == left)
    return ground.at(x, np.interp(x, *zip(*track)))[1] if track and ground else None


def draw_side(axes, run, prints, ground, sole):
    x = np.arange(*axes.get_xlim(), 0.002)
    profiles = [z for left in (True, False) if (z := profile(run, prints, ground, left, x)) is not None]
    for z in profiles:
        if np.isfinite(z).all():
            axes.fill_between(x, z, axes.get_ylim()[0], color=SOFT, alpha=0.09, linewidth=0)
    for z in profiles:
        axes.plot(x, z, color=INK, linewidth=1.3)
    for leg, colour in zip(range(len(run.legs)), LEG_COLOURS):
        axes.plot(run.seen.p_SF[:, leg, 0], run.seen.p_SF[:, leg, 2] - sole, color=colour, linewidth=0.7)
    draw_prints(axes, prints[0], prints[1][:, 0], prints[1][:, 2] - sole, (22, 9))
    axes.plot(run.seen.p_SCom[:, 0], run.seen.p_SCom[:, 2], color=INK)
    axes.plot(run.seen.p_SB[:, 0], run.seen.p_SB[:, 2], color=BASE)


def map_figure(run):
    """Both views to the same scale."""
    prints, ground, sole = footprints(run), Ground(run.header.get("terrain")), run.header["robot"].get("foot_radius") or 0.0
    if not len(prints[0]):
        return None
    feet, width = run.seen.p_SF, WIDTH - LEFT - RIGHT
    x, y = range_of(prints[1][:, 0], feet[..., 0], around=AROUND), range_of(prints[1][:, 1], around=AROUND)
    below = ground.at(feet[::10, :, 0], feet[::10, :, 1])[1]
    z = range_of(run.seen.p_SB[:, 2], run.seen.p_SCom[:, 2], feet[..., 2] - sole, below, around=AROUND_HEIGHTS)
    scale = max((x[1] - x[0]) / width, (y[1] - y[0]) / HIGHEST)  # metres of an inch
    spare = 0.5 * (scale * width - (x[1] - x[0]))
    x, high, deep = (x[0] - spare, x[1] + spare), (y[1] - y[0]) / scale, (z[1] - z[0]) / scale
    figure = Figure((WIDTH, 2 * HEAD + high + HEAD + FOOT + deep + FOOT))
    above = axes_at(figure, LEFT, 2 * HEAD, width, high)
    side = axes_at(figure, LEFT, 2 * HEAD + high + FOOT + HEAD, width, deep)
    for axes, title, limits, name in ((above, "(a) from above", y, "y [m]"), (side, "(b) from the side", z, "z [m]")):
        axes.set(xlim=x, ylim=limits, xlabel="x [m]", ylabel=name)
        axes.yaxis.set_major_locator(MaxNLocator("auto", steps=[1, 2, 5, 10]))
        title_over(axes, title)
    draw_above(above, run, prints, ground)
    draw_side(side, run, prints, ground, sole)
    figure.align_ylabels()
    legend_over(above, [Line2D([], [], color=BASE, label="base (side)"), Line2D([], [], color=INK, label=f"{source(run)} COM"),
                        Line2D([], [], color=ORANGE, linestyle="--", label="desired COM"),
                        *(Line2D([], [], color=colour, linewidth=3, label=leg) for leg, colour in zip(run.legs, LEG_COLOURS))])  # fmt: skip
    return figure
