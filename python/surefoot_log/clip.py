"""Images of a run as a film: H.264 in MP4, which browsers play."""

import math
from fractions import Fraction

import av

QUALITY = 24  # constant rate factor: less is better and larger


class Film:
    """Takes images one by one; to be used in a `with`."""

    def __init__(self, path, size, rate, quality=QUALITY):
        # The same frames give the same bytes: no date, one thread.
        self._container = av.open(str(path), "w", format="mp4", options={"movflags": "+faststart", "fflags": "+bitexact"})
        self._stream = self._container.add_stream("libx264", rate=rate)
        self._stream.width, self._stream.height = size
        self._stream.pix_fmt = "yuv420p"
        self._stream.codec_context.thread_count = 1
        self._stream.options = {"crf": str(quality), "preset": "medium", "tune": "animation"}
        self._stream.time_base = Fraction(1, rate)

    def __enter__(self):
        return self

    def add(self, image):
        for packet in self._stream.encode(av.VideoFrame.from_image(image)):
            self._container.mux(packet)

    def __exit__(self, kind, *_):
        if kind is None:
            for packet in self._stream.encode():
                self._container.mux(packet)
        self._container.close()


def times_of(first, last, rate, speed):
    """The time of the run that each image of the film shows [s]."""
    step = speed / rate
    return [first + step * i for i in range(max(1, math.floor((last - first) / step + 1e-9) + 1))]


def nearest(frames, times):
    """The nearest frame of each time (both are in order), and the last frame since the time before that has an event, or None."""
    found, at, last = [], 0, None
    for time in times:
        while at + 1 < len(frames) and abs(frames[at + 1].time - time) <= abs(frames[at].time - time):
            at += 1
            last = frames[at] if frames[at].event else last
        found.append((frames[at], last))
        last = None
    return found
