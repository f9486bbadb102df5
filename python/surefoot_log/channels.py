"""The fields of a topic as flat channels, named as viewer/README.md does."""

import re
from dataclasses import dataclass, field

AXES = ("x", "y", "z")
QUATERNION = ("w", "x", "y", "z")
LEVEL_LISTS = ("hierarchy.levels", "timings.levels")
UNIT = re.compile(r"\s*\[([^\]]*)\]")


@dataclass(frozen=True)
class Channel:
    name: str  # "plan.feet.LF.p_WF.x"
    kind: str  # as JSON Schema names it: number, integer, boolean or string
    unit: str = ""
    about: str = ""


@dataclass
class Node:
    """How a part of a message becomes values: its own channel, or those of its members, in order."""

    channel: Channel | None = None
    members: list = field(default_factory=list)  # (key or index, Node)
    levels: bool = False  # a list whose elements are found by their name


def described(description):
    """Text and unit: "of the base, in B [m/s]" has the unit m/s."""
    found = UNIT.search(description)
    return (description, "") if found is None else (UNIT.sub("", description, count=1), found.group(1))


def units_of(unit, count):
    """Of a list's numbers: "[N]" is of all of them, "[m/s, rad/s, …]" goes on as it ends, and "[N, N·m]" begins again."""
    units = unit.split(", ")
    if units[-1] == "…":
        units[-1:] = [units[-2]] * max(0, count - len(units) + 1)
    return ["" if units[i % len(units)] == "1" else units[i % len(units)] for i in range(count)]


def labels_of(name, count, joints):
    if count == len(joints):
        return joints
    if count == 4 and name.split(".")[-1].startswith("q_"):
        return QUATERNION
    return AXES[:count] if count <= 3 else [str(i) for i in range(count)]


def kind_of(schema):
    kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    return next((kind for kind in kinds if kind != "null"), "null")


class Flattener:
    """Channels and values of one topic's messages. Lists of rows are left out: their length changes from tick to tick."""

    def __init__(self, topic, schema, header, example):
        """`example`: a message, decoded; it has the sizes of lists that the schema leaves open."""
        self._joints, self._levels = header["robot"]["joint_names"], header["level_names"]
        self._units = dict(zip(self._levels, header.get("level_units", [])))
        self.channels = []
        self._root = self._object(topic.removeprefix("/"), schema, example)

    def values(self, message):
        found = []
        self._collect(self._root, message, found)
        return found

    def _collect(self, node, value, found):
        if node.channel is not None:
            found.append(value)
        elif node.levels:
            by_name = {level["name"]: level for level in value or []}
            for name, member in node.members:
                self._collect(member, by_name.get(name), found)
        else:
            for key, member in node.members:
                try:
                    self._collect(member, value[key], found)
                except (TypeError, KeyError, IndexError):
                    self._collect(member, None, found)

    def _object(self, name, schema, example):
        """Members without a description get that of their object, as the feet do."""
        node = Node()
        said = {"description": schema.get("description", "")}
        for key, part in schema["properties"].items():
            if "." not in name and key == "time":
                continue
            if not part.get("description"):
                part = part | said
            inner = example.get(key) if isinstance(example, dict) else None
            member = self._part(name, key, part, inner)
            if member is not None:
                node.members.append((key, member))
        return node

    def _part(self, name, key, schema, example):
        kind, full = kind_of(schema), f"{name}.{key}"
        if kind == "object":
            return self._object(full, schema, example)
        if kind == "array":
            return self._array(name, full, schema, example)
        return self._leaf(full, kind, schema.get("description", ""))

    def _array(self, name, full, schema, example):
        items, count = schema["items"], schema.get("maxItems", len(example or []))
        if kind_of(items) == "object":
            return self._level_list(name, items) if full in LEVEL_LISTS else None
        if kind_of(items) == "array":
            return self._matrix(full, schema, items)
        if kind_of(items) not in ("number", "integer"):
            return None
        labels = labels_of(full, count, self._joints)
        about, unit = described(schema.get("description", ""))
        units = units_of(unit, count)
        return Node(members=[(i, self._channel(f"{full}.{label}", kind_of(items), units[i], about)) for i, label in enumerate(labels)])

    def _matrix(self, full, schema, items):
        rows, columns, about = schema["maxItems"], items["maxItems"], schema.get("description", "")
        row_nodes = [Node(members=[(j, self._leaf(f"{full}.{i + 1}{j + 1}", "number", about)) for j in range(columns)]) for i in range(rows)]
        return Node(members=list(enumerate(row_nodes)))

    def _level_list(self, name, schema):
        members = [(level, self._object(f"{name}.level.{level}", {"properties": self._of_level(level, schema)}, None)) for level in self._levels]
        return Node(members=members, levels=True)

    def _of_level(self, level, schema):
        """Its fields, the residual with the unit of its rows."""
        properties = {key: part for key, part in schema["properties"].items() if key != "name"}
        if (unit := self._units.get(level)) and "residual" in properties:
            residual = properties["residual"]
            properties["residual"] = residual | {"description": f"{residual.get('description', '')} [{unit}]"}
        return properties

    def _leaf(self, name, kind, description):
        about, unit = described(description)
        return self._channel(name, kind, unit, about)

    def _channel(self, name, kind, unit, about):
        node = Node(channel=Channel(name, kind, unit, about))
        self.channels.append(node.channel)
        return node
