#!/usr/bin/env python3
"""Holds `surefoot solve --certify` against exact fractions: random small hierarchies of families that
are hard to tell from rounding (docs/solver.md, "What the certificate says").

    tools/exact_fractions.py --program build/release/bin/surefoot --problems 500

An answer is right where the residual of every level is within 1e-6 (1 + residual) of the exact one.
The exact optimum of a level is found by trying which of its limits are violated and which
constraints of the levels above hold, until the optimality conditions are met.
"""

import argparse
import itertools
import json
import math
import random
import subprocess
from fractions import Fraction


def eliminate(rows, columns):
    """Reduced row echelon form of `rows`, in their first `columns`, and the pivots' columns."""
    rows, pivots = [row[:] for row in rows], []
    for column in range(columns):
        at = len(pivots)
        found = next((i for i in range(at, len(rows)) if rows[i][column] != 0), None)
        if found is None:
            continue
        rows[at], rows[found] = rows[found], rows[at]
        rows[at] = [number / rows[at][column] for number in rows[at]]
        for i, row in enumerate(rows):
            if i != at and row[column] != 0:
                rows[i] = [a - row[column] * b for a, b in zip(row, rows[at])]
        pivots.append(column)
    return rows, pivots


def solve_linear(rows, columns):
    """A solution of rows [A | b], or None."""
    rows, pivots = eliminate(rows, columns)
    if any(row[columns] != 0 for row in rows[len(pivots):]):
        return None
    x = [Fraction(0)] * columns
    for row, pivot in zip(rows, pivots):
        x[pivot] = row[columns]
    return x


def dot(a, b):
    return sum((p * q for p, q in zip(a, b)), Fraction(0))


def least_squares(wanted, fixed, n):
    """(x, multipliers of `fixed`) of min Σ (a x − b)² over the wanted, with a x = b for the fixed."""
    size = n + len(fixed)
    system = []
    for j in range(n):
        row = [dot((a[j] for a, _ in wanted), (a[i] for a, _ in wanted)) for i in range(n)]
        row += [a[j] for a, _ in fixed]
        system.append(row + [dot((a[j] for a, _ in wanted), (b for _, b in wanted))])
    for a, b in fixed:
        system.append(a + [Fraction(0)] * len(fixed) + [b])
    solution = solve_linear(system, size)
    return None if solution is None else (solution[:n], solution[n:])


def independent(rows, n):
    return len(eliminate([a for a, _ in rows], n)[1]) == len(rows)


def optimum_of_level(level, equal, at_most, n):
    """An exact optimum of one level [(a, lower, upper)] over equal [(a, b)], at_most [(a, b)]."""
    sides = []
    for _, lower, upper in level:
        if lower == upper:
            sides.append([lower])
        else:
            sides.append([None] + [bound for bound in (lower, upper) if bound is not None])
    _, pivots = eliminate([a for a, _ in equal], n) if equal else (None, [])
    freedom = n - len(pivots)
    for count in range(freedom + 1):
        for chosen in itertools.combinations(at_most, min(count, len(at_most))):
            if len(chosen) < count or not independent(list(chosen), n):
                continue
            for aims in itertools.product(*sides):
                wanted = [(row[0], aim) for row, aim in zip(level, aims) if aim is not None]
                found = least_squares(wanted, equal + list(chosen), n)
                if found is None or any(mu < 0 for mu in found[1][len(equal):]):
                    continue
                if any(dot(a, found[0]) > b for a, b in at_most):
                    continue
                if all(is_as_aimed(row, aim, found[0]) for row, aim in zip(level, aims)):
                    return found[0]
    raise AssertionError("every level has an optimum")


def is_as_aimed(row, aim, x):
    a, lower, upper = row
    value = dot(a, x)
    if lower is not None and lower == upper:
        return True
    if aim is None:
        return (lower is None or value >= lower) and (upper is None or value <= upper)
    return value <= lower if aim == lower else value >= upper


def exact_residuals(levels, n):
    equal, at_most, residuals = [], [], []
    for level in levels:
        x = optimum_of_level(level, equal, at_most, n)
        square = Fraction(0)
        for a, lower, upper in level:
            value = dot(a, x)
            beyond = value - upper if upper is not None and value > upper else Fraction(0)
            beyond = value - lower if lower is not None and value < lower else beyond
            square += beyond * beyond
            if beyond != 0 or lower == upper:
                equal = equal + [(a, value)]
                continue
            if upper is not None:
                at_most = at_most + [(a, upper)]
            if lower is not None:
                at_most = at_most + [([-number for number in a], -lower)]
        equal = independent_part(equal, n)
        residuals.append(math.sqrt(float(square)))
    return residuals


def independent_part(rows, n):
    part = []
    for row in rows:
        if independent(part + [row], n):
            part.append(row)
    return part


def integer_problem(rng):
    """Levels of [a, lower, upper] with small integers; None where there is no bound."""
    n = rng.randint(1, 4)
    levels = []
    for _ in range(rng.randint(1, 3)):
        level = []
        for _ in range(rng.randint(1, 3)):
            a = [Fraction(rng.randint(-3, 3)) for _ in range(n)]
            if not any(a):
                a[rng.randrange(n)] = Fraction(1)
            above = [row[0] for row in itertools.chain(*levels, level)]
            if above and rng.random() < 0.3:  # parallel to one that there is
                factor, row = rng.choice((-2, -1, 1, 2)), rng.choice(above)
                a = [factor * number for number in row]
            lower = Fraction(rng.randint(-4, 4))
            kind = rng.random()
            upper = lower if kind < 0.5 else lower + rng.randint(1, 3)
            if kind >= 0.8:
                lower, upper = (None, upper) if kind < 0.9 else (lower, None)
            level.append([a, lower, upper])
        levels.append(level)
    return n, levels


def power(rng, most):
    return Fraction(2) ** rng.randint(-most, most)


def scale_columns(rng, n, levels, share=1.0):
    units = [power(rng, 20) for _ in range(n)]
    for level in levels:
        is_in_units = rng.random() < share
        for row in level if is_in_units else []:
            row[0] = [a * unit for a, unit in zip(row[0], units)]


def shrink_last_column(rng, n, levels):
    factor = Fraction(2) ** -rng.randint(13, 46)
    for row in levels[0]:
        row[0][-1] *= factor


def scale_rows(least, most):
    def change(rng, n, levels):
        for row in itertools.chain(*levels):
            factor = Fraction(2) ** rng.randint(least, most)
            row[0] = [factor * a for a in row[0]]
            row[1:] = [None if bound is None else factor * bound for bound in row[1:]]

    return change


def add_small(exponent):
    def change(rng, n, levels):
        small = Fraction(2) ** exponent
        for row in itertools.chain(*levels):
            row[0] = [a + rng.choice((0, small, -small)) for a in row[0]]

    return change


def every_third_row(exponent):
    def change(rng, n, levels):
        for i, row in enumerate(itertools.chain(*levels)):
            if i % 3 == 2:
                row[0] = [a + rng.randint(-9, 9) * Fraction(2) ** exponent for a in row[0]]

    return change


def straight_leg(rng, n, levels):
    """Rows twice, of the first level's rows a direction of 2^-14 to 2^-26."""
    factor = Fraction(2) ** -rng.randint(14, 26)
    for row in levels[0]:
        row[0][-1] *= factor
    for level in levels:
        for row in rng.sample(level, rng.randint(0, len(level))):
            level.append([row[0][:], *row[1:]])


FAMILIES = {
    "plain": lambda rng, n, levels: None,
    "columns times 2^±20": scale_columns,
    "columns of some levels times 2^±20": lambda rng, n, levels: scale_columns(rng, n, levels, 0.7),
    "first level's last column times 2^-13 to 2^-46": shrink_last_column,
    "rows times 2^±20": scale_rows(-20, 20),
    **{f"rows times 1 to 2^{most}": scale_rows(0, most) for most in (13, 17, 20, 23)},
    "+ 0 or ±2^-17 in each element": add_small(-17),
    "+ 0 or ±2^-20 in each element": add_small(-20),
    "+ 0 or ±2^-24 in each element": add_small(-24),
    "straight legs": straight_leg,
    "every third row + k / 2^20": every_third_row(-20),
    "every third row + k / 2^23": every_third_row(-23),
}


def as_json(levels):
    result = []
    for level in levels:
        rows = [row for row in level if any(row[0])]
        equalities = [row for row in rows if row[1] == row[2]]
        limits = [row for row in rows if row[1] != row[2]]
        result.append({
            "A": [[float(a) for a in row[0]] for row in equalities],
            "b": [float(row[1]) for row in equalities],
            "D": [[float(a) for a in row[0]] for row in limits],
            "lower": [None if row[1] is None else float(row[1]) for row in limits],
            "f": [None if row[2] is None else float(row[2]) for row in limits],
        })
    return json.dumps({"levels": result})


def answers(program, method, lines):
    command = [program, "solve", "-", "--certify", "--method", method]
    done = subprocess.run(command, input="\n".join(lines), capture_output=True, text=True)
    return {answer["line"]: answer for answer in map(json.loads, done.stdout.splitlines())}


def verdict_of(answer):
    verdicts = [level.get("verdict", "not proven") for level in answer["levels"]]
    order = ["proven", "not judged", "not proven"]
    return max(verdicts, key=order.index)


def is_right(answer, exact):
    pairs = zip([level.get("residual", math.inf) for level in answer["levels"]], exact)
    return all(abs(found - right) <= 1e-6 * (1 + right) for found, right in pairs)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="bin/surefoot")
    parser.add_argument("--method", default="lexicographic")
    parser.add_argument("--problems", type=int, default=200, help="of each family")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--family", choices=list(FAMILIES), action="append")
    parser.add_argument("--wrong", help="write the problems that are wrong and proven to this file")
    arguments = parser.parse_args()
    wrong = open(arguments.wrong, "w") if arguments.wrong else None
    print("| family | problems | wrong, proven | wrong, told | right, not judged | right, not proven "
          "| borderline | wrong, not borderline |")
    print("|---|---|---|---|---|---|---|---|")
    for family in arguments.family or FAMILIES:
        rng = random.Random(f"{arguments.seed} {family}")
        problems = []
        for _ in range(arguments.problems):
            n, levels = integer_problem(rng)
            FAMILIES[family](rng, n, levels)
            levels = [[row for row in level if any(row[0])] for level in levels]
            problems.append((n, [level for level in levels if level]))
        problems = [problem for problem in problems if problem[1]]
        found = answers(arguments.program, arguments.method, [as_json(levels) for _, levels in problems])
        counts = {"wrong, proven": 0, "wrong, told": 0, "right, not judged": 0, "right, not proven": 0,
                  "borderline": 0, "wrong, not borderline": 0}
        for i, (n, levels) in enumerate(problems):
            answer, exact = found[i + 1], exact_residuals(levels, n)
            verdict, right = verdict_of(answer), is_right(answer, exact)
            is_borderline = answer.get("borderline", False)
            counts["borderline"] += is_borderline
            counts["wrong, not borderline"] += not right and not is_borderline
            if not right:
                counts["wrong, proven" if verdict == "proven" else "wrong, told"] += 1
                if wrong and verdict == "proven":
                    wrong.write(as_json(levels) + "\n")
            elif verdict != "proven":
                counts["right, " + verdict] += 1
        print(f"| {family} | {len(problems)} | " + " | ".join(map(str, counts.values())) + " |", flush=True)


if __name__ == "__main__":
    main()
