"""Pictures without a screen: the robot stands in them where the log says, with all that acts on it."""

import numpy as np
from log_file import messages
from pictures_made import SIZE, cache, dressed, painted, run  # noqa: F401, fixtures

from surefoot_log import camera  # isort: skip
from surefoot_log.frames import Frame  # isort: skip
from surefoot_log.offscreen import mujoco  # isort: skip
from surefoot_log.painter import painter  # isort: skip
from surefoot_log.push_arrows import Lens  # isort: skip


def test_frames_are_the_ticks_of_the_log(log, run):
    truths = messages(log, "/truth")[::40]
    assert [frame.time for frame in run.frames] == [truth["time"] for truth in truths]
    assert all(frame.qpos == truth["qpos"] for frame, truth in zip(run.frames, truths))
    assert run.has_truth


def test_an_event_between_two_frames_is_told_by_the_later_one(log, run):
    plans = messages(log, "/plan")
    names = run.header["event_names"]
    for i, frame in enumerate(run.frames[1:], 1):
        between = [names[event["event"]] for plan in plans[40 * i - 39 : 40 * i + 1] for event in plan["events"]]
        assert frame.event.endswith(between[-1]) if between else frame.event == ""
    assert any(frame.event for frame in run.frames)


def test_the_robot_is_drawn_where_it_is(log, run, cache):
    """Where it stands the picture is darker than where it does not; moved to the right, it is seen further right."""
    here = run.frames[0]
    there = Frame(here.time, [here.qpos[0] + 0.5, *here.qpos[1:]], here.p_SB)
    gone = Frame(here.time, [here.qpos[0] + 50.0, *here.qpos[1:]], here.p_SB)
    first, moved, empty = painted(log, run, [Frame(here.time, here.qpos, here.p_SB), there, gone], cache=cache)

    def column(image):
        dark = (empty.sum(axis=2) - image.sum(axis=2)) > 150
        assert dark.sum() > 0.02 * dark.size
        return np.nonzero(dark)[1].mean()

    assert abs(column(first) - SIZE[0] / 2) < 0.15 * SIZE[0]
    assert column(moved) > column(first) + 0.1 * SIZE[0]


def test_what_acts_is_drawn_over_it(log, run, cache):
    """A push is seen from wherever it acts, also behind the body, and at the body that it acts on."""
    def pushed(way, body=1):
        return Frame(frame.time, frame.qpos, frame.p_SB, pushes=[(body, np.array(way), np.zeros(3))])

    frame, bare = run.frames[5], Frame(run.frames[5].time, run.frames[5].qpos, run.frames[5].p_SB)
    ways = [(0.0, 300.0, 0.0), (0.0, -300.0, 0.0), (-300.0, 0.0, 0.0)]
    frames = [bare, frame, pushed((0.0, 0.0, 120.0)), pushed((0.0, 0.0, 120.0), 4), *map(pushed, ways)]
    plain, full, base, leg, *pushes = painted(log, run, frames, cache=cache)
    green = (full[..., 1] - full[..., 0]) - (plain[..., 1] - plain[..., 0]) > 15
    assert green.sum() > 40, "the support polygon"
    places = [np.nonzero(np.abs(image - plain).sum(axis=2) > 60) for image in (base, leg)]
    assert len(places[0][0]) > 15 and abs(places[0][1].mean() - places[1][1].mean()) + abs(places[0][0].mean() - places[1][0].mean()) > 4
    for push in pushes:
        yellow = (np.abs(push - plain).sum(axis=2) > 60) & (push[..., 0] > 180) & (push[..., 1] > 170) & (push[..., 2] < 120)
        assert yellow.sum() > 15


def test_an_arrow_over_the_image_lies_where_the_camera_sees_it(log, run, cache):
    frame = run.frames[5]
    view = camera.Camera(run.frames)
    with painter(dressed(log, cache=cache), run.header, SIZE) as artist:
        plain = np.asarray(artist.paint(frame, view), int)
        scene = artist._renderer.scene
        for offset in ((0.0, 0.0, 0.6), (0.4, 0.0, 0.5), (-0.3, 0.3, 0.6)):
            point = frame.p_SB + offset
            artist.paint(frame, view)
            mujoco.mjv_initGeom(scene.geoms[scene.ngeom], mujoco.mjtGeom.mjGEOM_SPHERE, np.full(3, 0.04), point, np.eye(3).ravel(), np.array([1, 0, 0, 1], np.float32))
            scene.ngeom += 1
            with_ball = np.asarray(artist._renderer.render(), int)
            rows, columns = np.nonzero(np.abs(with_ball - plain).sum(axis=2) > 60)
            x, y = Lens(scene.camera, SIZE).pixel(point)
            assert abs(np.median(columns) + 0.5 - x) < 1.5 and abs(np.median(rows) + 0.5 - y) < 1.5
