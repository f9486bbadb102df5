"""`surefoot solve` as its user calls it, and the same from Python. What a line may hold tests/cli and tests/config try."""

import json
import subprocess

import pytest
from program import PROGRAM

GOOD = '{"levels":[{"A":[[1]],"b":[3]}]}'


def solve(*arguments, **options):
    return subprocess.run([PROGRAM, "solve", *arguments], capture_output=True, text=True, **options)


@pytest.mark.parametrize("line, message", [("levels: 3", "is not JSON"), ("[" * 100000, "is nested deeper than 64"),
                                           ('{"levels":[{},{"A":[[1,2],[NaN,1]],"b":[1,2]}]}', 'level 2: A: row 2: element 1 is "NaN"'),
                                           (json.dumps({"levels": [{"A": [[1] * 501], "b": [1]}]}), "has 501 unknowns; expected at most 500"),
                                           (json.dumps({"levels": [{"A": [[1]], "b": [1]}, {"A": [[1]] * 6000, "b": [1] * 6000}]}),
                                            "level 2: row 5000 is one too many; expected at most 500 unknowns and 5000 rows")])  # fmt: skip
def test_a_bad_line_is_named_and_the_lines_around_it_are_solved(line, message, tmp_path):
    (tmp_path / "lines.jsonl").write_text(f"{GOOD}\n\n{line}\n{GOOD}\n")
    done = solve("lines.jsonl", cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr.startswith("lines.jsonl:3: ") and message in done.stderr and len(done.stderr.splitlines()) == 1
    assert [json.loads(answer)["x"] for answer in done.stdout.splitlines()] == [[3.0], [3.0]]


def test_standard_input_without_a_line_is_wrong_input():
    done = solve("-", input="\n\n")
    assert done.returncode == 2 and "standard input: is empty" in done.stderr


def test_help_says_which_numbers_are_accepted():
    words = solve("--help").stdout
    assert "from -1e100 to 1e100" in words and "at least 1e-100" in words


@pytest.mark.parametrize("method", ["lexicographic", "cascade"])
def test_python_solves_by_either_method(method):
    surefoot = pytest.importorskip("surefoot")
    levels = [{"D": [[1.0]], "f": [1.0]}, {"A": [[1.0]], "b": [3.0]}]
    assert surefoot.solve(levels, method=method).x[0] == pytest.approx(1.0)
    with pytest.raises(surefoot.Error, match="beyond the range of doubles"):
        surefoot.solve([{"A": [[1e-100]], "b": [1e100]}], method=method)


def test_python_says_what_is_wrong_with_a_method_or_a_budget():
    surefoot = pytest.importorskip("surefoot")
    levels = [{"A": [[1.0, 1.0]], "b": [2.0]}, {"D": [[1.0, 0.0]], "f": [-3.0]}]
    assert surefoot.solve(levels, budget=0).status == "iteration_cap"
    with pytest.raises(surefoot.Error, match="there are: lexicographic, cascade"):
        surefoot.solve(levels, method="simplex")
    with pytest.raises(surefoot.Error, match="the cascade has no budget"):
        surefoot.solve(levels, method="cascade", budget=1e3)
