"""How far a campaign is and how long it will take, on stderr."""

import sys
import time

WIDTH = 30
REDRAW = 0.2  # s, on a terminal
NEXT_LINE = 10.0  # s, elsewhere


def duration_text(seconds):
    if seconds < 90:
        return f"{seconds:.0f} s"
    if seconds < 5400:
        return f"{seconds / 60:.0f} min"
    return f"{seconds / 3600:.1f} h"


class Progress:
    def __init__(self, label, done, total, stream=None):
        self.label, self.before, self.done, self.total = label, done, done, total
        self.stream = stream or sys.stderr
        self.terminal = self.stream.isatty()
        self.started = self.last = time.monotonic()

    def left(self):
        """Seconds, from the pace so far; None before the first run."""
        made = self.done - self.before
        return None if made == 0 else (time.monotonic() - self.started) / made * (self.total - self.done)

    def update(self):
        self.done += 1
        now = time.monotonic()
        if now - self.last >= (REDRAW if self.terminal else NEXT_LINE):
            self.last = now
            self.draw()

    def say(self, line):
        self.wipe()
        print(line, file=self.stream, flush=True)

    def draw(self):
        left = self.left()
        text = f"{self.done} of {self.total} runs" + (f", {duration_text(left)} left" if left is not None else "")
        if self.terminal:
            filled = WIDTH * self.done // max(1, self.total)
            print(f"\r\033[K{self.label} {'█' * filled}{'░' * (WIDTH - filled)} {text}", end="", file=self.stream, flush=True)
        else:
            print(f"{self.label}: {text}", file=self.stream, flush=True)

    def wipe(self):
        if self.terminal:
            print("\r\033[K", end="", file=self.stream, flush=True)
