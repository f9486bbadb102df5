"""Text on pictures: time, legs, events, and what gave way to what."""

import pathlib
from functools import cache

import matplotlib
from PIL import Image, ImageDraw, ImageFont

INK, SOFT, PANEL = (28, 31, 35, 255), (92, 99, 107, 255), (255, 255, 255, 205)
LEG_COLOURS = {"stance": (0, 114, 178, 255), "unloading": (0, 114, 178, 255), "swing": (255, 255, 255, 235), "search": (213, 94, 0, 255)}
LIGHT = (255, 255, 255, 255)
LEGS = ("LH", "LF", "RH", "RF")  # as they stand, the robot's front to the right


@cache
def font(size, bold=False):
    folder = pathlib.Path(matplotlib.get_data_path()) / "fonts" / "ttf"
    return ImageFont.truetype(str(folder / ("DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf")), size)


def words_of(name):
    return name.replace("_", " ")


def also(others):
    if not others:
        return ""
    if len(others) > 2:
        return f"; {len(others)} more levels give way too"
    return f"; {' and '.join(words_of(other) for other in others)} {'gives' if len(others) == 1 else 'give'} way too"


def sentence(frame, units):
    """What gave way to what, in a line; empty where nothing did."""
    if frame.gave_way is None:
        return ""
    level, residual, row, by, others = frame.gave_way
    unit = f" {units[level]}" if units.get(level) else ""
    digits = ".2g" if abs(residual) < 100 else ".0f"
    return f"{words_of(level)} gives way by {residual:{digits}}{unit} to {words_of(by)} {row}{also(others)}"


class Captions:
    """Draws on images of one height."""

    def __init__(self, height, header):
        self._unit = max(1.0, height / 45)  # pixels
        self._units = dict(zip(header["level_names"], header.get("level_units") or []))

    def draw(self, image, frame, title="", speed=1):
        """Time and legs at the bottom; at the top the title, an event, and what gave way."""
        canvas = Image.new("RGBA", image.size, (0, 0, 0, 0))
        draw = ImageDraw.Draw(canvas)
        unit, (width, height) = self._unit, image.size
        time = f"{frame.time:.2f} s" + (f"   ×{speed}" if speed != 1 else "")
        self._line(draw, 1.2 * unit, height - 1.2 * unit, time, INK, bold=True)
        self._legs(draw, (width - 1.2 * unit, height - 1.2 * unit), frame.phases)
        lines = [(title, SOFT), (frame.event, INK), (sentence(frame, self._units), INK)]
        for i, (text, colour) in enumerate([line for line in lines if line[0]]):
            self._line(draw, 1.2 * unit, (4.0 + 3.1 * i) * unit, text, colour)
        return Image.alpha_composite(image.convert("RGBA"), canvas).convert("RGB")

    def _line(self, draw, x, y, text, colour, bold=False):
        """A line on a panel whose lower left corner is x, y; a long one in smaller letters."""
        unit, room = self._unit, draw.im.size[0] - 2 * x - 1.4 * self._unit
        size = round(1.75 * unit)
        while size > 6 and draw.textlength(text, font(size, bold)) > room:
            size -= 1
        width = draw.textlength(text, font(size, bold))
        draw.rounded_rectangle((x, y - 2.8 * unit, x + width + 1.4 * unit, y), radius=0.6 * unit, fill=PANEL)
        draw.text((x + 0.7 * unit, y - 1.4 * unit), text, font=font(size, bold), fill=colour, anchor="lm")

    def _legs(self, draw, corner, phases):
        """A field a leg; blue carries, white swings, orange searches for ground."""
        unit, (right, bottom) = self._unit, corner
        for i, leg in enumerate(LEGS):
            phase = phases.get(leg)
            if phase is None:
                continue
            x, y = right - 3.9 * unit * (2 - i % 2), bottom - 2.8 * unit * (2 - i // 2)
            box = (x, y, x + 3.6 * unit, y + 2.5 * unit)
            draw.rounded_rectangle(box, radius=0.5 * unit, fill=LEG_COLOURS[phase], outline=SOFT, width=max(1, round(unit / 8)))
            draw.text(((box[0] + box[2]) / 2, (box[1] + box[3]) / 2), leg, font=font(round(1.4 * unit), True), anchor="mm",
                      fill=INK if phase == "swing" else LIGHT)  # fmt: skip
