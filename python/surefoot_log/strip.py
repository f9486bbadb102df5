"""A sequence of moments of a run as one image, after Fig. 5 of Bellicoso 2016."""

from PIL import Image

from surefoot_log.moments import chosen, span_of_interest

COLUMNS, ROWS = 4, 2
TILE = (480, 330)  # pixels
LETTERS = 1.7  # times as large as a film has them: a report shows four tiles side by side
GAP = 6
QUALITY = 82


def make_strip(run, paint, captions):
    """`paint`: frame → image of at least the tile's size."""
    frames = chosen(run.frames, span_of_interest(run.frames), COLUMNS * ROWS)
    rows = -(-len(frames) // COLUMNS)
    columns = min(COLUMNS, len(frames))
    strip = Image.new("RGB", (columns * (TILE[0] + GAP) - GAP, rows * (TILE[1] + GAP) - GAP), "white")
    for i, frame in enumerate(frames):
        tile = paint(frame).resize(TILE, Image.Resampling.LANCZOS)
        tile = captions.draw(tile, frame)
        strip.paste(tile, ((i % COLUMNS) * (TILE[0] + GAP), (i // COLUMNS) * (TILE[1] + GAP)))
    return strip, frames
