"""MuJoCo, told before its import to render in software, without a screen."""

import os

os.environ.setdefault("MUJOCO_GL", "osmesa")

import mujoco  # noqa: E402

__all__ = ["mujoco"]
