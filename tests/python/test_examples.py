"""The examples and notebooks in Python, run as their readers do."""

import json
import subprocess
import sys

import pytest

from program import ROOT

EXAMPLES = sorted((ROOT / "examples").glob("[0-9]*.py"))
NOTEBOOKS = sorted((ROOT / "examples/notebooks").glob("*.ipynb"))
MOST_LINES = 60
# As a notebook shows the last expression of a cell.
RUNNER = """
import ast, json, sys
import matplotlib
matplotlib.use("Agg")
space = {"__name__": "__main__"}
for cell in json.load(open(sys.argv[1]))["cells"]:
    if cell["cell_type"] == "code":
        tree = ast.parse("".join(cell["source"]))
        last = ast.Expression(tree.body.pop().value) if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, sys.argv[1], "exec"), space)
        if last is not None:
            print(repr(eval(compile(last, sys.argv[1], "eval"), space)))
"""


def code_of(notebook):
    return [cell for cell in json.loads(notebook.read_text())["cells"] if cell["cell_type"] == "code"]


def run(folder, *words):
    done = subprocess.run([sys.executable, *map(str, words)], cwd=folder, capture_output=True, text=True, timeout=500)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs(example, tmp_path):
    assert run(tmp_path, "-W", "error::RuntimeWarning", example)
    assert example.read_text().startswith('"""')


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_cell_by_cell(notebook, tmp_path):
    assert "<" in run(tmp_path, "-c", RUNNER, notebook)


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_has_no_outputs(notebook):
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in code_of(notebook))


def test_each_example_is_short_and_in_both_languages():
    sources = [path for path in (ROOT / "examples").iterdir() if path.suffix in (".cpp", ".hpp", ".py")]
    assert {path.name: len(path.read_text().splitlines()) for path in sources if len(path.read_text().splitlines()) > MOST_LINES} == {}
    assert {path.stem for path in EXAMPLES} == {path.stem for path in sources if path.suffix == ".cpp"}


def test_there_are_ten_examples_and_three_notebooks():
    assert [path.stem[:2] for path in EXAMPLES] == [f"{number:02}" for number in range(1, 13)] and len(NOTEBOOKS) == 3
