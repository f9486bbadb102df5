"""MuJoCo, set to render in software, without a screen."""

import os

from surefoot_campaign.errors import InputError

os.environ.setdefault("MUJOCO_GL", "osmesa")

try:
    import mujoco
except (ImportError, AttributeError, OSError) as error:
    raise InputError(f"MuJoCo can't render without a screen here ({' '.join(str(error).split())}): the Debian package libosmesa6 "
                     "(`apt install libosmesa6`) and the Python packages of dependencies/python.txt are needed") from None  # fmt: skip

__all__ = ["mujoco"]
