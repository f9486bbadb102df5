"""Writes docs/log_fields.md from the schemas that stand in a log: tools/log_fields.py RUN.mcap > docs/log_fields.md"""

import json
import re
import sys

from mcap.reader import make_reader

HEAD = """# The fields of the log

Version {version}. Made by `tools/log_fields.py` from the schemas in a log; a test holds it against the program. What
holds for all fields, and what the topics are for, stands in [log.md](log.md). `<leg>` is LF, RF, LH or RH; `[]` are the
elements of a list.
"""
EVENTS = """What `event` says; the names stand in `header.json`, too, as `event_names`:
"""
LEGS = {"LF", "RF", "LH", "RH"}
UNIT = re.compile(r"\s*\[([^\]]*)\]")


def kinds(schema):
    return schema["type"] if isinstance(schema["type"], list) else [schema["type"]]


def type_of(schema):
    if "enum" in schema:
        return ", ".join(schema["enum"])
    if "array" in kinds(schema):
        count = schema.get("maxItems")
        return f"{'list' if count is None else count} of {type_of(schema['items'])}"
    return next(kind for kind in kinds(schema) if kind != "null")


def fields(schema, path=""):
    """Path, type and description of each field, members of members behind their own."""
    for name, part in schema["properties"].items():
        if name in LEGS:
            if name != "LF":
                continue
            name = "<leg>"
        full = f"{path}.{name}" if path else name
        items = part.get("items", {})
        if "object" in kinds(part):
            if part.get("description") and set(part["properties"]) != LEGS:
                yield full, "", part["description"]
            if set(part["properties"]) == LEGS and "object" not in kinds(part["properties"]["LF"]):
                yield f"{full}.<leg>", type_of(part["properties"]["LF"]), part.get("description", "")
            else:
                yield from fields(part, full)
        elif "properties" in items:
            yield f"{full}[]", "list", part.get("description", "")
            yield from fields(items, f"{full}[]")
        else:
            yield full, type_of(part), part.get("description", "")


def table(schema):
    lines = ["| field | type | unit | |", "|---|---|---|---|"]
    for path, kind, about in fields(schema):
        unit = UNIT.search(about)
        text = UNIT.sub("", about, count=1).strip("; ")
        lines.append(f"| `{path}` | {kind} | {unit.group(1) if unit else ''} | {text} |")
    return "\n".join(lines)


def events(names):
    lines = ["| `event` | |", "|---|---|"]
    return "\n".join(lines + [f"| {code} | {name} |" for code, name in enumerate(names)])


def document(path):
    with open(path, "rb") as file:
        reader = make_reader(file)
        summary = reader.get_summary()
        header = next(json.loads(item.data) for item in reader.iter_attachments() if item.name == "header.json")
    parts = [HEAD.format(version=header["log_version"])]
    for channel in summary.channels.values():
        schema = summary.schemas[channel.schema_id]
        parts.append(f"## `{channel.topic}`\n{schema.name}\n\n{table(json.loads(schema.data))}\n")
        if channel.topic == "/plan":
            parts.append(f"{EVENTS}\n{events(header['event_names'])}\n")
    return "\n".join(parts)


if __name__ == "__main__":
    print(document(sys.argv[1]), end="")
