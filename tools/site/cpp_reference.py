"""The reference of the C++ library, from its public headers: declarations, and the comments that stand at them."""

import posixpath
import re

import prose
from cpp_declarations import read

INCLUDE = re.compile(r'^#include "(surefoot/.+)"', re.MULTILINE)
HEAD = """# C++ reference

Generated from the headers. [Surefoot from C++](../../cpp.md) is the introduction.

| `#include` | what it gives |
|---|---|
"""


def pages(root):
    """A page for each header that users include, and one a folder for what these reach."""
    public = sorted((root / "surefoot").glob("*.hpp"))
    own = {path.stem: directly_included(path) for path in public}
    described = {header for headers in own.values() for header in headers}
    below = sorted(reached(root, public) - described - {f"surefoot/{path.name}" for path in public})
    made = {f"reference/cpp/{path.stem}.md": page(root, f"surefoot/{path.name}", introduction(path), own[path.stem]) for path in public}
    folders = sorted({posixpath.dirname(header) for header in below})
    for folder in folders:
        headers = [header for header in below if posixpath.dirname(header) == folder]
        made[f"reference/cpp/{folder.replace('/', '_')}.md"] = page(root, f"{folder}/", "What the headers that users include need of this folder.", headers)
    rows = [f"| [`surefoot/{path.name}`]({path.stem}.md) | {introduction(path)} |" for path in public]
    rest = [f"[{folder}]({folder.replace('/', '_')}.md)" for folder in folders]
    made["reference/cpp/index.md"] = HEAD + "\n".join(rows) + f"\n\nBelow them: {', '.join(rest)}.\n\n## All names\n\n{names_of(made)}\n"
    return made


def names_of(made):
    """Links to all types and functions."""
    found = {(name, posixpath.basename(site)) for site, text in made.items() for name in re.findall(r"^### (\w+)$", text, re.MULTILINE)}
    return " · ".join(f"[{name}]({file}#{name.lower()})" for name, file in sorted(found, key=lambda entry: (entry[0].lower(), entry)))


def directly_included(path):
    return INCLUDE.findall(path.read_text())


def reached(root, public):
    waiting, seen = [header for path in public for header in directly_included(path)], set()
    while waiting:
        header = waiting.pop()
        if header not in seen:
            seen.add(header)
            waiting += directly_included(root / header)
    return seen


def introduction(path):
    """The comment at the head of a header."""
    lines = re.findall(r"^// (.*)$", path.read_text(), re.MULTILINE)
    return " ".join(lines)


def page(root, title, about, headers):
    parts = [f"# {title}\n", about + "\n"]
    for header in headers:
        entries = read((root / header).read_text())
        if entries:
            parts += [f"\n## {header}\n", *(described(entry, 3) for entry in entries)]
    return "\n".join(parts)


def code(declaration):
    return f"```cpp\n{declaration}\n```\n"


def described(entry, depth):
    if not entry.name and "(" not in entry.declaration.partition("=")[0]:
        return f"- `{' '.join(entry.declaration.split())}` {prose.inline(entry.about)}"
    about = prose.to_html(entry.about) + "\n" if entry.about else ""
    if not entry.name:
        return f"{code(entry.declaration)}\n{about}"
    members = "\n".join(described(member, depth + 1) for member in entry.members)
    return f"{'#' * depth} {entry.name}\n\n{code(entry.declaration)}\n{about}\n{members}"
