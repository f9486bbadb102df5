"""What of a run is shown in its pictures, from where, and what is said of it."""

import numpy as np
import pytest
from pictures_made import frame_at

from surefoot_log import camera, captions, moments, overlays  # isort: skip
from surefoot_log.frames import Touch, gave_way  # isort: skip


def test_the_camera_stands_beside_the_walk_and_follows_smoothly():
    for angle in (0.0, 1.0, -2.5):
        frames = [frame_at(0.0, 0.1 * i) for i in range(50)]
        for i, frame in enumerate(frames):
            frame.p_WB = np.array([0.05 * i * np.cos(angle), 0.05 * i * np.sin(angle), 0.5 + 0.01 * (i % 2)])
        view = camera.Camera(frames)
        heights = [view.at(0.1 * i)[0][2] for i in range(10, 40)]
        azimuth = np.radians(view.at(2.0)[1].azimuth)
        side = np.cos(azimuth) * -np.sin(angle) + np.sin(azimuth) * np.cos(angle)
        assert side > 0.9  # it looks to the robot's left, from its right
        assert np.ptp(heights) < 0.003
        assert view.at(2.5)[0][:2] == pytest.approx(frames[25].p_WB[:2], abs=1e-6)


def test_what_is_shown_begins_before_and_ends_after_what_happened():
    quiet = [frame_at(0.01 * i, 0.1 * i, phases={"LF": "stance"}) for i in range(200)]
    quiet[80].phases = {"LF": "search"}
    quiet[120].pushes = [(1, np.array([30.0, 0, 0]))]
    span = moments.span_of_interest(quiet)
    assert (span.first, span.last) == (pytest.approx(6.5), pytest.approx(13.5))
    chosen = moments.chosen(quiet, span, 7)
    times = [frame.time for frame in chosen]
    assert len(times) == 7 and times == sorted(set(times)) and span.first <= times[0] and times[-1] <= span.last
    part = moments.shortened(quiet, span, 3.0)
    assert part.length == pytest.approx(3.0) and span.first <= part.first and part.last <= span.last + 1e-9


def test_a_walk_without_events_is_shown_from_its_first_step():
    frames = [frame_at(max(0.0, 0.01 * (i - 50)), 0.1 * i, phases={"LF": "stance"}) for i in range(200)]
    span = moments.span_of_interest(frames)
    assert span.first == pytest.approx(5.6, abs=0.11) and span.last == pytest.approx(19.9)


def test_the_share_of_the_friction_cone_and_its_colours():
    def touch(force, normal=(0, 0, 1)):
        return Touch("LF", np.zeros(3), np.array(force, float), np.array(normal, float), 0.5)

    assert touch([30.0, 40.0, 100.0]).friction_use == pytest.approx(1.0)
    assert touch([0.0, 0.0, -1.0]).friction_use == 0.0
    assert touch([60.0, 0.0, 80.0], [0.6, 0.0, 0.8]).friction_use == pytest.approx(0.0), "straight into a slope"
    assert overlays.colour_of_use(0.0)[:3] == pytest.approx(overlays.SAFE)
    assert overlays.colour_of_use(0.7)[:3] == pytest.approx(overlays.NEAR)
    assert overlays.colour_of_use(3.0)[:3] == pytest.approx(overlays.SLIDES)


def test_the_hull_of_points_goes_around_them():
    points = [(0, 0, 1), (2, 0, 1), (1, 0.5, 1), (2, 2, 1), (0, 2, 1)]
    assert [tuple(corner) for corner in overlays.hull(points)] == [(0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)]


def test_words_on_pictures_stay_inside_and_say_what_gave_way():
    frame = frame_at(0.0, 1.25, phases={"LF": "swing", "RF": "stance", "LH": "search", "RH": "unloading"})
    frame.gave_way = ("com_xy", 0.314, "LF_KFE", "torque_limits", ())
    assert captions.sentence(frame, {"com_xy": "m/s²"}) == "com xy gives way by 0.31 m/s² to torque limits LF_KFE"
    frame.gave_way = ("com_xy", 161.4, "LF_KFE", "torque_limits", ("torso_yaw",))
    assert captions.sentence(frame, {}) == "com xy gives way by 161 to torque limits LF_KFE; torso yaw gives way too"
    frame.gave_way = (*frame.gave_way[:4], ("torso_yaw", "torso_height"))
    assert captions.sentence(frame, {}).endswith("; torso yaw and torso height give way too")
    frame.gave_way = (*frame.gave_way[:4], ("a", "b", "c"))
    assert captions.sentence(frame, {}).endswith("; 3 more levels give way too")
    from PIL import Image

    header = {"level_names": ["com_xy"], "level_units": ["m/s²"]}
    blank = Image.new("RGB", (320, 240), "black")
    drawn = np.asarray(captions.Captions(240, header).draw(blank, frame, "a title that is much longer than such a small picture is wide, really", 2))
    lit = np.nonzero(drawn.sum(axis=2))
    assert lit[1].max() < 318 and lit[0].max() < 238 and lit[0].min() > 1


def test_a_level_gives_way_from_the_residual_on_that_the_header_tells():
    header = {"level_names": ["com", "forces_minimisation"], "level_visible": [0.02, None]}
    levels = [{"name": "com", "residual": 0.01}, {"name": "forces_minimisation", "residual": 9.0}]
    rows = [{"level": "com", "row": "LF", "by": "limits"}]
    assert gave_way({"levels": levels, "blocked_by": rows}, header) is None
    levels[0]["residual"] = 0.03
    assert gave_way({"levels": levels, "blocked_by": rows}, header) == ("com", 0.03, "LF", "limits", ())
    levels.append({"name": "torso", "residual": 1.0})
    header["level_visible"].append(0.05)
    header["level_names"].append("torso")
    assert gave_way({"levels": levels, "blocked_by": rows}, header) == ("com", 0.03, "LF", "limits", ("torso",))
    levels[0]["residual"] = None
    assert gave_way({"levels": levels, "blocked_by": rows}, header) is None, "nothing was solved, or what holds it is not known"
    del header["level_visible"]
    levels[0]["residual"] = 0.01
    assert gave_way({"levels": levels, "blocked_by": rows}, header)[0] == "com", "an older log"
