"""MuJoCo, set to render in software, without a screen."""

import importlib.util
import os
import sys

from surefoot_campaign.errors import InputError

os.environ.setdefault("MUJOCO_GL", "osmesa")


def remedy():
    missing = [package for module, package in (("mujoco", "mujoco-core"), ("OpenGL", "PyOpenGL")) if not importlib.util.find_spec(module)]
    return f"`{sys.executable} -m pip install {' '.join(missing)}`" if missing else "`apt install libosmesa6`, or set MUJOCO_GL=egl where EGL works"


def unable(error):
    return InputError(f"MuJoCo can't render without a screen here ({' '.join(str(error).split())}): {remedy()}")


try:
    import mujoco
except (ImportError, AttributeError, OSError) as error:
    raise unable(error) from None


def renderer(model, height, width):
    """MuJoCo tells only here that a package is missing."""
    try:
        return mujoco.Renderer(model, height, width)
    except ImportError as error:
        raise unable(error) from None


__all__ = ["mujoco", "renderer"]
