"""`surefoot solve` on lines that are wrong, empty or without rows."""

import json
import subprocess

import pytest

from program import PROGRAM

GOOD = '{"levels":[{"A":[[1]],"b":[3]}]}'


@pytest.mark.parametrize(
    "line, message",
    [
        ("levels: 3", "is not JSON"),
        ("\x00\x01", "is not JSON"),
        ("[" * 100000, "is nested deeper than 64"),
        ("[]", 'has no array "levels"'),
        ('{"levels":[]}', "levels is empty, so there are no unknowns"),
        ('{"levels":[{},{"A":[],"b":[]}]}', "levels 1 to 2: have no row in A or D, so there are no unknowns"),
        ('{"levels":[{"A":[[1]],"b":[1]},{"A":[[1],[1,2]],"b":[1,2]}]}', "level 2: A: row 2: has 2 elements"),
        ('{"levels":[{"A":[[1]],"b":[1]},{"D":[[1]],"f":[1,2]}]}', "level 2: f has 2 elements, D has 1 row"),
        ('{"levels":[{},{"A":[[1,2],[NaN,1]],"b":[1,2]}]}', 'level 2: A: row 2: element 1 is "NaN"'),
        ('{"levels":[{"D":[[1]],"f":[-Infinity]}]}', 'level 1: f: element 1 is "-Infinity"; expected a finite number, or null'),
        ('{"levels":[{"A":[[1]],"lower":[0],"upper":[1]}]}', "level 1: rows with bounds are those of D, lower ≤ D x ≤ f"),
        ('{"levels":[{"A":[[1e999]],"b":[1]}]}', 'level 1: A: row 1: element 1 is 1e999, too large'),
        ('{"levels":[{"D":[[1]],"lowr":[0],"f":[1]}]}', 'level 1: unknown key "lowr"; did you mean "lower"? valid are: '),
        ('{"levels":[{"A":[[1]],"b":[1],"b":[2]}]}', 'level 1: the key "b" is given twice'),
        ('{"levels":[{"A":[[1e-300]],"b":[1]}]}', "level 1: A: row 1: has nothing larger than 1e-300"),
        ('{"levels":[{"A":[[1e200]],"b":[1]}]}', "level 1: A: row 1: element 1 is 1e+200, too large"),
        (json.dumps({"levels": [{"A": [[1] * 501], "b": [1]}]}), "has 501 unknowns; expected at most 500"),
        (
            json.dumps({"levels": [{"A": [[1]], "b": [1]}, {"A": [[1]] * 6000, "b": [1] * 6000}]}),
            "level 2: row 5000 is one too many; expected at most 500 unknowns and 5000 rows",
        ),
    ],
)
def test_a_bad_line_is_named_and_the_lines_around_it_are_solved(line, message, tmp_path):
    (tmp_path / "lines.jsonl").write_text(f"{GOOD}\n\n{line}\n{GOOD}\n")
    done = subprocess.run([PROGRAM, "solve", "lines.jsonl"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 2
    assert done.stderr.startswith("lines.jsonl:3: ") and message in done.stderr
    assert len(done.stderr.splitlines()) == 1
    assert [json.loads(answer)["x"] for answer in done.stdout.splitlines()] == [[3.0], [3.0]]


@pytest.mark.parametrize("text", ["", "\n\n"])
def test_a_file_without_a_line_is_wrong_input(text, tmp_path):
    (tmp_path / "lines.jsonl").write_text(text)
    done = subprocess.run([PROGRAM, "solve", "lines.jsonl"], cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "")
    assert "lines.jsonl: is empty; expected a file with one JSON object a line" in done.stderr
    done = subprocess.run([PROGRAM, "solve", "-"], input=text, capture_output=True, text=True)
    assert done.returncode == 2 and "standard input: is empty" in done.stderr


def test_help_says_which_numbers_are_accepted(tmp_path):
    words = subprocess.run([PROGRAM, "solve", "--help"], capture_output=True, text=True).stdout
    assert "from -1e100 to 1e100" in words and "at least 1e-100" in words
    numbers = {"1e100": 0, "-1e100": 0, "1.01e100": 2, "-1.01e100": 2, "1e-100": 0, "-1e-100": 0, "9e-101": 2, "0": 0}
    for number, code in numbers.items():
        (tmp_path / "line.jsonl").write_text('{"levels":[{"A":[[%s]],"b":[0]}]}' % number)
        done = subprocess.run([PROGRAM, "solve", "line.jsonl"], cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == code, number


def test_a_level_without_rows_is_met_by_any_x(tmp_path):
    (tmp_path / "lines.jsonl").write_text('{"levels":[{"A":[],"b":[]},{"A":[[2]],"b":[4]},{}]}\n')
    done = subprocess.run([PROGRAM, "solve", "--certify", "lines.jsonl"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0
    assert [level["residual"] for level in json.loads(done.stdout)["levels"]] == [0, 0, 0]


def test_a_budget_ends_the_search_of_the_controllers_solver_only(tmp_path):
    (tmp_path / "lines.jsonl").write_text('{"levels":[{"A":[[1,1]],"b":[2]},{"D":[[1,0]],"f":[-3]}]}\n')
    solve = [PROGRAM, "solve", "lines.jsonl", "--budget", "0"]
    done = subprocess.run(solve, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0
    assert json.loads(done.stdout)["status"] == "iteration_cap"
    done = subprocess.run([*solve, "--method", "cascade"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 2
    assert "the cascade has no budget" in done.stderr


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
