"""A sequence of moments of a run as one image, after Fig. 5 of Bellicoso 2016."""

from PIL import Image

from surefoot_log.moments import chosen, span_of_interest

COLUMNS, ROWS = 4, 2
TILE = (480, 330)  # pixels
LETTERS = 1.7  # times as large as a film has them: a report shows four tiles side by side
GAP = 6
SKY = 70  # pixels: as much over the robot a text may cover
QUALITY = 82


def make_strip(run, paint, captions):
    """`paint`: frame → image of at least the tile's size. A row gets more sky where the texts of one of its
    moments need more room than there is over the robot."""
    frames = chosen(run.frames, span_of_interest(run.frames), COLUMNS * ROWS)
    rows = -(-len(frames) // COLUMNS)
    columns = min(COLUMNS, len(frames))
    bands = [band_over(frames[k * COLUMNS : (k + 1) * COLUMNS], captions) for k in range(rows)]
    strip = Image.new("RGB", (columns * (TILE[0] + GAP) - GAP, rows * (TILE[1] + GAP) - GAP + sum(bands)), "white")
    for i, frame in enumerate(frames):
        row = i // COLUMNS
        picture = paint(frame).resize(TILE, Image.Resampling.LANCZOS)
        tile = Image.new("RGB", (TILE[0], TILE[1] + bands[row]), picture.getpixel((0, 0)))
        tile.paste(picture, (0, bands[row]))
        strip.paste(captions.draw(tile, frame), ((i % COLUMNS) * (TILE[0] + GAP), row * (TILE[1] + GAP) + sum(bands[:row])))
    return strip, frames


def band_over(frames, captions):
    """Height of the sky that is added over a row of moments, so that no text covers a robot [pixels]."""
    highest = max(captions.height(frame, TILE[0]) for frame in frames)
    return max(0, highest - SKY)
