"""Frames of a run as images, rendered without a screen."""

import contextlib

import numpy as np
from PIL import Image

from surefoot_log.offscreen import mujoco, renderer
from surefoot_log.overlays import Overlays
from surefoot_log.push_arrows import draw_pushes

SUN = np.array([-0.7, -1.4, 3.2])  # m from what is looked at
SHOWN_GROUPS = (0, 1, 2, 3)


class Painter:
    """Holds a rendering context; to be closed."""

    def __init__(self, scene, foot_radius, size):
        self._model = scene.model
        self._data = mujoco.MjData(scene.model)
        self._options = mujoco.MjvOption()
        self._options.geomgroup[:] = [group in SHOWN_GROUPS for group in range(len(self._options.geomgroup))]
        width, height = size
        self._renderer = renderer(scene.model, height, width)
        self._overlays = Overlays(self._renderer.scene, foot_radius)
        self._sun = mujoco.mj_name2id(scene.model, mujoco.mjtObj.mjOBJ_LIGHT, "sun")

    def paint(self, frame, camera):
        data, (point, view) = self._data, camera.at(frame.time)
        data.qpos[: len(frame.qpos)] = frame.qpos
        mujoco.mj_kinematics(self._model, data)
        mujoco.mj_comPos(self._model, data)
        mujoco.mj_camlight(self._model, data)
        data.light_xpos[self._sun] = point + SUN
        self._renderer.update_scene(data, view, self._options)
        self._overlays.draw(frame)
        image = Image.fromarray(self._renderer.render())
        return draw_pushes(image, frame.pushes, data.xipos, self._renderer.scene.camera) if frame.pushes else image

    def close(self):
        self._renderer.close()


def painter(scene, header, size):
    return contextlib.closing(Painter(scene, header["robot"]["foot_radius"] or 0.03, size))
