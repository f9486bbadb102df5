"""Text on pictures: time, legs, events, and what gave way to what."""

import pathlib
from functools import cache

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from surefoot_campaign.text import in_words
from surefoot_log.frames import CARRIES

INK, SOFT, PANEL = (28, 31, 35, 255), (92, 99, 107, 255), (255, 255, 255, 205)
LEG_COLOURS = {"stance": SOFT, "unloading": SOFT, "swing": (255, 255, 255, 235), "search": (201, 161, 0, 255)}
LIGHT = (255, 255, 255, 255)


@cache
def font(size, bold=False):
    folder = pathlib.Path(matplotlib.get_data_path()) / "fonts" / "ttf"
    return ImageFont.truetype(str(folder / ("DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf")), size)


def also(others):
    if not others:
        return ""
    if len(others) > 2:
        return f"; {len(others)} more levels give way too"
    return f"; {' and '.join(in_words(other) for other in others)} {'gives' if len(others) == 1 else 'give'} way too"


def acting(limits, by):
    """The first two of the acting limits, with their level's name."""
    if not limits:
        return ""
    rows = ", ".join(limits[:2]) + (", …" if len(limits) > 2 else "")
    return f" as {in_words(by)} {'act' if by.endswith('s') else 'acts'}: {rows}"


def pushes_of(frame):
    """The forces that push the robot from outside, as text."""
    return " and ".join(f"{np.linalg.norm(force):.3g} N" for _, force, _ in frame.pushes)


def dated(text, time, frame):
    """A text with its time, where the picture shows another."""
    when, shown = f"{frame.time if time is None else time:.2f} s", f"{frame.time:.2f} s"
    return f"{text} ({when})" if text and when != shown else text


def sentence(frame, units):
    """Why the controller has stopped, or what gave way to what; empty if neither."""
    if frame.stop:
        return f"the controller has stopped for safety: {frame.stop}"
    if frame.gave_way is None:
        return ""
    level, residual, limits, by, others = frame.gave_way
    unit = f" {units[level]}" if units.get(level) else ""
    digits = ".2g" if abs(residual) < 99.5 else ".0f"
    why = " between two hierarchies" if by is None else acting(limits, by)
    return dated(f"{in_words(level)} gives way by {residual:{digits}}{unit}{why}{also(others)}", frame.gave_way_time, frame)


def wrapped(text, length, room):
    """The text in lines that are not longer than `room`, as `length` has them, where its words allow that."""
    lines = []
    for word in text.split():
        if lines and length(f"{lines[-1]} {word}") <= room:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return lines


class Captions:
    """Draws on images of one height; `scale`: of letters, larger in images that are shown small."""

    def __init__(self, height, header, scale=1.0):
        self._unit = max(1.0, scale * height / 45)  # pixels
        self._units = dict(zip(header["level_names"], header.get("level_units") or []))

    def draw(self, image, frame, title="", speed=1):
        """Time and legs at the bottom; at the top the title, an event, and what gave way."""
        canvas = Image.new("RGBA", image.size, (0, 0, 0, 0))
        draw = ImageDraw.Draw(canvas)
        unit, (width, height) = self._unit, image.size
        time = f"{frame.time:.2f} s" + (f"   ×{speed}" if speed != 1 else "")
        self._panel(draw, 1.2 * unit, height - 4.0 * unit, [time], INK, bold=True)
        self._legs(draw, (width - 1.2 * unit, height - 1.2 * unit), frame)
        top = 1.2 * unit
        for text, colour in self._texts(frame, title):
            lines = self._lines(text, width)
            self._panel(draw, 1.2 * unit, top, lines, colour)
            top += self._height(lines) + 0.3 * unit
        return Image.alpha_composite(image.convert("RGBA"), canvas).convert("RGB")

    def height(self, frame, width):
        """The height of the texts at the top of an image so wide [pixels]; 0 if there are none."""
        texts = self._texts(frame)
        heights = [self._height(self._lines(text, width)) + 0.3 * self._unit for text, _ in texts]
        return round(sum(heights) + 1.2 * self._unit) if texts else 0

    def _texts(self, frame, title=""):
        push = pushes_of(frame)
        texts = [(title, SOFT), (dated(frame.event, frame.event_time, frame), INK), (push and f"outside force {push}", INK), (sentence(frame, self._units), INK)]
        return [(text, colour) for text, colour in texts if text]

    def _lines(self, text, width):
        """The text in as many lines as it needs."""
        return wrapped(text, self._letters(False).getlength, width - 3.8 * self._unit)

    def _letters(self, bold):
        return font(round(1.75 * self._unit), bold)

    def _height(self, lines):
        return (2.8 + 2.2 * (len(lines) - 1)) * self._unit

    def _panel(self, draw, x, y, lines, colour, bold=False):
        """Lines on a panel whose upper left corner is x, y."""
        unit, letters = self._unit, self._letters(bold)
        width = max(draw.textlength(line, letters) for line in lines)
        draw.rounded_rectangle((x, y, x + width + 1.4 * unit, y + self._height(lines)), radius=0.6 * unit, fill=PANEL)
        for i, line in enumerate(lines):
            draw.text((x + 0.7 * unit, y + (1.4 + 2.2 * i) * unit), line, font=letters, fill=colour, anchor="lm")

    def _legs(self, draw, corner, frame):
        """One field for each leg, as they stand, the robot's front to the right: grey carries, white is in the air, amber searches for ground."""
        unit, (right, bottom) = self._unit, corner
        sides = [[leg for leg in frame.phases if leg.startswith(side)] for side in "LR"]
        for leg, row, column in ((leg, row, column) for row, legs in enumerate(sides) for column, leg in enumerate(legs)):
            phase = frame.phases[leg]
            if phase in CARRIES and leg not in frame.carrying:
                phase = "swing"
            x, y = right - 3.9 * unit * (column + 1), bottom - 2.8 * unit * (2 - row)
            box = (x, y, x + 3.6 * unit, y + 2.5 * unit)
            draw.rounded_rectangle(box, radius=0.5 * unit, fill=LEG_COLOURS[phase], outline=SOFT, width=max(1, round(unit / 8)))
            draw.text(((box[0] + box[2]) / 2, (box[1] + box[3]) / 2), leg, font=font(round(1.4 * unit), True), anchor="mm",
                      fill=INK if phase == "swing" else LIGHT)  # fmt: skip
