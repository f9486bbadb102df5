"""Lists the fields of a log from the schemas that stand in it, as Markdown: .venv/bin/python tools/log_fields.py RUN.mcap"""

import json
import re
import sys

from mcap.reader import make_reader

HEAD = """# The fields of the log

Version {version}. Made from the schemas in a log.
[log.md](log.md) says what the topics are for and what holds for all fields.

`<leg>` is LF, RF, LH or RH, of six legs LM or RM, too; `[]` are the elements of a list. A unit alone is a number, `12 [rad]` are 12 of them.
`event_names` of `header.json` says what the numbers of `event` mean.
"""
LEGS = {"LF", "RF", "LH", "RH"}
UNIT = re.compile(r"\s*\[([^\]]*)\]")


def kinds(schema):
    return schema["type"] if isinstance(schema["type"], list) else [schema["type"]]


def type_of(schema, unit=""):
    if "enum" in schema:
        return "(" + ", ".join(schema["enum"]) + ")"
    if "array" in kinds(schema):
        count, items = schema.get("maxItems", "list of"), type_of(schema["items"], unit)
        return f"{count}{'×' if items[0].isdigit() else ' '}{'numbers' if items == 'number' else items}"
    kind = next(kind for kind in kinds(schema) if kind != "null")
    return f"[{unit}]" if unit else kind


def field(path, schema, about=None):
    """Path, type with unit, and description."""
    text = schema.get("description", "") if about is None else about
    unit = UNIT.search(text)
    return path, type_of(schema, unit.group(1) if unit else ""), UNIT.sub("", text, count=1).strip("; ")


def fields(schema, path=""):
    """Each field, members of members behind their own."""
    for name, part in schema["properties"].items():
        if name in LEGS:
            if name != "LF":
                continue
            name = "<leg>"
        full = f"{path}.{name}" if path else name
        items = part.get("items", {})
        if "object" in kinds(part):
            if set(part["properties"]) == LEGS and "object" not in kinds(part["properties"]["LF"]):
                yield field(f"{full}.<leg>", part["properties"]["LF"], part.get("description", ""))
            else:
                yield from fields(part, full)
        elif "properties" in items:
            yield f"{full}[]", "list", part.get("description", "")
            yield from fields(items, f"{full}[]")
        else:
            yield field(full, part)


def merged(rows):
    """Rows that differ in their path alone, but for its last name, are one."""
    paths = {}
    for path, kind, about in rows:
        paths.setdefault((path.rpartition(".")[2], kind, about), []).append(path)
    return [(", ".join(f"`{path}`" for path in same), kind, about) for (_, kind, about), same in paths.items()]


def listed(topic, schema, seen):
    """`seen` has the topic of each row so far: what an earlier topic has too is only named."""
    rows = list(fields(schema))
    repeated = {}
    for row in rows:
        if seen.setdefault(row, topic) != topic:
            repeated.setdefault(seen[row], []).append(f"`{row[0]}`")
    lines = [f"- {paths} {kind}: {about}" for paths, kind, about in merged(row for row in rows if seen[row] == topic)]
    lines += [f"- as in `{earlier}`: {', '.join(names)}" for earlier, names in repeated.items()]
    return "\n".join(lines)


def document(path):
    with open(path, "rb") as file:
        reader = make_reader(file)
        summary = reader.get_summary()
        header = next(json.loads(item.data) for item in reader.iter_attachments() if item.name == "header.json")
    parts = [HEAD.format(version=header["log_version"])]
    seen = {}
    for channel in summary.channels.values():
        schema = summary.schemas[channel.schema_id]
        parts.append(f"## `{channel.topic}`\n{schema.name}\n\n{listed(channel.topic, json.loads(schema.data), seen)}\n")
    return "\n".join(parts)


if __name__ == "__main__":
    print(document(sys.argv[1]), end="")
