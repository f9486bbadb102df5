"""The rows of all finished runs: a file that only grows, one JSON object a line.

A line is written whole or, if the machine stops in the middle, is the torn last one; that one is dropped when the
file is opened again, and its run made again.
"""

import fcntl
import json
import os

from surefoot_campaign.errors import InputError


def is_row(line):
    try:
        return "id" in json.loads(line)
    except (ValueError, TypeError):
        return False


def split_torn(data):
    """The whole lines, and the bytes of a torn last one."""
    whole, _, torn = data.rpartition(b"\n")
    lines = whole.split(b"\n") if whole else []
    while lines and not is_row(lines[-1]) and not torn:
        torn = lines.pop() + b"\n"
    return lines, torn


def read_rows(path):
    """Maps each id to its last row. Does not change the file."""
    if not path.exists():
        return {}
    lines, _ = split_torn(path.read_bytes())
    rows = {}
    for number, line in enumerate(lines, 1):
        if not is_row(line):
            raise InputError(f"{path}:{number}: this line is no row; take it away, and its run is made again")
        row = json.loads(line)
        rows[row["id"]] = row
    return rows


def check_campaign(folder, rows, name):
    """A folder holds one campaign's results: throws InputError where they are another's."""
    other = next((row["campaign"] for row in rows.values() if row.get("campaign", name) != name), None)
    if other is not None:
        raise InputError(f'the folder {folder} holds results of the campaign "{other}", and those of "{name}" would take their place; '
                         "choose another with --out")  # fmt: skip


class Journal:
    def __init__(self, path):
        self.path = path
        self.fd = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
        try:
            fcntl.flock(self.fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(self.fd)
            raise InputError(f"another campaign writes to {path}; wait for it, or choose another folder with --out") from None
        lines, torn = split_torn(path.read_bytes())
        self.was_torn = bool(torn)
        if torn:
            os.ftruncate(self.fd, sum(len(line) + 1 for line in lines))
        self.rows = read_rows(path)

    def append(self, row):
        """Returns once the row is on the disk."""
        line = json.dumps(row, separators=(",", ":")).encode() + b"\n"
        size = os.fstat(self.fd).st_size
        try:
            if os.write(self.fd, line) != len(line):
                raise OSError(f"{self.path}: no space left for a whole row")
            os.fsync(self.fd)
        except OSError:
            os.ftruncate(self.fd, size)
            raise
        self.rows[row["id"]] = row

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.fd)
