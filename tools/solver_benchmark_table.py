"""The table of docs/benchmarks.md from `benchmark_solver --json FILE`; replaces what stands between its marks.

    tools/solver_benchmark_table.py build/solver.json docs/benchmarks.md
"""

import json
import math
import re
import sys

MARKS = ("<!-- measured: begin -->", "<!-- measured: end -->")


def number(value, digits):
    """Solvers that came back from no problem have no time."""
    return "–" if value is None or math.isnan(value) else f"{value:.{digits}f}"


def rows(family):
    ours = family["solvers"][0]["median_us"]
    title = (f"\n**{family['family']}**: {family['problems']} problems, "
             f"{family['active_rows']:.1f} active inequality rows\n")
    yield title
    yield "| solver | median Q | p99 Q | max Q | × ours | right % | within 1e-3 % | failed | hung | allocations |"
    yield "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
    for solver in family["solvers"]:
        times = [solver[key] for key in ("median_us", "p99_us", "max_us")]
        in_q = [number(None if t is None else t / family["q_us"], 2) for t in times]
        ratio = number(None if times[0] is None else times[0] / ours, 2)
        yield " | ".join([f"| {solver['solver']}", *in_q, ratio, f"{solver['right_percent']:.1f}",
                          f"{solver['near_percent']:.1f}", str(solver["failed"]), str(solver["hung"]),
                          f"{solver['allocations']:.0f} |"])


def main(results, document):
    with open(results, encoding="utf-8") as file:
        families = json.load(file)
    with open(document, encoding="utf-8") as file:
        text = file.read()
    table = "\n".join(line for family in families for line in rows(family))
    pattern = re.escape(MARKS[0]) + ".*" + re.escape(MARKS[1])
    if not re.search(pattern, text, re.DOTALL):
        sys.exit(f"{document} has no lines {MARKS[0]} and {MARKS[1]}")
    text = re.sub(pattern, lambda _: f"{MARKS[0]}\n{table}\n{MARKS[1]}", text, flags=re.DOTALL)
    with open(document, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
