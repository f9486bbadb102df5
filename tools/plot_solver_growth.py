"""Draws how the solver's time grows, from `benchmark_solver --growth --json FILE`, as an SVG.

    tools/plot_solver_growth.py build/growth.json docs/images/solver_growth.svg
"""

import json
import math
import sys

PANELS = [("unknowns", "unknowns n (11 levels, 2.4 n rows)"), ("levels", "levels (30 unknowns, 72 rows)"),
          ("rows", "rows (30 unknowns, 11 levels)"), ("active", "active inequality rows")]
LINES = [("cold_us", "without a guess", "#b3541e"), ("warm_us", "warm", "#1f6f8b"), ("bound_us", "flops at product speed", "#777777")]
WIDTH, HEIGHT, LEFT, TOP, PLOT_W, PLOT_H, GAP_X, GAP_Y = 900, 640, 62, 40, 350, 210, 88, 90


def ticks(low, high):
    """1, 2 and 5 times powers of ten between two numbers."""
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    return [m * 10.0**d for d in decades for m in (1, 2, 5) if low <= m * 10.0**d <= high]


class Axis:
    """Logarithmic, from pixel `begin` to pixel `end`."""

    def __init__(self, values, begin, end):
        self.low, self.high = min(values) / 1.15, max(values) * 1.15
        self.begin, self.end = begin, end

    def __call__(self, value):
        share = math.log(value / self.low) / math.log(self.high / self.low)
        return self.begin + share * (self.end - self.begin)


def text(x, y, content, anchor="middle", extra=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" {extra}>{content}</text>'


def panel(points, key, title, left, top):
    points = sorted((p for p in points if p["against"] == key and p["value"] > 0), key=lambda p: p["value"])
    x = Axis([p["value"] for p in points], left, left + PLOT_W)
    y = Axis([p[line] for p in points for line, _, _ in LINES], top + PLOT_H, top)
    parts = [f'<rect x="{left}" y="{top}" width="{PLOT_W}" height="{PLOT_H}" fill="none" stroke="#999"/>',
             text(left + PLOT_W / 2, top + PLOT_H + 36, title)]
    for value in ticks(x.low, x.high):
        parts.append(text(x(value), top + PLOT_H + 17, f"{value:g}"))
        parts.append(f'<line x1="{x(value):.1f}" x2="{x(value):.1f}" y1="{top}" y2="{top + PLOT_H}" stroke="#e4e4e4"/>')
    for value in ticks(y.low, y.high):
        parts.append(text(left - 6, y(value) + 4, f"{value:g}", "end"))
        parts.append(f'<line x1="{left}" x2="{left + PLOT_W}" y1="{y(value):.1f}" y2="{y(value):.1f}" stroke="#e4e4e4"/>')
    for line, _, colour in LINES:
        dash = ' stroke-dasharray="5 4"' if line == "bound_us" else ""
        path = " ".join(f"{x(p['value']):.1f},{y(p[line]):.1f}" for p in points)
        parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"{dash}/>')
        if line != "bound_us":
            parts += [f'<circle cx="{x(p["value"]):.1f}" cy="{y(p[line]):.1f}" r="3" fill="{colour}"/>' for p in points]
    return parts


def draw(points):
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="12">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    for i, (line, name, colour) in enumerate(LINES):
        at = LEFT + 170 * i
        dash = ' stroke-dasharray="5 4"' if line == "bound_us" else ""
        parts.append(f'<line x1="{at}" x2="{at + 28}" y1="18" y2="18" stroke="{colour}" stroke-width="2"{dash}/>')
        parts.append(text(at + 34, 22, name, "start"))
    parts.append(text(WIDTH - 24, 22, "median time of a solve in µs, both axes logarithmic", "end"))
    for i, (key, title) in enumerate(PANELS):
        parts += panel(points, key, title, LEFT + (i % 2) * (PLOT_W + GAP_X), TOP + (i // 2) * (PLOT_H + GAP_Y))
    return "\n".join([*parts, "</svg>", ""])


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as file:
        drawing = draw(json.load(file))
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(drawing)
