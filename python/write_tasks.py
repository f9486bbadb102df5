"""Writes surefoot/tasks.py: a class for each task of the catalog. CMake calls it with the package's folder on PYTHONPATH."""

import sys
import textwrap

import _core  # alone: the package itself needs the file that this writes

HEAD = '''"""The tasks of a stack. Each takes the name of its level first, by default its own, or its frame; what is None keeps its default."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from surefoot._arguments import checked
from surefoot.task import Task, name_of

__all__ = {names}


def __dir__() -> list[str]:
    return sorted(__all__)
'''


def class_name(name):
    return "".join(word.capitalize() for word in name.split("_"))


def shown(value, unit):
    return f"{value:g}" + ("" if unit in ("", "–") else f" {unit}")


def described(task):
    equation = "" if task["equation"] == "–" else f" ({'Eq. ' if task['equation'][0] == '(' else ''}{task['equation']})"
    yield f"{task['summary'][0].upper()}{task['summary'][1:]}{equation}; rows in {task['unit']}."
    lines = [f"{one['name']}: {one['help']}; {shown(one['default'], one['unit'])} by default, on a robot of ANYmal B's size" for one in task["numbers"]]
    lines += [f"{one['name']}: {one['help']}" + f"; {one['default']} by default" * bool(one["default"]) for one in task["choices"]]
    if lines:
        yield ""
        yield from lines


def kind_of(choice):
    """In Python's types: what else than its values a choice may be is a name, or a list of them."""
    values = f"Literal[{', '.join(repr(value) for value in choice['values'])}]"
    return "str | Sequence[str]" if choice["others"] else values


def written(task):
    frame = [one for one in task["choices"] if one["name"] == "frame"]
    choices = [one for one in task["choices"] if one not in frame]
    arguments = [f"{one['name']}: float | None = None" for one in task["numbers"]]
    arguments += [f"{one['name']}: {kind_of(one)} | None = None" for one in choices]
    given = "".join(f", {one['name']}={one['name']}" for one in frame + task["numbers"] + choices)
    doc = "\n".join(line for text in described(task) for line in (textwrap.wrap(text, 130, subsequent_indent="    ") or [""]))
    # What a task is about comes first, and names its level.
    first = ["frame: str | None = None", "name: str | None = None"] if frame else [f"name: str = {task['name']!r}"]
    name = f"name or name_of({task['name']!r}, frame)" if frame else "name"
    signature = ", ".join(["self", *first, "*", *arguments, "weight: float = 1.0"])
    return f'''

@checked
class {class_name(task["name"])}(Task):
    """{textwrap.indent(doc, "    ").strip()}"""

    def __init__({signature}) -> None:
        super().__init__({task["name"]!r}, {name}, weight=weight{given})
'''


if __name__ == "__main__":
    tasks = _core.catalog()
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(HEAD.format(names=[class_name(task["name"]) for task in tasks]) + "".join(map(written, tasks)))
