"""What happened in a run, as messages on /events, in the words of `surefoot explain`."""

import json

from surefoot_log import foxglove_schemas as schemas
from surefoot_log import foxglove_shapes as shapes
from surefoot_log.frames import events_of
from surefoot_log.operator_text import heading_of, operator_text
from surefoot_log.stop_text import stop_text

INFO, WARNING, ERROR = 2, 3, 4  # levels of a foxglove.Log
BROKEN_OFF = ("interrupted", "begun again")


def read_ending(summary):
    """How a run ended, by the summary of its log, and whether by a fall; None where it is not known."""
    try:
        metrics = json.loads(summary)["metrics"]
        reason = metrics["reason"]
        return ("the run was " if reason in BROKEN_OFF else "the run ended: ") + reason, metrics.get("fell") is True
    except (ValueError, KeyError, TypeError, AttributeError):
        return None


class Events:
    """Tells, time by time, what the planner, the operator and the controller did, and at last how the run ended."""

    def __init__(self, file, header):
        self._file, self._header = file, header
        self._mode = None
        self._state = None  # that was told last
        self._time = 0  # that was seen last [ns]

    def see(self, messages):
        """The messages of one time."""
        self._time = messages[0].time
        for message in messages:
            if message.topic == "/changes":
                self._tell(operator_text(json.loads(bytes(message.data)), heading_of(self._state)), "operator")
        found = {message.topic: message for message in messages}
        for text in events_of({topic: message.data for topic, message in found.items()}, self._header):
            self._tell(text, "planner")
        if "/command" in found:
            self._see_command(found)
        self._state = found["/state"].data if "/state" in found else self._state

    def end(self, summary):
        """Behind the last tick; `summary`: of the log, as JSON, or None."""
        ending = read_ending(summary) if summary is not None else None
        if ending is not None:
            self._tell(ending[0], "run", ERROR if ending[1] else INFO)

    def _see_command(self, found):
        command = json.loads(bytes(found["/command"].data))
        before, self._mode = self._mode, command.get("mode")
        if before in (None, self._mode):
            return
        why = stop_text(command, json.loads(bytes(found["/health"].data)) if "/health" in found else {})
        self._tell(f"command mode: {self._mode}{why and f', as {why}'}", "controller", WARNING if why else INFO)

    def _tell(self, text, name, level=INFO):
        if not text:
            return
        message = {"timestamp": shapes.moment(self._time), "level": level, "message": text, "name": name, "file": "", "line": 0}
        self._file.write("/events", "foxglove.Log", schemas.LOG, self._time, message)
