"""From a spec to its runs, each with an id; checked by the program before any of them starts."""

import concurrent.futures
import hashlib
import itertools
import json
import pathlib
from dataclasses import dataclass

from surefoot_campaign.draws import draw
from surefoot_campaign.errors import InputError, valid_names
from surefoot_campaign.program import yaml_text
from surefoot_campaign.spec import CASE


@dataclass(frozen=True)
class Run:
    id: str
    scenario: str  # as the spec names it
    file: str  # as the program finds it
    seed: int
    case: str  # of the spec; None where it has none
    parameters: dict
    sources_hash: str
    version: str
    point: int  # of the grid, over all scenarios

    def value(self, name):
        """The value of a parameter, or the case: what a figure has along an axis."""
        return self.case if name == CASE else self.parameters[name]

    def place(self, spec):
        """The case and the parameters of the grid, which distinguish its point from others."""
        return ({CASE: self.case} if spec.cases else {}) | {key: self.parameters[key] for key in spec.grid}


@dataclass
class Plan:
    spec: object
    runs: list
    metrics: dict  # those the program measures
    version: str
    notes: list  # of its scenarios, each with the first point that has it


def run_id(sources_hash, seed, parameters, version):
    """Equal for equal files, seed, parameters and program."""
    values = sorted((key, yaml_text(value)) for key, value in parameters.items())
    return hashlib.sha256(json.dumps([sources_hash, seed, values, version]).encode()).hexdigest()[:16]


def scenario_file(spec, name):
    """A file is looked for in the spec's folder first."""
    file = spec.path.parent / name
    return str(file) if name.endswith((".yaml", ".yml")) and file.is_file() else name


def grid_points(spec):
    """Case and parameters of each point, without what is drawn."""
    for case, of_case in spec.cases.items() or [(None, {})]:
        for values in itertools.product(*spec.grid.values()):
            yield case, of_case | dict(zip(spec.grid, values)) | spec.fixed


def with_draws(spec, parameters, seed):
    drawn = {key: draw(seed, key, range_.lower, range_.upper) for key, range_ in spec.draw.items()}
    return in_order(spec, parameters | drawn)


def in_order(spec, parameters):
    return {key: parameters[key] for key in spec.parameters() if key in parameters}


def explain(spec, scenario, case, parameters, message):
    """What the program says of a parameter, with the line of the spec that gives it."""
    for key in parameters:
        if message.startswith(f"--set {key}="):
            section = next((name for name in ("grid", "draw") if key in getattr(spec, name)), "set" if key in spec.fixed else "cases")
            # The program's words are "--set key=value: what is wrong".
            given = message.removeprefix("--set ")
            if section == "draw" and given.endswith("is not a whole number"):
                range_ = spec.draw[key]
                given += f"; draws are of real numbers: list values under grid, or let the program draw, set: {{randomise.{key}: [{range_.lower:g}, {range_.upper:g}]}}"
            if section == "cases":
                return f"{spec.where((case, key))}: cases.{case}: {given} (scenario {scenario})"
            return f"{spec.where(key)}: {section}: {given} (scenario {scenario})"
    # The program does not know of the folder that was looked in first.
    missing, folder = f'there is no file "{scenario}" in ', spec.path.parent.resolve()
    if message.startswith(missing) and folder != pathlib.Path.cwd():
        message = f"{missing}{folder}, {message.removeprefix(missing)}"
    values = " ".join(f"{key}={yaml_text(value)}" for key, value in parameters.items())
    with_values = f" with {values}" if values and not message.startswith("unknown scenario") else ""
    return f"{spec.where('scenario')}: scenario {scenario}{with_values}: {message}"


def check_all(spec, program, jobs):
    """The points of all scenarios, and what the program says of each. It is asked for both ends of every range."""
    ends = [{key: range_.lower for key, range_ in spec.draw.items()}]
    if spec.draw:
        ends.append({key: range_.upper for key, range_ in spec.draw.items()})

    def check(scenario, case, parameters):
        checks = []
        for end in ends:
            try:
                checks.append(program.check(scenario_file(spec, scenario), in_order(spec, parameters | end)))
            except InputError as error:
                raise InputError(explain(spec, scenario, case, parameters | end, str(error))) from None
        return checks[0]

    points = [(scenario, *point) for scenario in spec.scenarios for point in grid_points(spec)]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        futures = [pool.submit(check, *point) for point in points]
        try:
            return points, [future.result() for future in futures]
        finally:
            pool.shutdown(cancel_futures=True)


def check_judge(spec, metrics):
    names = [name for name, about in metrics.items() if not about["by_clock"]]
    if spec.judge in names:
        return
    if spec.judge in metrics:
        raise InputError(f"{spec.where('judge')}: judge: {spec.judge} depends on the machine's clock; valid are: {', '.join(names)}")
    raise InputError(f"{spec.where('judge')}: judge: unknown metric \"{spec.judge}\"; {valid_names(spec.judge, names)}")


def notes_of(points, checks):
    """Names each note once, however many points have it."""
    first = {}
    for (scenario, case, _), check in zip(points, checks):
        for note in check["notes"]:
            first.setdefault((scenario, note), case)
    return [f"{scenario}{'' if case is None else f' ({case})'}: {note}" for (scenario, note), case in first.items()]


def make_plan(spec, program, jobs):
    points, checks = check_all(spec, program, jobs)
    check_judge(spec, checks[0]["metrics"])
    runs, of_id = [], {}
    for number, ((scenario, case, parameters), check) in enumerate(zip(points, checks)):
        for seed in spec.seeds:
            full = with_draws(spec, parameters, seed)
            run = Run(
                id=run_id(check["sources_hash"], seed, full, check["version"]),
                scenario=scenario,
                file=scenario_file(spec, scenario),
                seed=seed,
                case=case,
                parameters=full,
                sources_hash=check["sources_hash"],
                version=check["version"],
                point=number,
            )
            if run.id in of_id:
                raise InputError(f"{spec.where('scenario')}: scenario: {of_id[run.id]} and {scenario} are the same; one of them is valid")
            of_id[run.id] = scenario
            runs.append(run)
    return Plan(spec, runs, checks[0]["metrics"], checks[0]["version"], notes_of(points, checks))
