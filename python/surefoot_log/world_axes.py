"""Plots: an axis of matplotlib has the world of what is drawn along it, and takes nothing of the other."""

import numpy as np
from matplotlib import units

from surefoot_log.worlds import ADVICE, InWorld, WorldError


class WorldOfAxis(units.ConversionInterface):
    @staticmethod
    def default_units(x, axis):
        world = getattr(x, "world", "") or None
        if world and axis.units not in (None, world):
            raise WorldError(f"this axis has numbers in {axis.units}, and these are in {world}: the controller's world W and the simulator's S lie elsewhere; {ADVICE}")
        return world

    @staticmethod
    def convert(value, unit, axis):
        return np.asarray(value)

    @staticmethod
    def axisinfo(unit, axis):
        return units.AxisInfo(label=f"in {unit}") if unit in ("W", "S") else None


units.registry[InWorld] = WorldOfAxis()
