"""`surefoot solve` as its user calls it. What a line may hold tests/cli and tests/config try."""

import json

import pytest
from program import surefoot

GOOD = '{"levels":[{"A":[[1]],"b":[3]}]}'


@pytest.mark.parametrize("levels, message", [([{"A": [[1] * 501], "b": [1]}], "has 501 unknowns; expected at most 500"),
                                             ([{"A": [[1]], "b": [1]}, {"A": [[1]] * 6000, "b": [1] * 6000}],
                                              "level 2: row 5000 is one too many; expected at most 500 unknowns and 5000 rows")])  # fmt: skip
def test_a_line_that_is_too_large_is_named_and_the_lines_around_it_are_solved(levels, message, tmp_path):
    line = json.dumps({"levels": levels})
    (tmp_path / "lines.jsonl").write_text(f"{GOOD}\n\n{line}\n{GOOD}\n")
    done = surefoot("solve", "lines.jsonl", cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr.startswith("lines.jsonl:3: ") and message in done.stderr and len(done.stderr.splitlines()) == 1
    assert [json.loads(answer)["x"] for answer in done.stdout.splitlines()] == [[3.0], [3.0]]


def test_standard_input_without_a_line_is_wrong_input():
    done = surefoot("solve", "-", input="\n\n")
    assert done.returncode == 2 and "standard input: is empty" in done.stderr


def test_help_says_which_numbers_are_accepted():
    words = surefoot("solve", "--help").stdout
    assert "from -1e100 to 1e100" in words and "at least 1e-100" in words
