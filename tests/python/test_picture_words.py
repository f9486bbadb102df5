"""What of a run is shown in its pictures, from where, and what is said of it."""

import json
import re
from types import SimpleNamespace

import numpy as np
import pytest
from log_tools import ROOT
from PIL import Image
from pictures_made import frame_at

from surefoot_log import camera, captions, moments, overlays, strip  # isort: skip
from surefoot_log.clip import nearest, times_of  # isort: skip
from surefoot_log.foxglove import scene_entities  # isort: skip
from surefoot_log.frames import LEGS, FrameMaker, Touch, add_truth, frame_of, gave_way  # isort: skip
from surefoot_log.log_file import Message  # isort: skip
from surefoot_log.pictures import with_lasting_words  # isort: skip
from surefoot_log.offscreen import mujoco  # isort: skip


def test_the_camera_stands_beside_the_walk_and_follows_smoothly():
    for angle in (0.0, 1.0, -2.5):
        frames = [frame_at(0.0, 0.1 * i) for i in range(50)]
        for i, frame in enumerate(frames):
            frame.p_SB = np.array([0.05 * i * np.cos(angle), 0.05 * i * np.sin(angle), 0.5 + 0.01 * (i % 2)])
        view = camera.Camera(frames)
        heights = [view.at(0.1 * i)[0][2] for i in range(10, 40)]
        azimuth = np.radians(view.at(2.0)[1].azimuth)
        side = np.cos(azimuth) * -np.sin(angle) + np.sin(azimuth) * np.cos(angle)
        assert side > 0.9  # it looks to the robot's left, from its right
        assert np.ptp(heights) < 0.003
        assert view.at(2.5)[0][:2] == pytest.approx(frames[25].p_SB[:2], abs=1e-6)


def test_an_arrow_that_would_leave_the_picture_is_cut_short_with_two_heads():
    force = np.array([30.0, 0.0, 40.0])
    assert [tuple(way) for way in overlays.ground_arrows(force)] == [tuple(overlays.METRES_PER_NEWTON * force)]
    whole, second = overlays.ground_arrows(100 * force)
    assert np.linalg.norm(whole) == pytest.approx(overlays.LONGEST) and np.cross(whole, force) == pytest.approx(np.zeros(3))
    assert np.linalg.norm(second) < np.linalg.norm(whole)


def test_what_is_shown_begins_before_and_ends_after_what_happened():
    quiet = [frame_at(0.01 * i, 0.1 * i, phases={"LF": "stance"}) for i in range(200)]
    quiet[80].phases = {"LF": "search"}
    quiet[120].pushes = [(1, np.array([30.0, 0, 0]), np.zeros(3))]
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
    page = {name: (ROOT / "viewer/src" / name).read_text() for name in ("math/friction.ts", "scene/palette.ts")}
    near, slides = map(float, re.search(r"use < ([\d.]+) \? \"good\" : use < ([\d.]+) \? \"near\"", page["math/friction.ts"]).groups())
    colours = re.search(r"margin: { good: 0x(\w+), near: 0x(\w+), bad: 0x(\w+) }", page["scene/palette.ts"]).groups()
    for use, colour in [(0.0, 0), (near - 0.01, 0), (near, 1), (slides - 0.01, 1), (slides, 2), (3.0, 2)]:
        assert overlays.colour_of_use(use) == pytest.approx((*(byte / 255 for byte in bytes.fromhex(colours[colour])), 1.0)), "as on the page"


def test_the_hull_of_points_goes_around_them():
    points = [(0, 0, 1), (2, 0, 1), (1, 0.5, 1), (2, 2, 1), (0, 2, 1)]
    assert [tuple(corner) for corner in overlays.hull(points)] == [(0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)]


SENTENCES = [
    (("com_xy", 0.314, ("LF_KFE",), "torque_limits", ()), {"com_xy": "m/s²"}, "com xy gives way by 0.31 m/s² as torque limits act: LF_KFE"),
    (("com_xy", 161.4, ("LF", "RF", "LH"), "friction_cone", ("torso_yaw",)), {}, "com xy gives way by 161 as friction cone acts: LF, RF, …; torso yaw gives way too"),
    (("com_xy", 1.0, (), "", ("torso_yaw", "torso_height")), {}, "com xy gives way by 1; torso yaw and torso height give way too"),
    (("com_xy", 1.0, (), "", ("a", "b", "c")), {}, "com xy gives way by 1; 3 more levels give way too"),
    (("torso_yaw", 2.0, None, None, ("com_xy",)), {}, "torso yaw gives way by 2 between two hierarchies; com xy gives way too"),
]


def test_words_on_pictures_stay_inside_and_say_what_gave_way():
    frame = frame_at(0.0, 1.25, phases={"LF": "swing", "RF": "stance", "LH": "search", "RH": "unloading"})
    for frame.gave_way, units, told in SENTENCES:
        assert captions.sentence(frame, units) == told
    frame.stop = "encoder LF_KFE changed too fast"
    assert captions.sentence(frame, {}) == "the controller has stopped for safety: encoder LF_KFE changed too fast"
    header = {"level_names": ["com_xy"], "level_units": ["m/s²"]}
    blank = Image.new("RGB", (320, 240), "black")
    drawn = np.asarray(captions.Captions(240, header).draw(blank, frame, "a title that is much longer than such a small picture is wide, really", 2))
    lit = np.nonzero(drawn.sum(axis=2))
    assert lit[1].max() < 318 and lit[0].max() < 238 and lit[0].min() > 1


def test_words_that_are_too_long_for_a_line_go_on_in_the_next():
    assert captions.wrapped("torso height gives way to com", len, 12) == ["torso height", "gives way to", "com"]
    assert captions.wrapped("incomprehensibilities stay", len, 12) == ["incomprehensibilities", "stay"]
    assert captions.wrapped("short", len, 12) == ["short"]


def test_long_words_on_a_picture_have_letters_of_the_same_size_in_lines_that_stay_inside():
    def rows(title):
        """Of the picture, that have ink: of the title alone, as nothing else is drawn that far up."""
        drawn = np.asarray(captions.Captions(480, {"level_names": []}).draw(Image.new("RGB", (640, 480), "white"), frame_at(0.0, 1.0), title))
        assert (drawn[:, :8] == 255).all() and (drawn[:, -8:] == 255).all()
        dark = np.nonzero((drawn[:400] < 200).all(axis=2).any(axis=1))[0]
        return np.split(dark, np.nonzero(np.diff(dark) > 1)[0] + 1)

    short, long = rows("Hd"), rows(" ".join(40 * ["Hd"]))
    assert len(short) == 1 and len(long) > 2
    assert {len(line) for line in long} == {len(short[0])}


def test_what_a_picture_tells_of_another_tick_has_its_time():
    names = ("com_xy", 0.5, (), "", ())
    ticks = [frame_at(0.0, 0.1 * i) for i in range(30)]
    ticks[3].event, ticks[3].event_time = "LF: touchdown", 0.28
    ticks[5].gave_way = names
    shown = list(with_lasting_words(nearest(ticks, times_of(0.0, 2.9, 10, 1))))
    told = [[text for text, _ in captions.Captions(240, {"level_names": []})._texts(frame)] for frame in shown]
    assert told[2] == [] and told[3] == ["LF: touchdown (0.28 s)"] and told[13] == ["LF: touchdown (0.28 s)"] and told[29] == []
    assert told[5] == ["LF: touchdown (0.28 s)", "com xy gives way by 0.5"], "of the picture's own tick"
    assert told[8][1] == "com xy gives way by 0.5 (0.50 s)" and len(told[10]) == 1


def test_no_text_of_a_strip_lies_on_a_robot():
    words = captions.Captions(strip.TILE[1], {"level_names": [], "level_units": []}, strip.LETTERS)
    quiet, pushed = frame_at(0.0, 0.0), frame_at(0.0, 0.0)
    pushed.event, pushed.pushes = "pushed in a swing: foot down at once", [(1, np.array([250.0, 0, 0]), np.zeros(3))]
    pushed.gave_way = ("friction_cone", 2072.0, ("RH_KFE",), "torque_limits", ("motion",))
    assert strip.band_over([quiet, quiet], words) == 0
    over = strip.band_over([quiet, pushed], words)
    picture, _ = strip.make_strip(SimpleNamespace(frames=[pushed]), lambda _: Image.new("RGB", strip.TILE, (10, 20, 30)), words)
    assert over > 40 and picture.height == strip.ROWS * (strip.TILE[1] + over + strip.GAP) - strip.GAP
    tile = picture.crop((0, 0, strip.TILE[0], strip.TILE[1] + over))
    texts = np.abs(np.asarray(tile, int) - (10, 20, 30)).sum(axis=2).any(axis=1)
    assert texts[: over + strip.SKY].any() and not texts[over + strip.SKY : -80].any(), "between the texts at the top and the time"


def test_a_level_gives_way_from_the_residual_on_that_the_header_tells():
    header = {"level_names": ["limits", "com", "forces_minimisation"], "level_visible": [1e-6, 0.02, None]}
    levels = [{"name": "limits", "residual": 0.0}, {"name": "com", "residual": 0.01}, {"name": "forces_minimisation", "residual": 9.0}]
    active = [{"level": "limits", "row": "LF"}]
    assert gave_way({"levels": levels, "active": active}, header) is None
    levels[1]["residual"] = 0.03
    assert gave_way({"levels": levels, "active": active}, header) == ("com", 0.03, ("LF",), "limits", ())
    assert gave_way({"levels": levels, "active": []}, header) == ("com", 0.03, (), "", ())
    levels.append({"name": "torso", "residual": 1.0})
    header["level_visible"].append(0.05)
    header["level_names"].append("torso")
    assert gave_way({"levels": levels, "active": active}, header) == ("com", 0.03, ("LF",), "limits", ("torso",))
    assert gave_way({"levels": levels, "active": [*active, {"level": "torso", "row": "x"}]}, header)[2] == ("LF",), "of levels above alone"
    assert gave_way({"levels": levels, "active": active, "transition_share": 0.3}, header) == ("com", 0.03, None, None, ("torso",))
    levels[1]["residual"] = None
    assert gave_way({"levels": levels, "active": active}, header) == ("torso", 1.0, ("LF",), "limits", ())
    del header["level_visible"]
    levels[1]["residual"] = 0.01
    assert gave_way({"levels": levels, "active": active}, header)[0] == "com", "an older log"


def test_an_arrow_of_a_push_begins_in_the_line_of_its_force_and_a_leg_in_the_air_does_not_carry():
    held, force = np.array([0.3, 0.1, 0.0]), np.array([0.0, 50.0, 0.0])
    start, vector = overlays.push_arrow(np.zeros(3), force, np.cross(held, force))
    assert start == pytest.approx([0.3, 0.0, 0.0]) and vector / np.linalg.norm(vector) == pytest.approx([0, 1, 0])
    assert overlays.push_arrow(np.ones(3), force, np.array([0.0, 0.0, 500.0]))[0] == pytest.approx([1, 1, 1]), "no body is so large"
    frame = frame_at(0.0, 0.0, phases={"LF": "stance", "RF": "stance", "LH": "swing"})
    assert frame.carrying == ["LF", "RF"], "as planned, where the truth is not known"
    frame.p_SCom, frame.forces = np.zeros(3), [Touch("RF", np.zeros(3), np.array([0, 0, 90.0]), np.array([0, 0, 1.0]), 0.5)]
    assert frame.carrying == ["RF"]


def test_a_log_without_truth_is_drawn_with_what_it_knows():
    state = {"time": 1.0, "p_WB": [0, 0, 0.5], "q_WB": [1, 0, 0, 0], "q": [0.0] * 12}
    plan = {"feet": {leg: {"phase": "stance"} for leg in LEGS}}
    frame = frame_of({"/state": json.dumps(state).encode(), "/plan": json.dumps(plan).encode()}, {"level_names": []}, "")
    assert frame.carrying == list(LEGS)
    scene = mujoco.MjvScene(mujoco.MjModel.from_xml_string("<mujoco/>"), maxgeom=10)
    overlays.Overlays(scene, 0.03).draw(frame)
    assert scene.ngeom == 0
    assert [entity["id"] for entity in scene_entities(frame, 0.03, [])] == ["forces", "pushes", "support polygon"]


def test_of_a_solve_that_was_cut_off_nothing_is_told_of_the_level_that_it_was_in_and_those_below():
    header = {"level_names": ["limits", "com", "torso"], "level_visible": [0.5, 0.02, 0.05]}
    levels = [{"name": name, "residual": residual} for name, residual in (("limits", 0.0), ("com", 0.03), ("torso", 7.0))]
    tick = {"levels": levels, "active": [{"level": "limits", "row": "LF"}], "status": 1}
    told = {failed: gave_way(tick | {"failed_level": failed}, header) for failed in (0, 1, 2, 3, -1)}
    assert told[0] is None and told[1] is None
    assert told[2] == ("com", 0.03, ("LF",), "limits", ())
    assert told[3] == told[-1] == ("com", 0.03, ("LF",), "limits", ("torso",)), "only x is not the shortest"
    assert gave_way(tick | {"status": 2, "failed_level": -1}, header) is None, "nothing was solved"


def test_frames_tell_the_events_before_them_and_why_the_controller_has_stopped():
    events = [{"time": 0.1, "text": "lift-off", "leg": "RF", "by": "planner"}, {"time": 0.3, "text": "friction 0.6", "leg": None, "by": "operator"},
              {"time": 0.3, "text": "touchdown", "leg": "LH", "by": "planner"}, {"time": 0.3, "text": "caught", "leg": None, "by": "planner"},
              {"time": 0.5, "text": "command mode: damping, as encoder LF_KFE came late", "leg": None, "by": "controller"},
              {"time": 0.8, "text": "command mode: optimal", "leg": None, "by": "controller"}]  # fmt: skip
    maker = FrameMaker(SimpleNamespace(header={"level_names": []}, events=events), every=2)
    state = {"time": 1.0, "p_WB": [0, 0, 0.5], "q_WB": [1, 0, 0, 0], "q": [0.0] * 12}
    frames = [maker.frame([Message("/state", 100_000_000 * tick, json.dumps(state).encode())]) for tick in range(10)]
    assert [frame.event for frame in frames[::2]] == ["", "RF: lift-off", "LH: touchdown; caught", "", ""] and frames[1] is None
    assert [frame.event_time for frame in frames[::2]] == [None, 0.1, 0.3, None, None]
    assert [frame.stop for frame in frames[::2]] == ["", "", "", "encoder LF_KFE came late", ""]


def test_what_every_step_has_is_of_no_interest_whoever_does_it():
    assert all(moments.is_quiet(event) for event in ("", "lift-off", "LF: lift-off", "probe: same ground", "RH: probe: same ground", "LF: touchdown; LH: lift-off"))
    assert not any(moments.is_quiet(event) for event in ("LF: leg slides", "probe: edge, going beyond", "RH: probe: edge, going beyond", "LF: touchdown; RF: leg slides"))


def test_a_push_is_one_from_more_than_rounding_on():
    feet = {leg: {"touching": False} for leg in LEGS}
    truth = {"p_SCom": [0, 0, 0.5], "p_SF": dict.fromkeys(LEGS, [0, 0, 0]), "feet": feet}
    for newtons, pushes in [(0.0, 0), (3e-11, 0), (1e-5, 1)]:
        frame = frame_at(0.0, 0.0)
        add_truth(frame, {**truth, "xfrc_applied": [0.0] * 6 + [newtons, 0, 0, 0, 0, 0]})
        assert len(frame.pushes) == pushes, newtons
