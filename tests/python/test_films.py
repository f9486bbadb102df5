"""Films and strips of logs, made by the program of pictures."""

import io
import resource
import sys

import numpy as np
import pytest
from damaged_logs import cut, without_ticks
from log_tools import complaint_of, log_command
from pictures_made import cache, frames_of  # noqa: F401, fixtures

from surefoot_campaign.progress import Progress  # isort: skip
from surefoot_log import pictures  # isort: skip
from surefoot_log.log_file import LogFile  # isort: skip


def test_a_film_has_the_size_the_rate_and_the_length_that_were_asked_for_and_the_same_bytes_again(log, tmp_path):
    for file in (tmp_path / "a.mp4", tmp_path / "b.mp4"):
        done = log_command("video", log, "--out", file, "--size", "128x96", "--rate", "10", "--from", "0.5", "--to", "1.5", "--speed", "2")
        assert (done.returncode, done.stdout) == (0, f"{file}\n"), done.stderr
    images, rate = frames_of(file)
    assert (len(images), rate, images[0].shape) == (6, 10, (96, 128, 3))
    assert np.abs(images[0] - images[-1]).sum() > 0
    assert (tmp_path / "a.mp4").read_bytes() == file.read_bytes() and len(list(tmp_path.iterdir())) == 2


def test_a_film_may_begin_at_the_very_last_tick(log, tmp_path):
    done = log_command("video", log, "--out", tmp_path / "x.mp4", "--from", "1.9975", "--size", "96x64")
    assert done.returncode == 0 and len(frames_of(tmp_path / "x.mp4")[0]) == 1, done.stderr
    assert "to 1.9975 s" in complaint_of("video", log, "--out", tmp_path / "x.mp4", "--from", "1.9985")


def test_who_waits_for_a_film_sees_its_length_and_what_is_left_in_a_pipe_too(monkeypatch):
    clock, stream = [0.0], io.StringIO()
    monkeypatch.setattr("time.monotonic", lambda: clock[0])
    with Progress("film", 0, 400, "images", stream) as progress:
        progress.draw()
        for _ in range(400):
            clock[0] += 0.25
            progress.update()
    lines = stream.getvalue().splitlines()
    assert lines[:2] == ["film: 0 of 400 images", "film: 40 of 400 images, about 2 min left"]
    assert len(lines) == 11 and lines[-2:] == ["film: 360 of 400 images, about 10 s left", "film: 400 of 400 images"]


def test_a_log_that_was_cut_off_is_filmed_as_far_as_it_goes(log, tmp_path):
    done = log_command("video", cut(log, tmp_path, 0.5), "--out", tmp_path / "cut.mp4", "--size", "96x64", "--rate", "5")
    assert done.returncode == 0 and "the log is not whole" in done.stderr
    assert 2 <= len(frames_of(tmp_path / "cut.mp4")[0]) < 8


def test_wrong_arguments_are_said_and_leave_no_film(log, tmp_path):
    out = tmp_path / "a.mp4"
    assert "from 7 s; the log goes from 0 s to 1.9975 s" in complaint_of("video", log, "--out", out, "--from", "7")
    assert "no tick lies from 1 s to 0.5 s" in complaint_of("video", log, "--out", out, "--from", "1", "--to", "0.5")
    assert "127x96" in complaint_of("video", log, "--out", out, "--size", "127x96")
    for wrong in (("--from", "nan"), ("--to", "inf"), ("--rate", "1000000"), ("--rate", "0"), ("--from", "soon"), ("--speed", "2000")):
        assert f'"{wrong[1]}" is not a ' in complaint_of("video", log, "--out", out, *wrong)
    for name in ("a.avi", "a.webm", "a"):
        assert "a name that ends with .mp4 would be valid" in complaint_of("video", log, "--out", tmp_path / name)
    assert "there is no folder" in complaint_of("video", log, "--out", tmp_path / "no/a.mp4")
    assert "holds no tick" in complaint_of("video", without_ticks(log, tmp_path), "--out", out)
    assert "--out" in complaint_of("video", log)
    assert not out.exists() and not list(tmp_path.glob("*.partial"))


@pytest.mark.parametrize("room", [0, 3000])
def test_a_film_that_finds_no_room_is_told_in_a_line_and_the_one_before_stays(log, tmp_path, room):
    file = tmp_path / "a.mp4"
    file.write_bytes(b"the film before")
    done = log_command("video", log, "--out", file, "--size", "96x64", "--from", "1", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (room, room)))
    assert done.returncode == 2 and done.stderr.splitlines()[-1] == f"surefoot: {file}: can't be written: File too large"
    assert file.read_bytes() == b"the film before" and list(tmp_path.iterdir()) == [file]


@pytest.mark.parametrize(
    "file, text, helps",
    [
        # As OpenGL is where its library is missing.
        ("OpenGL/__init__.py", "raise AttributeError('no OSMesa')\n", "): `apt install libosmesa6`, or set MUJOCO_GL=egl where EGL works"),
        ("sitecustomize.py", "import sys\nsys.modules['OpenGL'] = None\n", f"): `{sys.executable} -m pip install PyOpenGL`"),
    ],
    ids=["library", "package"],
)
def test_where_nothing_can_render_it_is_said_what_installs_what_is_needed(log, tmp_path, monkeypatch, file, text, helps):
    (tmp_path / "OpenGL").mkdir()
    (tmp_path / file).write_text(text)
    monkeypatch.setenv("MUJOCO_GL", "osmesa")
    done = log_command("video", log, "--out", tmp_path / "a.mp4", before=tmp_path)
    assert done.returncode == 2 and done.stderr.endswith(f"{helps}\n") and len(done.stderr.splitlines()) == 1


@pytest.mark.slow
def test_the_strip_and_the_clip_of_a_report_are_small_and_show_something(log, tmp_path, monkeypatch, cache):
    from PIL import Image

    monkeypatch.setenv("SUREFOOT_MESH_CACHE", str(cache))
    made = pictures.make_report_pictures(LogFile(log), tmp_path)
    strip = Image.open(tmp_path / "strip.jpg")
    assert strip.width > 900 and len(made["times"]) == 8 and made["times"] == sorted(made["times"])
    assert np.asarray(strip, int).std() > 20
    assert (tmp_path / "strip.jpg").stat().st_size < 500_000 and (tmp_path / "clip.mp4").stat().st_size < 1_000_000
    assert frames_of(tmp_path / "clip.mp4")[1] == pictures.CLIP_RATE
