"""The report's numbers: what is asked, what came out, and what each is measured on."""

import json
import re

import pytest
from log_file import attachment
from program import of_json

from surefoot_campaign.text import escape  # isort: skip

from surefoot_report import numbers, words  # isort: skip
from surefoot_report.outcome import read_outcome  # isort: skip


def cells(table):
    """By quantity the other cells of its row."""
    rows = re.findall(r"<tr[^>]*>((?:<td.*?</td>)+)</tr>", table.split("</table>")[0])
    return {row[0]: row[1:] for row in (re.findall(r"<td[^>]*>(.*?)</td>", row) for row in rows)}


def test_every_criterion_and_every_figure_of_the_paper_is_in_the_table():
    summary = {"metrics": {"goal_reached": False, "fell": False, "tick_us": {"p99": 12.0}, "odd": 2.5, "path_deviation_max_m": 0.007},
               "criteria": [{"metric": "goal_reached", "equals": True, "passed": False}, {"metric": "fell", "equals": False, "passed": True},
                            {"metric": "tick_us.p99", "max": 10.0, "passed": False}, {"metric": "odd", "min": 1.0, "passed": True},
                            {"metric": "path_deviation_max_m", "max": 0.1, "passed": None}]}  # fmt: skip
    outcome = read_outcome(json.dumps(summary), {"paper": {"goal_reached": "14 cm", "torso_contacts": "none", "speed_mps": 12, "fell": None}})
    found = {name: [row[0], row[1], *row[3:]] for name, row in cells(numbers.numbers(outcome)).items()}
    assert found["goal_reached"] == ["no", "", "yes  ✗ missed", "14 cm"] and found["fell"] == ["no", "", "no  ✓ holds", ""]
    assert found["tick_us.p99"] == ["12 µs", "↓", "≤ 10 µs  ✗ missed", ""]
    assert found["odd"] == ["2.5", "", "≥ 1  ✓ holds", ""] and found["torso_contacts"] == ["–", "↓", "", "none"]
    assert found["path_deviation_max_m"][::2] == ["7 mm", "≤ 100 mm  (not judged)"] and found["speed_mps"] == ["–", "↑", "", "12"]


def test_the_report_tells_what_the_program_tells_under_the_same_names(log):
    outcome = read_outcome(attachment(log, "summary.json").decode(), {})
    shown = numbers.numbers(outcome)
    listed = of_json("list", "metrics")
    first = [name for name, one in listed.items() if one["first"]]
    table, others = shown.split("<details>")
    assert {name.split(".")[0] for name in cells(table)} >= set(first)
    told = cells(table) | cells(others)
    assert {name.split(".")[0] for name in told} == listed.keys() - numbers.IN_TITLE
    assert all(told[name][2] == escape(one["help"]) for name, one in listed.items() if name in told)


@pytest.mark.parametrize("summary", ["", "{}", "no", "[]", '{"metrics":{},"criteria":{"fell":true}}', '{"metrics":{"reason":null},"criteria":[]}',
                                     '{"metrics":[],"criteria":[]}', '{"metrics":{"reason":"fell"},"criteria":[{"metric":"fell","passed":"no"}]}'])  # fmt: skip
def test_a_summary_of_another_shape_is_none(summary):
    outcome = read_outcome(summary, {"criteria": {"fell": False}, "goal": {"feet_beyond_x": 1}})
    assert not outcome.known and not outcome.metrics and not outcome.reason and len(outcome.criteria) == 1 and outcome.goal


def test_options_of_another_shape_are_none():
    assert read_outcome('{"metrics":{},"criteria":[]}', {"goal": []}).known
    for options in (None, [], {"goal": {"feet_beyond_x": "far"}, "criteria": [], "paper": 3}):
        outcome = read_outcome("", options)
        assert (outcome.goal, outcome.criteria, outcome.paper) == ("", [], {})


def test_numbers_are_written_for_people():
    assert [words.decimal(value, 2) for value in (0.5, -1.0, -0.001, 100, None, float("nan"))] == ["0.5", "−1", "0", "100", "–", "–"]
    assert [words.two_digits(value) for value in (42.4, 0.421, 0.00013, 0, 268)] == ["42", "0.42", "1.3·10⁻⁴", "0", "268"]
