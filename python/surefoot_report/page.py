"""The HTML around the report's figures: one file, no scripts, no network, light and dark."""

import base64
import pathlib
from dataclasses import dataclass, field

from surefoot_campaign.text import escape
from surefoot_report.plotting import STYLE


def page(title, body):
    return (f'<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{escape(title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n{body}</body>\n</html>\n")  # fmt: skip


def figure(number, name, image, caption):
    """An image with its caption and links to its files."""
    links = " ".join(f'<a class="file" href="figures/{name}.{form}" download>Save as {form.upper()}</a>' for form in ("svg", "pdf"))
    return (f'<figure>\n<div class="scroll">{image}</div><figcaption><b>Figure {number}.</b> {escape(caption)} {links}</figcaption>\n'
            "</figure>\n")  # fmt: skip


@dataclass
class Cell:
    text: str
    style: str = ""  # CSS classes


def class_of(style):
    return f' class="{style}"' if style else ""


def table(head, rows, group=0):
    """`head` may be empty; the first `group` rows are set apart by a rule from those below."""
    out = '<div class="scroll"><table>\n'
    if head:  # which stands where the cells of its column do
        styles = ["number" if "number" in cell.style else "" for cell in rows[0]] if rows else [""] * len(head)
        out += "<tr>" + "".join(f"<th{class_of(style)}>{escape(text)}</th>" for text, style in zip(head, styles)) + "</tr>\n"
    for number, row in enumerate(rows, 1):
        cells = "".join(f"<td{class_of(cell.style)}>{escape(cell.text)}</td>" for cell in row)
        out += f"<tr{class_of('group' if number == group < len(rows) else '')}>{cells}</tr>\n"
    return out + "</table></div>\n"


@dataclass
class Pictures:
    """Strip and clip of a run, as files."""

    folder: pathlib.Path | None = None
    times: list = field(default_factory=list)  # of the strip's moments [s]
    span: dict = field(default_factory=dict)  # of the run, that the clip shows [s]
    has_pushes: bool = False  # something pushes the robot in the strip
    notes: list = field(default_factory=list)  # what they don't show as it is
    why_none: str = ""  # in words
    are_coming: bool = False


def data_of(file, kind):
    return f"data:{kind};base64,{base64.b64encode(file.read_bytes()).decode()}"


def strip(pictures):
    times = ", ".join(f"{time:.2f} s" for time in pictures.times)
    push = "; the yellow arrow, 0.2 m longer than its force alone would make it: what pushes the robot from outside" if pictures.has_pushes else ""
    return (f'<figure class="pictures">\n<img alt="The robot at {times}" src="{data_of(pictures.folder / "strip.jpg", "image/jpeg")}">\n<figcaption>The '
            f"robot in the simulation, after the paper's Fig. 5, at {times}. Arrows: ground forces, grey below 60 % of their friction cone, amber from "
            f"there and red from 90 % on{push}. Dark green: the region between the feet that carry, at the height of the highest; black: the centre of "
            "mass over it. Legs in grey carry, in white are in the air, in amber search for ground.</figcaption>\n</figure>\n")  # fmt: skip


def clip(pictures):
    return (f'<figure class="pictures">\n<video controls loop muted playsinline src="{data_of(pictures.folder / "clip.mp4", "video/mp4")}"></video>\n'
            f"<figcaption>{pictures.span['first']:.2f} s to {pictures.span['last']:.2f} s of the run, at its own speed.</figcaption>\n</figure>\n")  # fmt: skip


def pictures_part(pictures):
    out = strip(pictures) + clip(pictures) if pictures.folder else ""
    if pictures.are_coming:
        out += ('<p class="soft">They are being made: load this page again in a while. If this stays so, <code>surefoot report</code> makes them of the '
                "log.</p>\n")  # fmt: skip
    notes = [f"No pictures: {pictures.why_none}"] * bool(pictures.why_none) + pictures.notes
    out += "".join(f'<p class="soft">{escape(note)}</p>\n' for note in notes)
    return f"<h2>Pictures</h2>\n{out}" if out else ""
