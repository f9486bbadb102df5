"""YAML with the line of every value, and numbers as YAML 1.2 has them (so `no` is a word and 1e-3 a number)."""

import re
from dataclasses import dataclass

import yaml

from surefoot_campaign.errors import InputError

INTEGER = re.compile(r"[-+]?[0-9]+")
FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
WORDS = {"true": True, "false": False, "null": None, "~": None, "": None}


@dataclass
class Node:
    """A value and where it stands: a dict of Nodes, a list of Nodes, or a plain value."""

    value: object
    line: int


def scalar(node):
    if node.style is not None:  # quoted, or a block of text
        return node.value
    if node.value.lower() in WORDS:
        return WORDS[node.value.lower()]
    if INTEGER.fullmatch(node.value):
        return int(node.value)
    if FLOAT.fullmatch(node.value):
        return float(node.value)
    return node.value


def convert(node, file):
    line = node.start_mark.line + 1
    if isinstance(node, yaml.ScalarNode):
        return Node(scalar(node), line)
    if isinstance(node, yaml.SequenceNode):
        return Node([convert(item, file) for item in node.value], line)
    members = {}
    for key, value in node.value:
        where = f"{file}:{key.start_mark.line + 1}"
        if not isinstance(key, yaml.ScalarNode):
            raise InputError(f"{where}: a key must be a plain word")
        if key.value in members:
            raise InputError(f'{where}: the key "{key.value}" is given twice')
        members[key.value] = convert(value, file)
        if not isinstance(value, yaml.ScalarNode) or not value.value:
            members[key.value].line = key.start_mark.line + 1
    return Node(members, line)


def read_yaml(path):
    """The tree of a file whose top is a map."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: this file can't be read: {getattr(error, 'strerror', None) or error}") from None
    try:
        node = yaml.compose(text, Loader=yaml.SafeLoader)
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else 1
        raise InputError(f"{path}:{line}: this is not YAML: {error.problem}") from None
    except yaml.YAMLError as error:
        raise InputError(f"{path}: this is not YAML: {error}") from None
    if not isinstance(node, yaml.MappingNode):
        raise InputError(f"{path}: must be YAML of the form `key: value`")
    try:
        return convert(node, path)
    except RecursionError:
        raise InputError(f"{path}: an alias leads to itself, or it is nested too deep") from None
