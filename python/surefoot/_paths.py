"""Files by paths that stay the same wherever a program goes."""

from __future__ import annotations

import os
import re

PATH = re.compile(r"[^\s\[\]{},:'\"][^\[\]{},:'\"]*\.ya?ml")  # in the text of a YAML value


def is_path(name: str) -> bool:
    """Of a YAML file; else it is the name of one that ships."""
    return name.endswith((".yaml", ".yml"))


def absolute_path(name: str) -> str:
    """Of a YAML file that is in the working folder; of anything else `name` itself."""
    return os.path.abspath(name) if is_path(name) and os.path.isfile(name) else name


def with_absolute_paths(word: str) -> str:
    """Of "key=value", whose value may be a list."""
    key, _, value = word.partition("=")
    return f"{key}={PATH.sub(lambda found: absolute_path(found[0]), value)}"
