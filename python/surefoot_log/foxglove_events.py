"""What happened in a run, as messages on /events."""

import json

from surefoot_log import foxglove_schemas as schemas
from surefoot_log import foxglove_shapes as shapes
from surefoot_log.log_file import event_text, stop_reason

INFO, WARNING, ERROR = 2, 3, 4  # levels of a foxglove.Log


def has_fallen(summary):
    """Whether the robot fell, by the summary of the log (JSON)."""
    try:
        return json.loads(summary)["metrics"]["fell"] is True
    except (ValueError, KeyError, TypeError):
        return False


class Events:
    """Writes the events in time with the scene."""

    def __init__(self, file, log, summary):
        self._file, self._events, self._ended = file, list(log.events), ERROR if has_fallen(summary) else INFO

    def write_until(self, time=float("inf")):
        """`time` in ns."""
        while self._events and round(1e9 * self._events[0]["time"]) <= time:
            self._write(self._events.pop(0))

    def _write(self, event):
        time, by = round(1e9 * event["time"]), event["by"]
        level = self._ended if by == "run" else WARNING if stop_reason(event) else INFO
        message = {"timestamp": shapes.moment(time), "level": level, "message": event_text(event), "name": by, "file": "", "line": 0}
        self._file.write("/events", "foxglove.Log", schemas.LOG, time, message)
