"""What any program can do with a log: the official reader and a JSON parser, nothing of ours."""

import json

from mcap.reader import make_reader


def messages(path, topic):
    """All messages on a topic, decoded, in the order of their log time."""
    with open(path, "rb") as file:
        reader = make_reader(file, validate_crcs=True)
        return [json.loads(message.data) for _, _, message in reader.iter_messages(topics=[topic])]


def attachment(path, name):
    with open(path, "rb") as file:
        found = [item.data for item in make_reader(file).iter_attachments() if item.name == name]
    assert len(found) == 1, f"{len(found)} attachments are called {name}"
    return found[0]
