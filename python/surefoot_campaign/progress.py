"""How far many runs or the images of a film are, and how long the rest will take, on stderr."""

import sys
import time

WIDTH = 30
REDRAW = 0.2  # s, on a terminal
NEXT_LINE = 10.0  # s, elsewhere
EARLY, SHORT, LITTLE = 2.0, 60.0, 0.05  # s, s and a share: from when on the time left is known, and worth telling


def duration_text(seconds):
    if seconds < 90:
        return f"{seconds:.0f} s"
    if seconds < 5400:
        return f"{seconds / 60:.0f} min"
    return f"{seconds / 3600:.1f} h"


class Progress:
    def __init__(self, label, done, total, unit="runs", stream=None):
        self.label, self.before, self.done, self.total, self.unit = label, done, done, total, unit
        self.stream = stream or sys.stderr
        self.terminal = self.stream.isatty()
        self.started = self.last = time.monotonic()

    def __enter__(self):
        if self.terminal:
            self.draw()
        return self

    def __exit__(self, *_):
        self.wipe()

    def left(self):
        """ ", about 3 min left", from the pace so far; empty where it is too early to tell, or all of it takes less than a minute."""
        seconds, share = time.monotonic() - self.started, (self.done - self.before) / max(1, self.total - self.before)
        is_known = seconds >= EARLY and LITTLE <= share < 1 and seconds / share >= SHORT
        return f", about {duration_text(seconds * (1 - share) / share)} left" if is_known else ""

    def update(self):
        self.done += 1
        now = time.monotonic()
        if now - self.last >= (REDRAW if self.terminal else NEXT_LINE):
            self.last = now
            self.draw()

    def say(self, line):
        self.wipe()
        print(line, file=self.stream, flush=True)
        if self.terminal:
            self.draw()

    def draw(self):
        text = f"{self.done} of {self.total} {self.unit}{self.left()}"
        if self.terminal:
            filled = WIDTH * self.done // max(1, self.total)
            print(f"\r\033[K{self.label} {'█' * filled}{'░' * (WIDTH - filled)} {text}", end="", file=self.stream, flush=True)
        else:
            print(f"{self.label}: {text}", file=self.stream, flush=True)

    def wipe(self):
        if self.terminal:
            print("\r\033[K", end="", file=self.stream, flush=True)
