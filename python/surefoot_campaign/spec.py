"""The file that says what a campaign runs. A complaint names file, line and key."""

import itertools
import math
import os
import pathlib
import re
from dataclasses import dataclass, field

from surefoot_campaign.errors import InputError, valid_names
from surefoot_campaign.program import MAX_SEED, yaml_text
from surefoot_campaign.statistics import is_number
from surefoot_campaign.yaml_tree import read_yaml

KEYS = ["name", "scenario", "seeds", "cases", "grid", "draw", "set", "timeout", "judge", "units"]
CASE = "case"  # what tables and figures call the column of `cases:`
TIMEOUT = 600.0  # s
RANDOMISE = "randomise."
LEAST_TIMEOUT = 1.0  # s; no program begins in less
JUDGE = "com_error_max_m"
MOST_SEEDS = 1_000_000  # of a campaign: each is a run, and stands in its table


@dataclass(frozen=True)
class Range:
    lower: float
    upper: float


@dataclass
class Spec:
    path: pathlib.Path
    name: str
    scenarios: list  # as written
    seeds: list
    cases: dict = field(default_factory=dict)  # name -> {parameter: value}; the first is what the others are compared with
    grid: dict = field(default_factory=dict)  # parameter -> values
    draw: dict = field(default_factory=dict)  # parameter -> Range
    fixed: dict = field(default_factory=dict)  # parameter -> value; `set:` of the file
    timeout: float = TIMEOUT
    judge: str = JUDGE
    units: dict = field(default_factory=dict)  # parameter -> unit
    lines: dict = field(default_factory=dict)  # parameter, key or (case, parameter) -> line in the file

    def parameters(self):
        """Every parameter, in the order of the file: those that vary first. Those of cases need not be in every run."""
        of_cases = dict.fromkeys(name for values in self.cases.values() for name in values)
        return [*of_cases, *self.grid, *self.draw, *self.fixed]

    def values(self):
        """Every parameter with the values that the file gives it."""
        of_cases = [(name, [value]) for case in self.cases.values() for name, value in case.items()]
        return [*of_cases, *self.grid.items(), *((name, [value]) for name, value in self.fixed.items())]

    def varied(self):
        """Those that take more than one value, the case among them."""
        of_grid = [name for name, values in self.grid.items() if len(values) > 1]
        return [CASE] * bool(self.cases) + of_grid + list(self.draw)

    def where(self, key):
        return f"{self.path}:{self.lines[key]}" if key in self.lines else str(self.path)


class Reader:
    """Takes the tree apart; every complaint names file, line and key."""

    def __init__(self, path):
        self.path = path
        self.tree = read_yaml(path)
        self.lines = {key: node.line for key, node in self.tree.value.items()}

    def fail(self, line, key, message):
        raise InputError(f"{self.path}:{line}: {key}: {message}")

    def read(self):
        for key, node in self.tree.value.items():
            if key not in KEYS:
                self.fail(node.line, key, f"unknown key; {valid_names(key, KEYS)}")
        for key in ("scenario", "seeds"):
            if key not in self.tree.value:
                self.fail(self.tree.line, key, "this key is missing")
        spec = Spec(
            path=self.path,
            name=self.name(),
            scenarios=self.scenarios(),
            seeds=self.seeds(),
            cases=self.cases(),
            grid={key: self.values("grid." + key, node) for key, node in self.map("grid").items()},
            draw={key: self.range("draw." + key, node) for key, node in self.map("draw").items()},
            fixed={key: self.plain("set." + key, node) for key, node in self.map("set").items()},
            units={key: self.word("units." + key, node) for key, node in self.map("units").items()},
            lines=self.lines,
        )
        if "timeout" in self.tree.value:
            spec.timeout = self.number("timeout", self.tree.value["timeout"])
            if spec.timeout < LEAST_TIMEOUT:
                self.fail(self.lines["timeout"], "timeout", f"{spec.timeout:g} is not a number of at least {LEAST_TIMEOUT:g} s")
        if "judge" in self.tree.value:
            spec.judge = self.word("judge", self.tree.value["judge"])
        self.check_parameters(spec)
        return spec

    def map(self, key):
        node = self.tree.value.get(key)
        if node is None:
            return {}
        if not isinstance(node.value, dict):
            self.fail(node.line, key, "must be a map, `path.to.key: …`")
        if not node.value:
            self.fail(node.line, key, "is empty; leave it out, or name a parameter")
        for name, entry in node.value.items():
            if key != "units":
                if name in self.lines:
                    message = f"this parameter stands at line {self.lines[name]} already; once is valid, in cases, grid, draw or set"
                    self.fail(entry.line, f"{key}.{name}", message)
                self.lines[name] = entry.line
        return node.value

    def cases(self):
        """Maps of values by name. A parameter may stand in several of them, but nowhere else."""
        node = self.tree.value.get("cases")
        if node is None:
            return {}
        if not isinstance(node.value, dict) or len(node.value) < 2:
            self.fail(node.line, "cases", "must be a map of at least two cases, `name: {path.to.key: value}`; {} changes nothing")
        cases = {}
        for name, entry in node.value.items():
            if not isinstance(entry.value, dict):
                self.fail(entry.line, f"cases.{name}", "must be a map, {path.to.key: value}; {} changes nothing")
            cases[name] = {key: self.plain(f"cases.{name}.{key}", value) for key, value in entry.value.items()}
            if cases[name] in list(cases.values())[:-1]:
                self.fail(entry.line, f"cases.{name}", "another case has the same values")
            for key, value in entry.value.items():
                self.lines[key] = self.lines[name, key] = value.line
        return cases

    def name(self):
        if "name" not in self.tree.value:
            return self.path.stem
        node = self.tree.value["name"]
        name = self.word("name", node)
        if not re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9_.-]*", name):
            self.fail(node.line, "name", f'"{name}" is no name for a folder: letters, digits, _ - and . are valid')
        return name

    def scenarios(self):
        node = self.tree.value["scenario"]
        items = node.value if isinstance(node.value, list) else [node]
        if not items:
            self.fail(node.line, "scenario", "the list is empty; at least one scenario is needed")
        names = [self.word("scenario", item) for item in items]
        self.refuse_twice("scenario", items, names)
        return names

    def seeds(self):
        node = self.tree.value["seeds"]
        if isinstance(node.value, list):
            seeds = [self.whole("seeds", item, 0) for item in node.value]
            self.refuse_twice("seeds", node.value, seeds)
        elif isinstance(node.value, dict):
            for key, entry in node.value.items():
                if key not in ("first", "count"):
                    self.fail(entry.line, f"seeds.{key}", f"unknown key; {valid_names(key, ['first', 'count'])}")
            if "count" not in node.value:
                self.fail(node.line, "seeds.count", "this key is missing")
            seeds = self.seeds_in_a_row(node)
        else:
            self.fail(node.line, "seeds", "must be {first: 1, count: 100} or a list of seeds")
        if not seeds:
            self.fail(node.line, "seeds", "there are none; at least one is needed")
        if max(seeds) > MAX_SEED:
            self.fail(node.line, "seeds", f"{max(seeds)} is above {MAX_SEED}, the largest seed")
        return seeds

    def seeds_in_a_row(self, node):
        """Checks the number first: a list of far too many would not fit into memory."""
        first = self.whole("seeds.first", node.value["first"], 0) if "first" in node.value else 1
        count = self.whole("seeds.count", node.value["count"], 1)
        if first > MAX_SEED:
            self.fail(node.value["first"].line, "seeds.first", f"{first} is above {MAX_SEED}, the largest seed")
        most = min(MOST_SEEDS, MAX_SEED - first + 1)
        if count > most:
            self.fail(node.value["count"].line, "seeds.count", f"{count} is too many; from 1 to {most} seeds from {first} on are valid")
        return list(range(first, first + count))

    def values(self, key, node):
        if not isinstance(node.value, list):
            self.fail(node.line, key, "must be a list of values, [a, b, …]; one value belongs under set")
        if not node.value:
            self.fail(node.line, key, "the list is empty; at least one value is needed")
        values = [self.plain(key, item) for item in node.value]
        self.refuse_twice(key, node.value, values)
        return values

    def range(self, key, node):
        if not isinstance(node.value, list) or len(node.value) != 2:
            self.fail(node.line, key, "must be a range [lower, upper]")
        lower, upper = (self.number(key, item) for item in node.value)
        if lower > upper:
            self.fail(node.line, key, f"lower is above upper; [{upper:g}, {lower:g}] would be valid")
        if lower == upper:
            self.fail(node.line, key, f"the range [{lower:g}, {upper:g}] is empty; one value belongs under set")
        return Range(float(lower), float(upper))

    def plain(self, key, node):
        """A value: no map, but lists may have maps in them."""
        if isinstance(node.value, dict):
            self.fail(node.line, key, "must be a value; write keys below it with dots, path.to.key: value")
        return self.whole_tree(node)

    def whole_tree(self, node):
        if isinstance(node.value, dict):
            return {key: self.whole_tree(entry) for key, entry in node.value.items()}
        return [self.whole_tree(item) for item in node.value] if isinstance(node.value, list) else node.value

    def number(self, key, node):
        if not is_number(node.value) or not math.isfinite(node.value):
            self.fail(node.line, key, f"{shown(node)} is not a number")
        return node.value

    def whole(self, key, node, least):
        if not is_number(node.value) or not isinstance(node.value, int) or node.value < least:
            self.fail(node.line, key, f"{shown(node)} is not a whole number of at least {least}")
        return node.value

    def word(self, key, node):
        if not isinstance(node.value, str) or not node.value:
            self.fail(node.line, key, f"{shown(node)} is not a word")
        return node.value

    def refuse_twice(self, key, nodes, values):
        for number, value in enumerate(values):
            if value in values[:number]:
                self.fail(nodes[number].line, key, f"{yaml_text(value)} is given twice")

    def check_parameters(self, spec):
        ranges = [name for name, values in spec.values() if name.startswith(RANDOMISE) and any(value is not None for value in values)]
        for name in ranges:
            given = name.removeprefix(RANDOMISE)
            if given in spec.parameters():
                self.fail(self.lines[name], name, f"{given} is given at line {self.lines[given]}; one of them is valid")
        for name, other in itertools.permutations(spec.parameters(), 2):
            if other.startswith(name + "."):
                self.fail(self.lines[other], other, f'lies below "{name}" of line {self.lines[name]}; one of them is valid')
        for name, node in self.map("units").items():
            if name not in spec.parameters():
                valid = valid_names(name, spec.parameters()) if spec.parameters() else "valid are those of cases, grid, draw and set, which are not there"
                self.fail(node.line, f"units.{name}", f"no such parameter; {valid}")


def shown(node):
    if isinstance(node.value, (dict, list)):
        return "a list" if isinstance(node.value, list) else "a map"
    return "nothing" if node.value is None else yaml_text(node.value) if not isinstance(node.value, str) else f'"{node.value}"'


def data_folder():
    """Where robots/, scenarios/ and campaigns/ are, as surefoot/config/data_directory.hpp has it."""
    chosen, here = os.environ.get("SUREFOOT_DATA_DIR"), pathlib.Path(__file__).resolve()
    wheel = here.parents[1] / "surefoot/share/surefoot"
    return pathlib.Path(chosen) if chosen else wheel if wheel.is_dir() else here.parents[2]


def load_spec(name_or_path):
    """Reads a file, or a campaign that ships, by its name."""
    path, shipped = pathlib.Path(name_or_path), data_folder() / "campaigns"
    names = [file.stem for file in sorted(shipped.glob("*.yaml"))]
    if path.suffix == ".yaml" and not path.exists() and path.stem in names:
        raise InputError(f"there is no {path} here; did you mean {path.stem}, which ships?")
    if path.suffix != ".yaml" and not path.exists():
        if str(path) not in names:
            raise InputError(f'"{path}" is no file, and no campaign that ships; {valid_names(str(path), names)}')
        path = shipped / f"{path}.yaml"
    return Reader(path).read()
