"""Writes docs/options.md from the program: tools/options_page.py [PROGRAM] > docs/options.md"""

import json
import subprocess
import sys

HEAD = """# Options of scenarios

Made by `tools/options_page.py` from `bin/surefoot list options`; a test holds it against the program. `<name>` is any
name of an entry, `<box>` that of an element of that shape; `[]` are the elements of a list. How to use them:
[getting started](getting_started.md#write-a-scenario), [simulation](simulation.md).
"""


def page(rows):
    lines, section = [HEAD.rstrip()], None
    for row in rows:
        key = row["key"]
        name = key.split(".")[0].rstrip("[]") if "." in key else "the run"
        if name != section:
            lines += ["", f"## {name}", "| key | default | range | |", "|---|---|---|---|"]
            section = name
        cells = [f"{row['default']} {row['unit']}".strip(), row["range"], row["help"]]
        lines.append(" | ".join([f"| `{key}`", *(cell.replace("|", "\\|") for cell in cells)]) + " |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    program = sys.argv[1] if len(sys.argv) > 1 else "bin/surefoot"
    rows = json.loads(subprocess.run([program, "list", "options", "--json"], capture_output=True, check=True).stdout)
    sys.stdout.write(page(sorted(rows, key=lambda row: "." in row["key"])))
