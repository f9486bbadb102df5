"""Holds every #include of surefoot/, server/, cli/ and python/ against tools/layers.toml, its namespace against its folder, and finds types that
share a name and third-party includes of installed headers.

Two types of one name in one namespace break the one-definition rule: the linker takes either. Prints what it finds.
"""

import pathlib
import re
import sys
import tomllib

from installed_headers import installed_headers

root = pathlib.Path(__file__).resolve().parent.parent
rules = tomllib.loads((root / "tools/layers.toml").read_text())
folders, fences, namespaces = rules["folders"], rules["fences"], rules["namespaces"]
fronts = {"server": ["server"], "cli": ["cli", "server"], "python": ["python"]}  # with the fronts that they may include
complaints = []
types = {}  # by namespace and name: where they are defined


def note_types(place, text):
    """Types that are defined in a namespace with a name; those inside others are indented."""
    spaces = []
    for number, line in enumerate(text.splitlines(), 1):
        if match := re.match(r"(?:inline )?namespace ?([\w:]*) ?\{", line):
            spaces.append(match[1] or f"({place})")
        elif line.startswith("}  // namespace"):
            spaces.pop()
        elif match := re.match(r"(?:class|struct|enum(?: class)?) (\w+)(?![\w:<])[^;]*$", line):
            types.setdefault("::".join([*spaces, match[1]]), []).append(f"{place}:{number}")


def check_namespaces(place, folder, text):
    """A file is in its folder's namespace; others are for shared ones and for forward declarations."""
    own = "surefoot" if folder in namespaces["surefoot"] else f"surefoot::{folder}"
    shared = [f"surefoot::{name}" for name in namespaces["shared"]]
    for match in re.finditer(r"^namespace (surefoot[\w:]*) \{\n(.*?)^\}", text, re.MULTILINE | re.DOTALL):
        is_forward = all(re.match(r"((class|struct) \w+;)?$", line) for line in match[2].splitlines())
        is_own = match[1] == own or own != "surefoot" and match[1].startswith(f"{own}::")
        if not is_own and match[1] not in shared and not is_forward:
            number = text.count("\n", 0, match.start()) + 1
            complaints.append(f"{place}:{number}: namespace {match[1]} in the folder of {own}")


# An order in which every folder stands below the ones that may include it: none exists in a cycle.
remaining = {folder: set(allowed) for folder, allowed in folders.items()}
while free := [folder for folder, allowed in remaining.items() if not allowed & remaining.keys()]:
    for folder in free:
        del remaining[folder]
if remaining:
    complaints.append(f"tools/layers.toml: a cycle among {', '.join(remaining)}")

sources = [path for top in ("surefoot", *fronts) for path in sorted((root / top).rglob("*.[hc]pp"))]
for source in sources:
    place = source.relative_to(root)
    folder = place.parts[1] if place.parts[0] == "surefoot" and len(place.parts) > 2 else place.parts[0]
    if folder not in (*fronts, "surefoot", *folders):
        complaints.append(f"{place}: folder {folder} is not in tools/layers.toml")
        continue
    allowed = [folder, *folders[folder]] if folder in folders else folders
    text = source.read_text()
    note_types(place, text)
    check_namespaces(place, folder, text)
    for number, line in enumerate(text.splitlines(), 1):
        if not (match := re.match(r'\s*#\s*include\s*[<"]([^>"]+)', line)):
            continue
        header = match[1]
        parts = header.split("/")
        if parts[0] in fronts and parts[0] not in fronts.get(folder, []):
            complaints.append(f"{place}:{number}: {folder} must not include {header}")
        if parts[0] == "surefoot" and parts[1] not in allowed:
            complaints.append(f"{place}:{number}: {folder} must not include {header}")
        for fence, users in fences.items():
            fenced = header == fence or (fence.endswith("/") and header.startswith(fence))
            if fenced and folder not in users:
                where = ", ".join(users) or "tests and benchmarks"
                complaints.append(f"{place}:{number}: {header} is only for {where}")

for header in installed_headers():
    for included in re.findall(r"^#include <(.+)>", (root / header).read_text(), re.MULTILINE):
        if not re.match(r"Eigen/|\w+$", included):
            complaints.append(f"{header}: is installed, but {included} is not")

for name, places in types.items():
    if len(places) > 1:
        complaints.append(f"{places[0]}: {name} is defined again at {', '.join(places[1:])}")

print(*complaints, sep="\n", end="\n" if complaints else "")
print(f"layers: {len(sources)} files, {len(complaints)} complaints")
sys.exit(1 if complaints else 0)
