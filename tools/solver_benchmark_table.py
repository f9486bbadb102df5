"""The figures of docs/benchmarks.md from `benchmark_solver --json FILE`: replaces what stands between its marks, keeps
all figures of each solver in docs/results/solver.csv, and prints the line of docs/results.md about the solver.

    tools/solver_benchmark_table.py build/solver.json build/growth.json docs/benchmarks.md docs/results/solver.csv
"""

import csv
import json
import math
import os
import re
import sys

STRICT = ["walk_flat_sea, terrain_adaptation", "step_down, terrain_adaptation"]
WALK = "walk_flat_sea, walk"
HARD = ["aggressive", "infeasible"]
WARM = "ours, warm"


def number(value, digits):
    """Solvers that came back from no problem have no time."""
    return "–" if value is None or math.isnan(value) else f"{value:.{digits}f}"


COLUMNS = ("family problems active_rows solver median_q p99_q max_q times_ours right_percent within_1e-3_percent "
           "failed hung allocations").split()


def rows(family):
    """The figures of each solver of a family; the first solver is ours."""
    ours = family["solvers"][0]["median_us"]
    for solver in family["solvers"]:
        times = [solver[key] for key in ("median_us", "p99_us", "max_us")]
        in_q = [number(None if t is None else t / family["q_us"], 2) for t in times]
        ratio = number(None if times[0] is None else times[0] / ours, 2)
        yield dict(zip(COLUMNS, [
            family["family"], str(family["problems"]), f"{family['active_rows']:.1f}", solver["solver"], *in_q, ratio,
            f"{solver['right_percent']:.1f}", f"{solver['near_percent']:.1f}", str(solver["failed"]), str(solver["hung"]),
            f"{solver['allocations']:.0f}"], strict=True))


def table(kept):
    """A line a family; warm starts where there are sequences. The rest is in the file that keeps the rows."""
    families = {}
    for row in kept:
        families.setdefault(row["family"], {})[row["solver"]] = row
    names = list(dict.fromkeys(name.removesuffix(", warm") for solvers in families.values() for name in solvers))
    others = [name for name in names if name != "ours"]

    def short(text):
        return text.removesuffix(".0")

    def cell(solvers, name):
        row = solvers.get(f"{name}, warm") or solvers.get(name)
        if row is None:
            return "–"
        ratio = row["times_ours"] if row["times_ours"] == "–" else f"{float(row['times_ours']):.1f}"
        return f"{ratio}, {short(row['right_percent'])}"

    yield "\n| family | ours | " + " | ".join(others) + " |"
    yield "|---" * (len(others) + 2) + "|"
    for family, solvers in families.items():
        ours = solvers.get(WARM) or solvers["ours"]
        first = f"{ours['median_q']} Q, {ours['p99_q']} Q, {short(ours['right_percent'])}"
        yield " | ".join([f"| {family.replace('terrain_adaptation', 'Table I')}", first, *(cell(solvers, name) for name in others)]) + " |"
    yield ""


def keep(kept, file):
    with open(file, "w", encoding="utf-8", newline="") as out:
        writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(kept)


class Measured:
    """Looks up what the goals ask for."""

    def __init__(self, families):
        self.families = {family["family"]: {solver["solver"]: solver for solver in family["solvers"]} for family in families}
        self.q = {family["family"]: family["q_us"] for family in families}

    def in_q(self, family, solver=WARM, key="median_us"):
        return self.families[family][solver][key] / self.q[family]

    def times_ours(self, family, names, ours=WARM, key="median_us"):
        """How many times longer the best of some solvers takes; NaN where none of them was measured."""
        others = [solver[key] for name, solver in self.families[family].items() if names(name, solver)]
        return min(others, default=math.nan) / self.families[family][ours][key]


def is_daqp(name, _):
    return name.startswith("DAQP hierarchical")


def is_cascade(name, _):
    return name.endswith("cascade") and not name.startswith("our")


def is_paper(name, _):
    return name.startswith("QuadProg cascade")


def is_exact(name, solver):
    return not name.startswith("our") and solver["right_percent"] >= 99.0


def goals(families, growth):
    """Must and what was measured, a line each."""
    m = Measured(families)
    reduced = [f"{family}, reduced" for family in [*STRICT, WALK]]
    humanoid = max((p for p in growth if p["against"] == "humanoid"), key=lambda p: p["value"])
    allocations = max(s["allocations"] for f in families for s in f["solvers"] if s["solver"] in ("ours", WARM))

    def list_of(values, digits, unit):
        return " / ".join(number(v, digits) for v in values) + f" {unit}"

    def ratios(names, chosen=STRICT, ours=WARM, key="median_us"):
        return list_of((m.times_ours(f, names, ours, key) for f in chosen), 1, "×")

    lines = [
        ("warm walking, median (walk, step_down)", "0.5 Q", list_of(map(m.in_q, STRICT), 2, "Q")),
        ("… walk_weighted, the scenario's own stack", "", list_of([m.in_q(WALK)], 2, "Q")),
        ("… DAQP hierarchical", "6 ×", ratios(is_daqp)),
        ("… best cascade", "20 ×", ratios(is_cascade)),
        ("… QuadProg cascade, the paper's", "40 ×", ratios(is_paper)),
        ("… p99 of the best that is right (99 % or more)", "6 ×", ratios(is_exact, key="p99_us")),
        ("hard cold, median (aggressive, infeasible)", "2 Q", list_of((m.in_q(f, "ours") for f in HARD), 2, "Q")),
        ("… DAQP hierarchical", "2.5 ×", ratios(is_daqp, HARD, "ours")),
        ("… best cascade", "9 ×", ratios(is_cascade, HARD, "ours")),
        ("reduced warm, median (walk, step_down, walk_weighted)", "0.15 Q", list_of(map(m.in_q, reduced), 2, "Q")),
        (f"humanoid, n = {humanoid['unknowns']}, slowest of 200 ticks", "1 ms", f"{humanoid['warm_max_us'] / 1e3:.1f} ms"),
        ("allocations", "0", f"{allocations:.0f}"),
    ]
    yield "\n| | must | measured |"
    yield "|---|--:|--:|"
    for line in lines:
        yield "| " + " | ".join(line) + " |"
    yield ""


def circumstances(families):
    """The machine and how busy it was, as Q tells."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        model = re.search(r"model name\s*: (.*)", file.read())
    q = [family["q_us"] for family in families]
    counts = sorted({family["problems"] for family in families})
    yield (f"\n{os.cpu_count()} cores ({model.group(1).strip() if model else 'unknown'}), Q from {min(q):.1f} to {max(q):.1f} µs; "
           f"{' or '.join(map(str, counts))} problems a family.")


def results_line(families):
    m = Measured(families)
    medians, tails = ([m.in_q(f, key=key) for f in [*STRICT, WALK]] for key in ("median_us", "p99_us"))

    def span(values, digits):
        low, high = f"{min(values):.{digits}f}", f"{max(values):.{digits}f}"
        return low if low == high else f"{low}–{high}"

    right = min(m.families[f][WARM]["right_percent"] for f in STRICT)
    daqp, paper = ([m.times_ours(f, names) for f in STRICT] for names in (is_daqp, is_paper))
    return (f"| any | the solver alone, `benchmark_solver`, warm on recorded walks: median, 99 %; right answers | {span(medians, 2)}, "
            f"{span(tails, 1)} times a QR of 30 × 30; {right:g} %. DAQP hierarchical takes {span(daqp, 1)} times as long, the "
            f"paper's QuadProg cascade {span(paper, 0)} times ([more](benchmarks.md)) |")


def write(text, mark, lines, document):
    begin, end = f"<!-- {mark}: begin -->", f"<!-- {mark}: end -->"
    pattern = re.escape(begin) + ".*" + re.escape(end)
    if not re.search(pattern, text, re.DOTALL):
        sys.exit(f"{document} has no lines {begin} and {end}")
    return re.sub(pattern, lambda _: "\n".join([begin, *lines, end]), text, flags=re.DOTALL)


def main(results, growth, document, kept_file):
    with open(results, encoding="utf-8") as file:
        families = json.load(file)
    with open(growth, encoding="utf-8") as file:
        points = json.load(file)
    with open(document, encoding="utf-8") as file:
        text = file.read()
    kept = [row for family in families for row in rows(family)]
    keep(kept, kept_file)
    text = write(text, "measured", [*circumstances(families), *table(kept)], document)
    if {*STRICT, WALK, *HARD} <= {family["family"] for family in families}:
        text = write(text, "goals", goals(families, points), document)
        print("docs/results.md:\n" + results_line(families))
    with open(document, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
