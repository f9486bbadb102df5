"""Benchmarks are run by hand, so nothing else tells when what they use is gone."""

import ast
import pathlib

from browser import Browser

BENCHMARKS = pathlib.Path(__file__).resolve().parents[2] / "benchmarks"


def asked_of(name, source):
    """What a program asks of the object that it calls so."""
    return {node.attr for node in ast.walk(ast.parse(source))
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == name}


def test_a_browser_can_all_that_benchmarks_ask_of_it():
    asked = asked_of("browser", (BENCHMARKS / "viewer_page.py").read_text())
    assert "run" in asked
    assert {one for one in asked if not hasattr(Browser, one)} == set()
