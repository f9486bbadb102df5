import os as _os
from typing import TYPE_CHECKING as _TYPE_CHECKING

import surefoot_installation as _installation

try:
    import surefoot._core
except ImportError as error:
    raise ImportError(_installation.trouble() or str(error)) from error
if _trouble := _installation.two_versions():
    raise ImportError(_trouble)

from surefoot._core import *
from surefoot._core import __doc__ as __doc__
from surefoot._core import __version__ as __version__

if _TYPE_CHECKING:
    from surefoot_log.recorded import Recorded


def read(path: "str | _os.PathLike[str]") -> "Recorded":
    """Reads the log of a run: `read("run.mcap")["state.p_WB.x"]` is a NumPy array."""
    from surefoot_campaign.errors import InputError
    from surefoot_log.recorded import Recorded

    try:
        return Recorded(path)
    except InputError as error:
        raise Error(str(error)) from None
