"""Pictures without a screen: the robot stands in them where the log says, with its meshes, and nothing else depends on them."""

import json
import os
import pathlib
import re
import stat
import subprocess
import sys

import numpy as np
import pytest
from conftest import SOURCE
from damaged_logs import cut, without_ticks
from log_file import attachment, messages
from log_tools import complaint_of, log_command
from program import PROGRAM

from surefoot_log import camera, captions, meshes, moments, overlays, pictures, urdf_visuals  # isort: skip
from surefoot_log.frames import Frame, Touch, gave_way, read_frames  # isort: skip
from surefoot_log.log_file import LogFile  # isort: skip
from surefoot_log.painter import painter  # isort: skip
from surefoot_log.scene import dress  # isort: skip

PACKAGES = pictures.packages_folder()
SIZE = (192, 144)


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    return os.environ.get("SUREFOOT_MESH_CACHE") or tmp_path_factory.mktemp("meshes")


@pytest.fixture(scope="module")
def run(log):
    return read_frames(LogFile(log), every=40)


def dressed(log, packages=PACKAGES, cache=None):
    return dress(attachment(log, "model.xml").decode(), attachment(log, "robot.urdf").decode(), packages, cache, SIZE, 0.02)


def painted(log, run, frames, packages=PACKAGES, cache=None):
    view = camera.Camera(run.frames)
    with painter(dressed(log, packages, cache), run.header, SIZE) as artist:
        return [np.asarray(artist.paint(frame, view), int) for frame in frames]


def frame_at(x, time, **parts):
    return Frame(time, [x, 0, 0.5, 1, 0, 0, 0] + [0.0] * 12, np.array([x, 0.0, 0.5]), **parts)


def test_frames_are_the_ticks_of_the_log(log, run):
    truths = messages(log, "/truth")[::40]
    assert [frame.time for frame in run.frames] == [truth["time"] for truth in truths]
    assert all(frame.qpos == truth["qpos"] for frame, truth in zip(run.frames, truths))
    assert run.has_truth


def test_an_event_between_two_frames_is_told_by_the_later_one(log, run):
    plans = messages(log, "/plan")
    names = run.header["event_names"]
    for i, frame in enumerate(run.frames[1:], 1):
        between = [names[plan["event"]] for plan in plans[40 * i - 39 : 40 * i + 1] if plan["event"]]
        assert frame.event == (between[-1] if between else "")
    assert any(frame.event for frame in run.frames)


def test_the_robot_is_drawn_where_it_is(log, run, cache):
    """Where it stands the picture is darker than where it does not; moved to the right, it is seen further right."""
    here = run.frames[0]
    there = Frame(here.time, [here.qpos[0] + 0.5, *here.qpos[1:]], here.p_WB)
    gone = Frame(here.time, [here.qpos[0] + 50.0, *here.qpos[1:]], here.p_WB)
    first, moved, empty = painted(log, run, [Frame(here.time, here.qpos, here.p_WB), there, gone], cache=cache)

    def column(image):
        dark = (empty.sum(axis=2) - image.sum(axis=2)) > 150
        assert dark.sum() > 0.02 * dark.size
        return np.nonzero(dark)[1].mean()

    assert abs(column(first) - SIZE[0] / 2) < 0.15 * SIZE[0]
    assert column(moved) > column(first) + 0.1 * SIZE[0]


def test_forces_and_the_support_polygon_are_drawn_over_it(log, run, cache):
    frame = run.frames[5]
    bare = Frame(frame.time, frame.qpos, frame.p_WB)
    pushed = Frame(frame.time, frame.qpos, frame.p_WB, pushes=[(1, np.array([0.0, 0.0, -120.0]))])
    plain, full, push = painted(log, run, [bare, frame, pushed], cache=cache)
    green = (full[..., 1] - full[..., 0]) - (plain[..., 1] - plain[..., 0]) > 15
    assert green.sum() > 40
    assert (np.abs(push - plain).sum(axis=2) > 60).sum() > 15


def test_a_mesh_that_is_missing_is_noted_and_the_physics_shape_stands_for_it(log, run, tmp_path, cache):
    scene = dressed(log, packages=tmp_path)
    assert len(scene.notes) > 10 and all("is shown as the physics has it" in note and "No such file" in note for note in scene.notes)
    here = run.frames[0]
    gone = Frame(here.time, [here.qpos[0] + 50.0, *here.qpos[1:]], here.p_WB)
    shown, empty = painted(log, run, [here, gone], packages=tmp_path)
    assert ((empty - shown).sum(axis=2) > 100).sum() > 0.02 * SIZE[0] * SIZE[1]
    assert dressed(log, cache=cache).notes == []


def test_thinned_meshes_keep_their_size_and_colours(cache):
    urdf = (pathlib.Path(PACKAGES) / "example-robot-data/robots/anymal_b_simple_description/robots/anymal.urdf").read_text()
    files = {urdf_visuals.file_of(visual.mesh, PACKAGES) for visual in urdf_visuals.visuals_of(urdf) if visual.mesh}
    assert len(files) >= 6
    for file in files:
        fine, coarse = meshes.load(file, cache, 0.008), meshes.load(file, cache, 0.02)
        assert {part.colour for part in fine} >= {part.colour for part in coarse}
        span = [np.ptp(np.vstack([part.vertices for part in parts]), axis=0) for parts in (fine, coarse)]
        assert span[0] == pytest.approx(span[1], abs=0.02)
        assert sum(len(part.faces) for part in coarse) < sum(len(part.faces) for part in fine)


def test_a_push_on_a_leg_is_drawn_at_that_leg(log, run, cache):
    frame = run.frames[5]
    bare = Frame(frame.time, frame.qpos, frame.p_WB)
    pushed = [Frame(frame.time, frame.qpos, frame.p_WB, pushes=[(body, np.array([0.0, 0.0, -120.0]))]) for body in (1, 4)]
    plain, base, leg = painted(log, run, [bare, *pushed], cache=cache)
    places = [np.nonzero(np.abs(image - plain).sum(axis=2) > 60) for image in (base, leg)]
    assert abs(places[0][1].mean() - places[1][1].mean()) + abs(places[0][0].mean() - places[1][0].mean()) > 4


def test_a_level_gives_way_from_the_residual_on_that_the_header_tells():
    header = {"level_names": ["com", "forces_minimisation"], "level_visible": [0.02, None]}
    levels = [{"name": "com", "residual": 0.01}, {"name": "forces_minimisation", "residual": 9.0}]
    rows = [{"level": "com", "row": "LF", "by": "limits"}]
    assert gave_way({"levels": levels, "blocked_by": rows}, header) is None
    levels[0]["residual"] = 0.03
    assert gave_way({"levels": levels, "blocked_by": rows}, header) == ("com", 0.03, "LF", "limits")
    del header["level_visible"]
    levels[0]["residual"] = 0.01
    assert gave_way({"levels": levels, "blocked_by": rows}, header)[0] == "com", "an older log"


@pytest.mark.parametrize("uri", ["file:///etc/passwd", "/etc/passwd", "package://../x.dae", "package://a/../../x.dae", "package:///etc/x.dae", "x.dae", "package://."])
def test_meshes_lie_below_the_folder_of_packages(uri, tmp_path):
    with pytest.raises(ValueError, match="folder of packages"):
        urdf_visuals.file_of(uri, tmp_path)
    assert urdf_visuals.file_of("package://a/b/../c.dae", tmp_path) == tmp_path / "a" / "c.dae"


def test_images_lie_there_too(tmp_path):
    assert meshes.image_file(tmp_path / "a" / "meshes", "../images/x.png", tmp_path) == str(tmp_path / "a" / "images" / "x.png")
    assert meshes.image_file(tmp_path / "a", "../../x.png", tmp_path) == ""
    assert meshes.image_file(tmp_path / "a", "/etc/x.png", tmp_path) == ""


def test_a_broken_cache_is_read_anew(tmp_path):
    file = tmp_path / "square.obj"
    file.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
    first = meshes.load(file, tmp_path / "cache")
    (kept,) = (tmp_path / "cache").iterdir()
    for broken in (b"", b"PK\x03\x04 no zip", kept.read_bytes()[:-40]):
        kept.write_bytes(broken)
        again = meshes.load(file, tmp_path / "cache")
        assert np.array_equal(again[0].vertices, first[0].vertices)
    assert [path.suffix for path in (tmp_path / "cache").iterdir()] == [".npz"], "nothing partial is left"


def test_the_cache_gives_the_same_parts(tmp_path):
    file = tmp_path / "square.obj"
    file.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
    first, again = meshes.load(file, tmp_path / "cache"), meshes.load(file, tmp_path / "cache")
    assert len(list((tmp_path / "cache").glob("*.npz"))) == 1
    assert len(first[0].faces) == 2
    assert np.array_equal(first[0].vertices, again[0].vertices) and np.array_equal(first[0].faces, again[0].faces)
    file.write_text("v 0 0 0\nv 2 0 0\nv 1 1 0\nf 1 2 3\n")
    assert meshes.load(file, tmp_path / "cache")[0].vertices.max() == 2.0


def test_points_of_a_cell_become_one_and_flat_triangles_go():
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.001, 0, 0], [1, 0.001, 0]], float)
    merged, faces, _ = meshes.merged(vertices, np.array([[0, 1, 2], [3, 4, 2], [0, 3, 2]]), None, 0.01)
    assert len(merged) == 3 and len(faces) == 1


def test_links_without_a_body_are_carried_by_the_one_that_they_are_fixed_to():
    urdf = """<robot name="r"><link name="a"/><link name="b"/><link name="c"/><joint name="j" type="fixed"><parent link="a"/>
      <child link="b"/><origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/></joint><joint name="k" type="fixed"><parent link="b"/>
      <child link="c"/><origin xyz="1 0 0"/></joint></robot>"""
    found = urdf_visuals.links_below_bodies(urdf, {"a": None})
    assert {link: body for link, (body, _) in found.items()} == {"a": "a", "b": "a", "c": "a"}
    assert found["c"][1][:3, 3] == pytest.approx([1.0, 1.0, 0.0])


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
    frame.gave_way = ("com_xy", 0.314, "LF_KFE", "torque_limits")
    assert captions.sentence(frame, {"com_xy": "m/s²"}) == "com xy gives way by 0.31 m/s² to torque limits LF_KFE"
    frame.gave_way = ("com_xy", 161.4, "LF_KFE", "torque_limits")
    assert captions.sentence(frame, {}) == "com xy gives way by 161 to torque limits LF_KFE"
    from PIL import Image

    header = {"level_names": ["com_xy"], "level_units": ["m/s²"]}
    blank = Image.new("RGB", (320, 240), "black")
    drawn = np.asarray(captions.Captions(240, header).draw(blank, frame, "a title that is much longer than such a small picture is wide, really", 2))
    lit = np.nonzero(drawn.sum(axis=2))
    assert lit[1].max() < 318 and lit[0].max() < 238 and lit[0].min() > 1


def frames_of(file):
    import av

    with av.open(str(file)) as container:
        stream = container.streams.video[0]
        return [np.asarray(frame.to_image(), int) for frame in container.decode(stream)], stream.average_rate


def test_a_film_has_the_size_the_rate_and_the_length_that_were_asked_for(log, tmp_path):
    file = tmp_path / "run.mp4"
    done = log_command("video", log, "--out", file, "--size", "128x96", "--rate", "10", "--from", "0.5", "--to", "1.5", "--speed", "2")
    assert (done.returncode, done.stdout) == (0, f"{file}\n"), done.stderr
    images, rate = frames_of(file)
    assert (len(images), rate, images[0].shape) == (6, 10, (96, 128, 3))
    assert np.abs(images[0] - images[-1]).sum() > 0
    assert list(tmp_path.iterdir()) == [file]


def test_a_film_is_the_same_bytes_again(log, tmp_path):
    arguments = ["--size", "96x64", "--rate", "5", "--from", "1"]
    for name in ("a.mp4", "b.mp4"):
        assert log_command("video", log, "--out", tmp_path / name, *arguments).returncode == 0
    assert (tmp_path / "a.mp4").read_bytes() == (tmp_path / "b.mp4").read_bytes()


def test_a_log_that_was_cut_off_is_filmed_as_far_as_it_goes(log, tmp_path):
    done = log_command("video", cut(log, tmp_path, 0.5), "--out", tmp_path / "cut.mp4", "--size", "96x64", "--rate", "5")
    assert done.returncode == 0 and "the log is not whole" in done.stderr
    assert 2 <= len(frames_of(tmp_path / "cut.mp4")[0]) < 8


def test_wrong_arguments_are_said_and_leave_no_film(log, tmp_path):
    out = tmp_path / "a.mp4"
    assert "--from 7; the log goes from 0 s to 1.98" in complaint_of("video", log, "--out", out, "--from", "7")
    assert "no tick lies in --from 1 --to 0.5" in complaint_of("video", log, "--out", out, "--from", "1", "--to", "0.5")
    assert "127x96" in complaint_of("video", log, "--out", out, "--size", "127x96")
    for name in ("a.avi", "a.webm", "a"):
        assert "a name that ends with .mp4 would be valid" in complaint_of("video", log, "--out", tmp_path / name)
    assert "there is no folder" in complaint_of("video", log, "--out", tmp_path / "no/a.mp4")
    assert "holds no tick" in complaint_of("video", without_ticks(log, tmp_path), "--out", out)
    assert "--out" in complaint_of("video", log)
    assert not out.exists() and not list(tmp_path.glob("*.partial"))


@pytest.fixture
def fake_python(tmp_path):
    """In the place of the Python that makes pictures; does as it is told."""

    def made(script):
        path = tmp_path / "python"
        path.write_text(f"#!/bin/sh\n{script}\n")
        path.chmod(path.stat().st_mode | stat.S_IEXEC)
        return path

    return made


def program(*arguments, python=None):
    environment = {key: value for key, value in os.environ.items() if key != "SUREFOOT_PYTHON"}
    if python is not None:
        environment["SUREFOOT_PYTHON"] = str(python)
    return subprocess.run([PROGRAM, *map(str, arguments)], env=environment, capture_output=True, text=True, timeout=300)


SPEAKS = """echo '{"times": [1.5], "span": {"first": 1, "last": 2}, "notes": ["a note"]}'"""


def test_a_report_holds_the_pictures_that_were_made(log, tmp_path, fake_python):
    python = fake_python(f'printf strip > "$5/strip.jpg"; printf clip > "$5/clip.mp4"; {SPEAKS}')
    done = program("report", log, "--out", tmp_path / "out", python=python)
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "out/index.html").read_text()
    assert "data:image/jpeg;base64,c3RyaXA=" in page and "data:video/mp4;base64,Y2xpcA==" in page
    assert "a note" in page and "No pictures" not in page


@pytest.mark.parametrize("script, words", {
    "echo 'surefoot: no renderer here' >&2; exit 2": "no renderer here",
    "exit 7": "their program ended with 7",
    "kill -9 $$": "their program ended with -1",
    "echo nonsense": "parse error",
}.items())  # fmt: skip
def test_a_report_without_pictures_is_whole_and_says_why(log, tmp_path, fake_python, script, words):
    done = program("report", log, "--out", tmp_path / "out", python=fake_python(script))
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "out/index.html").read_text()
    assert re.search(f"No pictures: [^<]*{words}", page) and "<h2>Numbers</h2>" in page


def test_without_the_launcher_the_report_says_who_makes_pictures(log, tmp_path):
    assert program("report", log, "--out", tmp_path / "out").returncode == 0
    assert "No pictures: the program was started without its launcher" in (tmp_path / "out/index.html").read_text()


SHORT = ["run", SOURCE / "scenarios/walk_flat_ideal.yaml", "--set", "duration=0.1", "--json"]


def test_a_run_is_filmed_and_its_result_is_the_same(tmp_path, fake_python):
    python = fake_python(f'[ "$3" = video ] && cp "$4" "{tmp_path}/seen.mcap" && printf film > "$6"')
    plain, filmed = program(*SHORT), program(*SHORT, "--video", tmp_path / "run.mp4", python=python)
    assert filmed.returncode == plain.returncode and (tmp_path / "run.mp4").read_text() == "film"
    by_clock = {"tick_us", "solve_us", "realtime_factor"}
    results = [{key: value for key, value in json.loads(text).items() if key not in by_clock} for text in (plain.stdout, filmed.stdout)]
    assert results[0] == results[1]
    assert json.loads(attachment(tmp_path / "seen.mcap", "header.json"))["scenario"] == "walk_flat_ideal"


def test_a_film_that_fails_changes_no_exit_code(tmp_path, fake_python):
    failed = program(*SHORT, "--video", tmp_path / "run.mp4", python=fake_python("exit 2"))
    assert failed.returncode == program(*SHORT).returncode and json.loads(failed.stdout)["scenario"] == "walk_flat_ideal"
    assert "run.mp4 was not filmed" in failed.stderr


def test_a_film_that_can_not_be_made_is_told_before_the_run(tmp_path):
    done = program(*SHORT, "--video", tmp_path / "run.mp4")
    assert (done.returncode, done.stdout) == (2, "") and "started without its launcher" in done.stderr
    done = program(*SHORT, "--video", tmp_path / "no/run.mp4", python=sys.executable)
    assert done.returncode == 2 and "there is no folder" in done.stderr
    done = program(*SHORT, "--video", tmp_path / "run.avi", python=sys.executable)
    assert done.returncode == 2 and "run.avi: films are written as MP4" in done.stderr and not list(tmp_path.iterdir())


def test_seeds_have_a_film_each(tmp_path, fake_python):
    python = fake_python('printf film > "$6"')
    done = program(*SHORT, "--seeds", "2", "--video", tmp_path / "run.mp4", python=python)
    assert done.returncode in (0, 1), done.stderr
    assert sorted(path.name for path in tmp_path.glob("*.mp4")) == ["run-seed1.mp4", "run-seed2.mp4"]
    assert not list(tmp_path.glob("*.mcap"))


@pytest.mark.slow
def test_the_strip_and_the_clip_of_a_report_are_small_and_show_something(log, tmp_path, monkeypatch, cache):
    from PIL import Image

    monkeypatch.setenv("SUREFOOT_MESH_CACHE", str(cache))
    made = pictures.make_report_pictures(LogFile(log), tmp_path)
    strip = Image.open(tmp_path / "strip.jpg")
    assert strip.width > 900 and len(made.times) == 8 and made.times == sorted(made.times)
    assert np.asarray(strip, int).std() > 20
    assert (tmp_path / "strip.jpg").stat().st_size < 500_000 and (tmp_path / "clip.mp4").stat().st_size < 1_000_000
    assert frames_of(tmp_path / "clip.mp4")[1] == pictures.CLIP_RATE


def test_where_nothing_can_render_it_is_said_what_is_needed(log, tmp_path):
    """A package of that name that is broken, as OpenGL is where its library is missing."""
    (tmp_path / "OpenGL").mkdir()
    (tmp_path / "OpenGL/__init__.py").write_text("raise AttributeError('no OSMesa')\n")
    environment = {**os.environ, "PYTHONPATH": f"{tmp_path}:{SOURCE / 'python'}:{os.environ.get('PYTHONPATH', '')}", "MUJOCO_GL": "osmesa"}
    command = [sys.executable, "-m", "surefoot_log", "video", log, "--out", tmp_path / "a.mp4"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.returncode == 2 and "libosmesa6" in done.stderr and len(done.stderr.splitlines()) == 1
