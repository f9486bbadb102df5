"""Films and strips of a log."""

import io
import os
import pathlib
import sysconfig
from dataclasses import asdict, replace

from surefoot_campaign.errors import InputError
from surefoot_campaign.output_files import written_whole
from surefoot_campaign.progress import Progress
from surefoot_log.camera import Camera
from surefoot_log.captions import Captions
from surefoot_log.clip import Film, nearest, times_of
from surefoot_log.frames import read_frames
from surefoot_log.moments import Span, shortened, span_of_interest
from surefoot_log.painter import painter
from surefoot_log.scene import dress
from surefoot_log.strip import LETTERS, QUALITY, TILE, make_strip

EVENT_SHOWN, GAVE_WAY_SHOWN = 1.2, 0.4  # s
# The clip and strip of a report are small, and made in some seconds.
CLIP_SIZE, CLIP_RATE, CLIP_LENGTH = (768, 432), 12, 10.0  # pixels, 1/s, s
COARSE = 0.008  # m: detail of the meshes in it
STRIP_SCALE = 2  # pixels that become one along each edge


def package_folders():
    """Where package://NAME/… is looked for, as the program does (surefoot/config/data_directory.hpp)."""
    listed = {name: [entry for entry in os.environ.get(name, "").split(":") if entry]
              for name in ("SUREFOOT_ROBOT_PACKAGES", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH")}  # fmt: skip
    site = pathlib.Path(sysconfig.get_path("platlib"))
    robots = listed["SUREFOOT_ROBOT_PACKAGES"] or [site / "cmeel.prefix/share", site]
    shares = [pathlib.Path(prefix) / "share" for prefix in listed["AMENT_PREFIX_PATH"]]
    return [pathlib.Path(folder) for folder in robots + listed["ROS_PACKAGE_PATH"] + shares]


def cache_folder():
    """Keeps meshes as they are drawn; the launcher names it. None: they are read again each time."""
    return os.environ.get("SUREFOOT_MESH_CACHE") or None


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


def with_lasting_words(pairs):
    event_shown, gave_way_shown = Lasting(EVENT_SHOWN), Lasting(GAVE_WAY_SHOWN)
    for frame, happened in pairs:
        happened = event_shown.update(happened, frame.time)
        if frame.stop:  # nothing is solved any more
            gave_way_shown.forget()
        gave_way = gave_way_shown.update(frame if frame.gave_way else None, frame.time)
        yield replace(
            frame,
            event=happened.event if happened else "",
            event_time=happened and (happened.time if happened.event_time is None else happened.event_time),
            gave_way=gave_way and gave_way.gave_way,
            gave_way_time=gave_way and gave_way.time,
        )


def write_film(run, paint, path, span, rate, speed, size, stream=None):
    """`stream`: where its progress is shown."""
    captions, title = Captions(size[1], run.header), f"{run.header['scenario']}, seed {run.header['seed']}"
    times = times_of(span.first, span.last, rate, speed)
    with Film(path, size, rate) as film, Progress("film", 0, len(times), "images", stream or io.StringIO()) as progress:
        progress.draw()
        for frame in with_lasting_words(nearest(run.frames, times)):
            film.add(captions.draw(paint(frame), frame, title, speed))
            progress.update()


def make_film(log, path, size, rate, speed, first=None, last=None, stream=None):
    """Films the whole log, or a part of it. Returns notes. Throws InputError where no tick lies in it, and on a name that is no film's."""
    if pathlib.Path(path).suffix.lower() != ".mp4":
        raise InputError(f"{path}: films are written as MP4; a name that ends with .mp4 would be valid")
    run = read_frames(log, every=max(1, int(speed / rate / log.header["control_period"] / 2)))
    begin, end = run.frames[0].time, run.last
    span = Span(begin if first is None else first, end if last is None else last)
    if span.first > end or span.last < begin or span.last < span.first:
        asked = " ".join(f"{name} {value:g} s" for name, value in (("from", first), ("to", last)) if value is not None)
        raise InputError(f"no tick lies {asked}; the log goes from {begin:g} s to {end:g} s")
    span = Span(max(begin, span.first), min(end, span.last))
    scene = dressed(log, run, size, detail=0.005)
    camera = Camera(run.frames)
    with painter(scene, run.header, size) as artist, written_whole(path) as partial:
        write_film(run, lambda frame: artist.paint(frame, camera), partial, span, rate, speed, size, stream)
    return scene.notes


def make_picture(log, time, size):
    """The robot at a time, as an image."""
    run = read_frames(log)
    begin, end = run.frames[0].time, run.last
    if not begin <= time <= end:
        raise InputError(f"no tick lies at {time:g} s; the log goes from {begin:g} s to {end:g} s")
    scene, captions = dressed(log, run, size, detail=0.005), Captions(size[1], run.header)
    shown = min(run.frames, key=lambda frame: abs(frame.time - time))
    with painter(scene, run.header, size) as artist:
        return captions.draw(artist.paint(shown, Camera(run.frames)), shown, f"{run.header['scenario']}, seed {run.header['seed']}")


def make_report_pictures(log, folder):
    """Writes strip.jpg and clip.mp4 into a folder. Returns the times [s] of the strip's moments and whether something pushes the robot in them, the span [s]
    that the clip shows, and notes."""
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
    return {"times": [round(frame.time, 6) for frame in moments], "span": asdict(span), "notes": scene.notes,
            "has_pushes": any(frame.pushes for frame in moments)}  # fmt: skip
