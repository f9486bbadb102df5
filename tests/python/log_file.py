"""What any program can do with a log: the official reader and a JSON parser, nothing of ours."""

import csv
import json

from mcap.reader import make_reader


def messages(path, topic):
    """All messages on a topic, decoded, in the order of their log time."""
    with open(path, "rb") as file:
        reader = make_reader(file, validate_crcs=True)
        return [json.loads(message.data) for _, _, message in reader.iter_messages(topics=[topic])]


def summary_of(path):
    """What its index tells."""
    with open(path, "rb") as file:
        return make_reader(file, validate_crcs=True).get_summary()


def rows_of(path):
    """Of a CSV file, by the names of its columns."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def attachment(path, name):
    with open(path, "rb") as file:
        found = [item.data for item in make_reader(file).iter_attachments() if item.name == name]
    assert len(found) == 1, f"{len(found)} attachments are called {name}"
    return found[0]


OPERATOR = [
    {"time": 0.5, "kind": "push", "text": "push of 12 N·s at base", "body": "base", "force": [0, 120, 0], "duration": 0.1},
    {"time": 0.6, "kind": "friction", "text": "friction 0.6 → 0.4", "friction": 0.4},
    {"time": 0.7, "kind": "push", "text": "push of 4.24 N·s at base", "body": "base", "force": [-30, 0, -30], "duration": 0.1},
    {"time": 0.9, "kind": "walk", "text": "the operator commands: stand"},
]
OPERATOR_TOLD = {
    0.5: "the operator pushes base with 12 N·s to the left (120 N for 0.1 s)",
    0.6: "friction 0.6 → 0.4, by the operator",
    0.7: "the operator pushes base with 4.24 N·s backwards and downwards (42.4 N for 0.1 s)",
    0.9: "the operator commands: stand",
}
"""What an operator did while a robot looked along x, and how it is told."""
