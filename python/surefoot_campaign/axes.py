"""What a figure has along an axis: the values of a parameter of the grid, or bins of one that is drawn."""

from dataclasses import dataclass

from surefoot_campaign.program import yaml_text
from surefoot_campaign.spec import CASE
from surefoot_campaign.statistics import is_number
from surefoot_campaign.units import label, unit_of_parameter

SEEDS_A_BIN = 10  # points of a grid share their draws: more of them fill no bin better
MAX_BINS = 8


@dataclass
class Axis:
    parameter: str
    label: str
    ticks: list  # a text for each cell
    places: list  # a number for each cell
    drawn: bool
    is_choice: bool  # between values that have no distance
    of: object  # value -> number of its cell
    span: tuple = None  # from the first cell's begin to the last one's end; None where cells have no width

    @property
    def width(self):
        """The width of a cell."""
        return (self.span[1] - self.span[0]) / len(self.ticks) if self.span else 0.0

    def cells(self, records):
        """The records of each cell."""
        cells = [[] for _ in self.ticks]
        for record in records:
            cells[self.of(record.run.value(self.parameter))].append(record)
        return cells


def number_text(value):
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def choice_axis(parameter, text, ticks, of):
    return Axis(parameter, text, ticks, list(range(len(ticks))), False, True, of, (-0.5, len(ticks) - 0.5))


def grid_axis(parameter, values, text):
    if all(is_number(value) for value in values):
        values = sorted(values)
        return Axis(parameter, text, [number_text(value) for value in values], values, False, False, values.index)
    return choice_axis(parameter, text, [yaml_text(value) for value in values], values.index)


def drawn_axis(parameter, range_, text, seeds):
    count = max(2, min(MAX_BINS, seeds // SEEDS_A_BIN))
    width = (range_.upper - range_.lower) / count
    edges = [range_.lower + width * number for number in range(count)] + [range_.upper]
    ticks = [f"{low:.3g} … {high:.3g}" for low, high in zip(edges, edges[1:])]
    places = [(low + high) / 2 for low, high in zip(edges, edges[1:])]

    def cell_of(value):
        return min(count - 1, int((value - range_.lower) / width))

    return Axis(parameter, text, ticks, places, True, False, cell_of, (range_.lower, range_.upper))


def axis_of(spec, parameter):
    if parameter == CASE:
        names = list(spec.cases)
        return choice_axis(CASE, CASE, names, names.index)
    text = label(parameter, unit_of_parameter(parameter, spec))
    if parameter in spec.grid:
        return grid_axis(parameter, spec.grid[parameter], text)
    return drawn_axis(parameter, spec.draw[parameter], text, len(spec.seeds))
