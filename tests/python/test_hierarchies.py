"""Hierarchies solved from Python, once and tick after tick."""

import json
import math

import numpy as np
import pytest
import surefoot
from program import answer


def test_a_hierarchy_is_solved_in_every_form_of_its_rows():
    inequality = surefoot.solve([{"D": [[1.0, 0.0], [-1.0, 0.0]], "f": [1, 2]}, {"A": np.eye(2), "b": [5, 6]}])
    two_sided = surefoot.solve([{"D": [[1, 0]], "lower": [-2], "f": [1]}, {"A": np.eye(2, order="F"), "b": [5, 6]}])
    one_sided = surefoot.solve([{"D": [[-1, 0]], "lower": [-1]}, {"A": np.eye(2, dtype=int), "b": (5, 6)}])
    for solution in (inequality, two_sided, one_sided):
        np.testing.assert_allclose(solution.x, [1, 6], atol=1e-12)
        assert solution.status == "optimal"
        assert solution.levels[1].residual == pytest.approx(4)
        assert solution.levels[1].degrees_of_freedom_left == 0
    assert inequality.levels[0].active == [("D[0]", "at upper")]
    assert two_sided.levels[0].active == [("D[0]", "at upper")]
    assert [level.name for level in inequality.levels] == ["level 1", "level 2"]


def test_a_level_of_a_problem_file_is_one_of_python_too(tmp_path):
    level = {"name": "limits", "unit": "N", "D": [[1], [2], [1]], "f": [500, None, 9000], "lower": [None, 100, 3],
             "D_names": ["most", "least", "range"], "D_ids": [4, 7, 1], "A": [[1]], "b": [600], "A_names": ["wish"]}
    file = tmp_path / "hierarchy.jsonl"
    file.write_text(json.dumps({"levels": [level]}) + "\n")
    ours = surefoot.solve([level])
    assert ours.x.tolist() == json.loads(answer("solve", file))["x"] == [pytest.approx(550)]
    assert ours.levels[0].active == [("most", "above upper")]
    assert surefoot.solve([{"D": [[1]], "lower": [2]}]).x == [2]


@pytest.mark.parametrize("method", ["lexicographic", "cascade"])
def test_a_row_without_a_bound_asks_for_nothing(method):
    off = {"D": [[1, 0], [2, 1]], "lower": [None, -np.inf], "f": [None, np.inf]}
    goal = {"A": [[1, 0]], "b": [3]}
    solution = surefoot.solve([off, goal, {"D": [[1, 1]], "f": [None]}], method=method, certify=True)
    assert solution.verdict == "proven" and solution.x == pytest.approx([3, 0], abs=1e-12)
    assert [level.residual for level in solution.levels] == [0, pytest.approx(0, abs=1e-12), 0]
    assert not solution.levels[0].active
    damped = surefoot.solve([{**off, "damping": 1}, goal], method=method)
    assert damped.x[0] == pytest.approx(3), "nor is its direction damped"


def test_a_solution_prints_what_it_is():
    text = repr(surefoot.solve([{"D": [[1]], "f": [1]}, {"A": [[1]], "b": [3]}]))
    assert text.startswith("Solution('optimal', x=[1.], levels=[Level('level 1', residual=0, active=[('D[0]', 'at upper')])")


def test_empty_blocks_and_levels_are_allowed():
    solution = surefoot.solve([{"A": [], "b": [], "D": [], "f": []}, {}, {"A": [[2.0]], "b": [4], "D": [], "f": []}])
    assert solution.x == [2.0]
    assert [level.num_rows for level in solution.levels] == [0, 0, 1]


def test_of_a_search_that_ended_early_levels_that_were_not_reached_say_nothing():
    levels = [{"A": [[1, 1]], "b": [2]}, {"D": [[1, 0], [0, 1]], "f": [0.5, 0.3]},
              {"A": [[1, 0]], "b": [9]}, {"A": [[0, 1]], "b": [1]}]
    solution = surefoot.solve(levels, budget=0, certify=True)
    assert (solution.status, solution.failed_level, solution.verdict) == ("iteration_cap", 1, "not proven")
    assert [math.isnan(level.residual) for level in solution.levels] == [False, False, True, True]
    assert [level.verdict for level in solution.levels] == ["proven", None, None, None]
    assert all(not level.active and level.certificate is None for level in solution.levels[2:])
    whole = surefoot.solve(levels)
    assert (whole.status, whole.failed_level, whole.verdict, whole.levels[0].certificate) == ("optimal", None, None, None)


def test_an_answer_says_that_it_is_borderline():
    assert not surefoot.solve([{"A": [[1, 1]], "b": [2]}]).borderline
    assert surefoot.solve([{"A": [[1, 1], [1, 1 + 5e-11]], "b": [0, 1]}]).borderline


def test_an_answer_is_certified_where_that_is_asked_for():
    proven = surefoot.solve([{"A": [[1, 1]], "b": [2]}], certify=True)
    assert proven.verdict == "proven" and proven.levels[0].certificate <= 1e-12
    far = surefoot.solve([{"A": [[1, 1], [1, 1 + 1e-9]], "b": [0.1, 3.3]}], certify=True)  # x is 3e9
    assert far.verdict == far.levels[0].verdict == "not judged" and far.levels[0].rests_on is None
    below = surefoot.solve([{"A": [[1, 1], [1, 1 + 1e-9]], "b": [0.1, 3.3]}, {"A": [[0, 0]], "b": [0]}], certify=True)
    assert (below.levels[1].verdict, below.levels[1].rests_on) == ("not judged", 0)


def test_weights_damping_and_a_reference_are_those_of_the_level():
    level = {"A": [[1, 0], [1, 0]], "b": [0, 4], "A_weights": [1, 3], "damping": 2}
    solution = surefoot.solve([level], x_ref=np.array([1, 5]))
    x = 40 / 14  # where x² + (3 x − 12)² + 4 (x − 1)² is least
    np.testing.assert_allclose(solution.x, [x, 5], atol=1e-12)
    assert [level.name for level in solution.levels] == ["level 1", "x_ref"]
    assert [level.num_rows for level in solution.levels] == [4, 2]
    assert solution.levels[0].residual == pytest.approx(math.sqrt(x**2 + (3 * x - 12)**2 + 4 * (x - 1)**2))
    limited = surefoot.solve([{"D": [[1], [1]], "f": [0, 0], "A": [[-1]], "b": [-3], "D_weights": [2, 1]}])
    assert limited.x[0] == pytest.approx(0.5)  # where (x − 3)² + (2 x)² + x² is least


@pytest.mark.parametrize("extras", [{}, {"A_weights": [0.5, 3.0], "D_weights": [1.0, 2.0, 0.1], "damping": 0.1}])
@pytest.mark.parametrize("x_ref", [None, [1.0, -2.0, 3.0, 0.0, 0.5, 9.0]])
def test_solve_gives_what_the_program_gives(extras, x_ref, tmp_path):
    random = np.random.default_rng(5)
    levels = [{"A": random.normal(size=(2, 6)).tolist(), "b": random.normal(size=2).tolist(),
               "D": random.normal(size=(3, 6)).tolist(), "f": random.normal(size=3).tolist(), **extras} for _ in range(4)]
    file = tmp_path / "hierarchy.jsonl"
    file.write_text(json.dumps({"levels": levels} | ({"x_ref": x_ref} if x_ref else {})) + "\n")
    program, ours = json.loads(answer("solve", file)), surefoot.solve(levels, x_ref=x_ref)
    assert ours.x.tolist() == program["x"]
    assert [level.residual for level in ours.levels] == [level["residual"] for level in program["levels"]]


def test_a_warm_solver_gives_the_answers_of_a_cold_one_in_fewer_sweeps():
    random = np.random.default_rng(3)
    warm, sweeps = surefoot.HierarchicalSolver(), []
    A, D = random.normal(size=(4, 12)), random.normal(size=(20, 12))
    for tick in range(30):
        limits = {"name": "limits", "D": D, "f": np.full(20, 0.3), "D_weights": np.linspace(1, 2, 20)}
        goal = {"name": "goal", "A": A, "b": [np.sin(0.01 * tick + i) * 3 for i in range(4)], "A_weights": [1, 2, 3, 4], "damping": 1e-3}
        levels = [limits, goal, {"name": "small", "A": np.eye(12), "b": np.zeros(12)}]
        if tick == 20:
            levels.insert(1, {"name": "more", "A": random.normal(size=(1, 12)), "b": [0.1]})  # comes for a tick
        ours, theirs = warm.solve(levels, certify=True), surefoot.solve(levels)
        np.testing.assert_allclose(ours.x, theirs.x, atol=1e-9)
        assert ours.verdict == "proven" and [level.name for level in ours.levels] == [level["name"] for level in levels]
        sweeps.append(warm.num_sweeps)
    assert sweeps[0] > 1 and sum(each == 1 for each in sweeps) > 20, sweeps
    assert "goal" in str(ours.explain()) and ours.levels[0].active
    warm.forget()
    warm.solve(levels)
    assert warm.num_sweeps > 1 and repr(warm).startswith("<hierarchical solver, ")


def test_an_answer_does_not_change():
    solution = surefoot.solve([{"name": "wish", "A": [[1, 1]], "b": [2]}], x_ref=np.array([1.0, 0.0]))
    before = str(solution.explain())
    with pytest.raises(ValueError, match="read-only"):
        solution.x[0] = 100
    assert solution.x == pytest.approx([1.5, 0.5]) and str(solution.explain()) == before


def test_a_warm_solver_knows_rows_by_their_ids_wherever_they_are():
    D, f = np.vstack([np.eye(6), -np.eye(6)]), np.full(12, 0.5)
    wish = {"name": "wish", "A": np.eye(6), "b": [9, -9, 9, -9, 9, 0]}
    warm = surefoot.HierarchicalSolver()

    def sweeps(order, ids):
        warm.solve([{"name": "box", "D": D[order], "f": f[order], "D_ids": ids}, wish])
        return warm.num_sweeps

    straight, turned = list(range(12)), list(range(11, -1, -1))
    assert sweeps(straight, straight) > 1 and sweeps(straight, straight) == 1
    assert sweeps(turned, turned) == 1
    for solve in (surefoot.solve, warm.solve):
        for ids, said in [({"A_ids": [3, 3]}, "A_ids: element 2 is 3"), ({"A_ids": [1, 3], "D_ids": [3]}, "D_ids: element 1 is 3")]:
            with pytest.raises(surefoot.Error, match=f"level 1: {said}, which another row of the level has; expected one that none has"):
                solve([{"A": np.eye(2), "b": [1, 2], "D": [[1, 1]], "f": [2], **ids}])
    mixed = {"A": np.eye(2), "b": [1, 2], "D": [[1, 1]], "f": [2], "damping": 0.1}  # ids that places have, too
    assert warm.solve([mixed | {"A_ids": [2, 4]}]).x == pytest.approx(surefoot.solve([mixed]).x)
    with pytest.raises(surefoot.Error, match="D_ids has 2 elements, D has 12 rows"):
        warm.solve([{"D": D, "f": f, "D_ids": [1, 2]}])
    with pytest.raises(surefoot.Error, match="a budget is a number of flops"):
        surefoot.HierarchicalSolver(-1)
