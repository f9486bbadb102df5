"""Films and strips of a log."""

import os
import pathlib
import sysconfig
from dataclasses import dataclass, field, replace

from surefoot_campaign.errors import InputError
from surefoot_log.camera import Camera
from surefoot_log.captions import Captions
from surefoot_log.clip import Film, nearest, times_of
from surefoot_log.frames import read_frames
from surefoot_log.moments import Span, shortened, span_of_interest
from surefoot_log.painter import painter
from surefoot_log.scene import dress
from surefoot_log.strip import LETTERS, QUALITY, TILE, make_strip
from surefoot_log.whole_file import written_whole

EVENT_SHOWN, GAVE_WAY_SHOWN = 1.2, 0.4  # s
# Of a report: small, and made in some seconds.
CLIP_SIZE, CLIP_RATE, CLIP_LENGTH = (768, 432), 12, 10.0  # pixels, 1/s, s
COARSE = 0.008  # m: detail of the meshes in it
STRIP_SCALE = 2  # pixels that become one along each edge


@dataclass
class Made:
    files: list
    times: list = field(default_factory=list)  # of the moments of a strip [s]
    span: Span | None = None  # of a film
    notes: list = field(default_factory=list)
    has_pushes: bool = False  # in a strip


def package_folders():
    """Where package://NAME/… is looked for, as the program does (surefoot/config/data_directory.hpp)."""
    listed = {name: [entry for entry in os.environ.get(name, "").split(":") if entry]
              for name in ("SUREFOOT_ROBOT_PACKAGES", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH")}  # fmt: skip
    robots = listed["SUREFOOT_ROBOT_PACKAGES"] or [pathlib.Path(sysconfig.get_path("platlib")) / "cmeel.prefix/share"]
    shares = [pathlib.Path(prefix) / "share" for prefix in listed["AMENT_PREFIX_PATH"]]
    return [pathlib.Path(folder) for folder in robots + listed["ROS_PACKAGE_PATH"] + shares]


def cache_folder():
    """Keeps meshes as they are drawn; the launcher names it. None: they are read anew each time."""
    return os.environ.get("SUREFOOT_MESH_CACHE") or None


def title_of(header):
    return f"{header['scenario']}, seed {header['seed']}"


def dressed(log, run, size, detail):
    scene = dress(log.text("model.xml"), log.text("robot.urdf"), package_folders(), cache_folder(), size, detail)
    if len(run.frames[0].qpos) > scene.model.nq:
        raise InputError(f"{log.path}: its model.xml is not that of its /truth")
    if not run.has_truth:
        scene.notes.append("the log has no /truth: the robot is shown where the controller believed it, the ground where it is")
    return scene


class Lasting:
    """Keeps a text on the picture for a while after it was true, so that it can be read."""

    def __init__(self, duration):
        self._duration, self._shown, self._until = duration, None, -1.0

    def forget(self):
        self._shown = None

    def update(self, value, time):
        if value:
            self._shown, self._until = value, time + self._duration
        return self._shown if time <= self._until else None


def time_of_event(frame):
    return frame.time if frame.event_time is None else frame.event_time


def with_lasting_words(pairs):
    event_shown, gave_way_shown = Lasting(EVENT_SHOWN), Lasting(GAVE_WAY_SHOWN)
    for frame, told in pairs:
        told = event_shown.update(told, frame.time)
        if frame.stop:  # nothing is solved any more
            gave_way_shown.forget()
        gave_way = gave_way_shown.update(frame if frame.gave_way else None, frame.time)
        yield replace(
            frame,
            event=told.event if told else "",
            event_time=told and time_of_event(told),
            gave_way=gave_way and gave_way.gave_way,
            gave_way_time=gave_way and gave_way.time,
        )


def write_film(run, paint, path, span, rate, speed, size, progress=None):
    captions = Captions(size[1], run.header)
    times = times_of(span.first, span.last, rate, speed)
    if progress is not None:
        progress(0, len(times))
    with Film(path, size, rate) as film:
        for i, frame in enumerate(with_lasting_words(nearest(run.frames, times))):
            film.add(captions.draw(paint(frame), frame, title_of(run.header), speed))
            if progress is not None:
                progress(i + 1, len(times))


def make_film(log, path, size=(1280, 720), rate=25, speed=1, first=None, last=None, progress=None):
    """Of the whole log, or of a part of it. Throws InputError where no tick lies in it."""
    run = read_frames(log, every=max(1, int(speed / rate / log.header["control_period"] / 2)))
    begin, end = run.frames[0].time, run.last
    span = Span(begin if first is None else first, end if last is None else last)
    if span.first > end or span.last < begin or span.last < span.first:
        asked = " ".join(f"{name} {value:g}" for name, value in (("--from", first), ("--to", last)) if value is not None)
        raise InputError(f"no tick lies in {asked}; the log goes from {begin:g} s to {end:g} s")
    span = Span(max(begin, span.first), min(end, span.last))
    scene = dressed(log, run, size, detail=0.005)
    camera = Camera(run.frames)
    with painter(scene, run.header, size) as artist, written_whole(path) as partial:
        write_film(run, lambda frame: artist.paint(frame, camera), partial, span, rate, speed, size, progress)
    return Made([path], span=span, notes=scene.notes)


def make_report_pictures(log, folder):
    """strip.jpg and clip.mp4 in a folder."""
    folder = pathlib.Path(folder)
    run = read_frames(log, every=8)
    camera = Camera(run.frames)
    size = (TILE[0] * STRIP_SCALE, TILE[1] * STRIP_SCALE)
    scene = dressed(log, run, size, detail=COARSE)
    with painter(scene, run.header, size) as artist:
        strip, moments = make_strip(run, lambda frame: artist.paint(frame, camera), Captions(TILE[1], run.header, LETTERS))
    strip.save(folder / "strip.jpg", quality=QUALITY, optimize=True)
    span = shortened(run.frames, span_of_interest(run.frames), CLIP_LENGTH)
    with painter(scene, run.header, CLIP_SIZE) as artist:
        write_film(run, lambda frame: artist.paint(frame, camera), folder / "clip.mp4", span, CLIP_RATE, 1, CLIP_SIZE)
    return Made(["strip.jpg", "clip.mp4"], [frame.time for frame in moments], span, scene.notes, any(frame.pushes for frame in moments))
