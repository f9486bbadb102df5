"""The explanations that Python gives are the program's."""

import json

import pytest
import surefoot
from program import answer, of_json
from program import surefoot as program


@pytest.mark.parametrize("budget", [float("inf"), 0])
def test_a_solution_is_explained_as_the_program_does(budget, tmp_path):
    levels = [{"name": "limits", "D": [[1, 0], [0, 1]], "lower": [None, -1], "f": [1, 2], "D_names": ["x", "y"], "unit": "N"},
              {"name": "goal", "A": [[1, 1]], "b": [9], "A_names": ["sum"], "A_weights": [2], "unit": "m/s²"}]
    file = tmp_path / "hierarchy.jsonl"
    file.write_text(json.dumps({"levels": levels}) + "\n")
    ours = surefoot.solve(levels, budget=budget).explain()
    told = json.loads(program("solve", file, "--explain", "--json", *([] if budget else ["--budget", 0])).stdout)
    without_times = [{key: value for key, value in level.items() if key != "time_s"} for level in ours.facts["levels"]]
    assert without_times == [{key: value for key, value in level.items() if key != "time_s"} for level in told["levels"]]
    assert [ours.facts[key] for key in ("x", "status")] == [told[key] for key in ("x", "status")]
    assert str(ours) == ours.text and ours.text.startswith("status: ")
    if budget:
        assert "held back by 1 limits, which costs" in ours.text and "sum is 6 m/s² too low, weighted 2 times" in ours.text
    else:
        assert "status: iteration_cap, at its budget" in ours.text


def test_a_tick_of_a_log_is_explained_as_the_program_does(steps_down):
    estimated, ours = surefoot.explain(steps_down, 13.0, exact=False), surefoot.explain(steps_down, 13.0)
    for told, is_exact in ((estimated, False), (ours, True)):
        assert told.facts["time"] == 13.0 and told.facts["costs_are_exact"] is is_exact and len(told.facts["gave_way"]) > 1
        assert ("The costs are the control loop's estimates, and mostly too high." in told.text) is not is_exact
    assert ours.text == answer("explain", steps_down, "--at", 13)
    assert surefoot.explain(surefoot.read(steps_down), 13.0).text == ours.text
    assert ours.facts == of_json("explain", steps_down, "--at", 13)


def test_what_can_not_be_explained_is_an_error_that_says_why(log, tmp_path):
    with pytest.raises(surefoot.Error, match="no tick at 99 s; the log goes from 0 s to"):
        surefoot.explain(log, 99)
    with pytest.raises(surefoot.Error, match="time is nan"):
        surefoot.explain(log, float("nan"))
    with pytest.raises(surefoot.FileError, match="none.mcap"):
        surefoot.explain(tmp_path / "none.mcap", 1)
