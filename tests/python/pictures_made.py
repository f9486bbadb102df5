"""Pictures of a log as tests make them: small, and with what is in them as numbers."""

import os

import numpy as np
import pytest
from log_file import attachment

from surefoot_log import camera, pictures  # isort: skip
from surefoot_log.frames import Frame, read_frames  # isort: skip
from surefoot_log.log_file import LogFile  # isort: skip
from surefoot_log.painter import painter  # isort: skip
from surefoot_log.scene import dress  # isort: skip

PACKAGES = pictures.package_folders()
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


def frames_of(file):
    import av

    with av.open(str(file)) as container:
        stream = container.streams.video[0]
        return [np.asarray(frame.to_image(), int) for frame in container.decode(stream)], stream.average_rate
