"""Prints the headers that are installed, separated by semicolons: surefoot/*.hpp, which users include, and all that these reach."""

import pathlib
import re

root = pathlib.Path(__file__).resolve().parent.parent


def installed_headers():
    """Paths from the root, in order."""
    waiting = [path.relative_to(root).as_posix() for path in root.glob("surefoot/*.hpp")]
    reached = set()
    while waiting:
        header = waiting.pop()
        if header not in reached:
            reached.add(header)
            waiting += re.findall(r'^#include "(surefoot/.+)"', (root / header).read_text(), re.MULTILINE)
    return sorted(reached)


if __name__ == "__main__":
    print(*installed_headers(), sep=";", end="")
