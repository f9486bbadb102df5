"""Writes surefoot/tasks.py: a class for each task of the catalog. CMake calls it with the package's folder on PYTHONPATH."""

import sys
import textwrap

import _core  # alone: the package itself needs the file that this writes

HEAD = '''"""The tasks of a stack. Each takes the name of its level first, by default its own; what is None keeps its default."""

from typing import Literal

from surefoot.stack import Task

__all__ = {names}
'''


def class_name(name):
    return "".join(word.capitalize() for word in name.split("_"))


def shown(value, unit):
    return f"{value:g}" + ("" if unit in ("", "–") else f" {unit}")


def described(task):
    equation = "" if task["equation"] == "–" else f" ({'Eq. ' if task['equation'][0] == '(' else ''}{task['equation']})"
    yield f"{task['summary'][0].upper()}{task['summary'][1:]}{equation}; rows in {task['unit']}."
    lines = [f"{one['name']}: {one['help']}; {shown(one['default'], one['unit'])} by default, on a robot of ANYmal B's size" for one in task["numbers"]]
    lines += [f"{one['name']}: {one['help']}; {one['default']} by default" for one in task["choices"]]
    if lines:
        yield ""
        yield from lines


def written(task):
    arguments = [f"{one['name']}: float | None = None" for one in task["numbers"]]
    arguments += [f"{one['name']}: Literal[{', '.join(repr(value) for value in one['values'])}] | None = None" for one in task["choices"]]
    given = "".join(f", {one['name']}={one['name']}" for one in task["numbers"] + task["choices"])
    doc = "\n".join(line for text in described(task) for line in (textwrap.wrap(text, 130, subsequent_indent="    ") or [""]))
    signature = ", ".join(["self", f"name: str = {task['name']!r}", "*", *arguments, "weight: float = 1.0"])
    return f'''

class {class_name(task["name"])}(Task):
    """{textwrap.indent(doc, "    ").strip()}"""

    def __init__({signature}) -> None:
        super().__init__({task["name"]!r}, name, weight=weight{given})
'''


if __name__ == "__main__":
    tasks = _core.catalog()
    with open(sys.argv[1], "w") as file:
        file.write(HEAD.format(names=[class_name(task["name"]) for task in tasks]) + "".join(map(written, tasks)))
