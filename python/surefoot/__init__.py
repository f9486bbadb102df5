"""Whole-body control of legged robots by strict task hierarchies.

The loop, at 400 Hz:

    scenario = surefoot.load_scenario("walk_flat")
    plant = surefoot.Plant(scenario)
    controller = surefoot.Controller(scenario, plant)
    while plant.time < scenario.duration:
        plant.write(controller.step(plant.read(), scenario.user(plant.time)))

Where to look: Robot and doctor (robots, dynamics), Stack and tasks (hierarchies), Controller (with or without a Plant), run, campaign and
Evaluator (how good it was), read (logs), explain (why), solve (a hierarchy by itself).

Units are SI. Frames stand in the names: p_WB is the position of the base B in the controller's world W, p_SB the true one in the simulator's
world S. Arrays look into the object that they come from; objects are snapshots and don't change."""

import os as _os
import pathlib as _pathlib
from typing import TYPE_CHECKING as _TYPE_CHECKING

import surefoot_installation as _installation

try:
    import surefoot._core as _compiled
except ImportError as error:
    raise ImportError(_installation.trouble() or str(error)) from error
if _trouble := _installation.two_versions():
    raise ImportError(_trouble)

from surefoot import _arguments as _arguments
from surefoot import _copies as _copies
from surefoot import _derived as _derived
from surefoot import _errors as _errors
from surefoot import _named as _named
from surefoot import _printed as _printed
from surefoot import _worlds as _worlds

_errors.tell()
_worlds.tell()
_arguments.tell()
_worlds.tell_of_arguments()
_derived.tell()
_named.tell()
_printed.tell()
_copies.tell()

from surefoot._core import *
from surefoot import tasks as tasks
from surefoot._worlds import WorldError as WorldError
from surefoot.control import Controller as Controller
from surefoot.control import load_scenario as load_scenario
from surefoot.running import Campaign as Campaign
from surefoot.running import campaign as campaign
from surefoot.running import run as run
from surefoot.stack import StackLevel as StackLevel
from surefoot.stack import Stack as Stack
from surefoot.task import OwnTask as OwnTask
from surefoot.task import Task as Task
from surefoot.task import catalog as catalog
from surefoot.task import check_task as check_task
from surefoot.task import register_task as register_task

if _TYPE_CHECKING:
    from surefoot_log.recorded import Recorded as Recorded


__version__: str = getattr(_compiled, "__version__")


def _find_program() -> None:
    """Logs and campaigns need the program: that of the wheel, or of the build that this module belongs to."""
    here = _pathlib.Path(__file__).absolute().parent
    for program in (here / "bin/surefoot", here.parents[1] / "bin/surefoot"):
        if program.is_file():
            _os.environ.setdefault("SUREFOOT_PROGRAM", str(program))


@_arguments.checked
def read(path: "str | _os.PathLike[str]") -> "Recorded":
    """Reads the log of a run: `read("run.mcap")["state.p_WB.x"]` is a NumPy array. A topic is read when something of it is asked for."""
    with _errors.told_as_error():
        return __getattr__("Recorded")(path)  # type: ignore[no-any-return]


def __getattr__(name: str) -> type:
    """What logs need is loaded when one is read."""
    if name != "Recorded":
        raise AttributeError(f"module 'surefoot' has no attribute {name!r}")
    from surefoot_log.recorded import Recorded

    return _arguments.checked(Recorded)


# What the package's own Python calls of its compiled part is not for its users.
_INTERNAL = ("ControllerBase", "compare_made_stack", "compare_stack", "parse_stack", "read_scenario", "run_scenario", "stack_levels", "stack_name", "try_task", "verify_log")
for _name in _INTERNAL:
    globals().pop(_name, None)
__all__ = ["tasks", "Recorded"] + [name for name, thing in globals().items() if name[0] != "_" and not isinstance(thing, type(_os))]


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


_find_program()
