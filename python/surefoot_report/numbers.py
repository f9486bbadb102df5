"""The run's numbers as a table, each with what it is measured on."""

import math
from dataclasses import dataclass

from surefoot_campaign.units import unit_of_metric
from surefoot_report.page import Cell, table
from surefoot_report.words import decimal

DEGREES = 180 / math.pi
TRUTH, TRUTH_PLAN, TRUTH_COMMAND, BELIEF = "truth", "truth against plan", "truth against command", "belief against truth"
PLAN, COMMAND, CLOCK, RUN_TIME = "plan", "command", "wall clock", "time of the run"
CALIBRATED, CALIBRATING, WALKING = "without calibration", "calibration alone", "while it walks"


@dataclass(frozen=True)
class Quantity:
    """A metric as people read it."""

    metric: str
    name: str
    basis: str = ""  # whose number it is
    decimals: int = 3
    over: str = ""  # which part of the run; empty: all of it
    always_shown: bool = True  # also where nothing is required of it


QUANTITIES = [
    Quantity("goal_reached", "goal reached", TRUTH),
    Quantity("fell", "fell", TRUTH),
    Quantity("com_error_max_m", "COM tracking error, largest", TRUTH_PLAN, 3, over=CALIBRATED),
    Quantity("com_error_rms_m", "COM tracking error, rms", TRUTH_PLAN, 3, over=CALIBRATED),
    Quantity("com_lateral_sway_m", "lateral COM sway", TRUTH, 1, over=WALKING),
    Quantity("com_zmp_slack_max_m", "planned ZMP outside its polygon by", PLAN, 1, always_shown=False),
    Quantity("com_error_calibrating_max_m", "COM tracking error while calibrating, largest", TRUTH_PLAN, 3, over=CALIBRATING, always_shown=False),
    Quantity("path_deviation_max_m", "distance from the path, largest", TRUTH_COMMAND, 1, over=WALKING, always_shown=False),
    Quantity("path_deviation_base_max_m", "distance of the base from the path, largest", TRUTH_COMMAND, 1, over=WALKING, always_shown=False),
    Quantity("command_error_rms_mps", "velocity against a steady command, rms", TRUTH_COMMAND, 3, over=WALKING, always_shown=False),
    Quantity("turn_error_rms_radps", "yaw rate against a steady command, rms", TRUTH_COMMAND, 3, over=WALKING, always_shown=False),
    Quantity("duration_s", "duration", RUN_TIME, 2),
    Quantity("distance_m", "distance", TRUTH, 3),
    Quantity("speed_mps", "speed", TRUTH, 3, over=WALKING),
    Quantity("steps_taken", "steps", PLAN, 0),
    Quantity("no_ground_events", "feet taken back for want of ground", PLAN, 0),
    Quantity("edge_landings", "landings on an edge", TRUTH, 0),
    Quantity("search_max_s", "longest search for ground", PLAN, 2),
    Quantity("orientation_error_rms_rad", "torso orientation error, rms", TRUTH_PLAN, 2),
    Quantity("base_height_error_rms_m", "torso height error, rms", TRUTH_PLAN, 2),
    Quantity("base_height_end_m", "torso above the feet at the end", TRUTH, 3, always_shown=False),
    Quantity("max_tilt_rad", "largest tilt", TRUTH, 1, over=CALIBRATED),
    Quantity("max_tilt_calibrating_rad", "largest tilt while calibrating", TRUTH, 1, over=CALIBRATING),
    Quantity("torso_reference_step_max_rad", "largest turn of the torso's reference in a tick", PLAN, 3, over=CALIBRATED, always_shown=False),
    Quantity("torso_reference_step_max_m", "largest way of the torso's reference in a tick", PLAN, 3, over=CALIBRATED, always_shown=False),
    Quantity("control_frame_step_max_rad", "largest turn of the control frame in a tick", PLAN, 3, over=CALIBRATED, always_shown=False),
    Quantity("velocity_error_rms_mps", "error of the believed velocity, rms", BELIEF, 3, always_shown=False),
    Quantity("tilt_error_rms_rad", "error of the believed tilt, rms", BELIEF, 2, always_shown=False),
    Quantity("tilt_error_max_rad", "error of the believed tilt, largest", BELIEF, 2, always_shown=False),
    Quantity("position_drift_m", "drift of the believed position", BELIEF, 1, always_shown=False),
    Quantity("heading_drift_rad", "drift of the believed heading", BELIEF, 2, always_shown=False),
    Quantity("touchdown_latency_p95_s", "touchdowns noticed after, 95 %", BELIEF, 3, always_shown=False),
    Quantity("touchdowns_noticed", "touchdowns noticed", BELIEF, 0, always_shown=False),
    Quantity("touchdowns_late", "touchdowns noticed after more than 30 ms", BELIEF, 0, always_shown=False),
    Quantity("false_touchdowns", "touchdowns that were none", BELIEF, 0, always_shown=False),
    Quantity("contact_losses_noticed", "losses of contact noticed", BELIEF, 0, always_shown=False),
    Quantity("contact_losses_missed", "losses of contact missed", BELIEF, 0, always_shown=False),
    Quantity("contact_losses_false", "losses of contact that were none", BELIEF, 0, always_shown=False),
    Quantity("contact_loss_latency_p95_s", "losses of contact noticed after, 95 %", BELIEF, 3, always_shown=False),
    Quantity("slips_detected", "slips noticed", BELIEF, 0, always_shown=False),
    Quantity("slips_missed", "slips missed", BELIEF, 0, always_shown=False),
    Quantity("slips_false", "slips that were none", BELIEF, 0, always_shown=False),
    Quantity("slip_latency_p95_s", "slips noticed after, 95 %", BELIEF, 3, always_shown=False),
    Quantity("reach_error_max_m", "largest error of an arm's tip", TRUTH_PLAN, 4, always_shown=False),
    Quantity("limb_extension_max_m", "longest leg, hip to foot", TRUTH, 3),
    Quantity("torque_max_nm", "largest joint torque", TRUTH, 1),
    Quantity("torque_command_max_nm", "largest commanded torque", COMMAND, 1, always_shown=False),
    Quantity("torque_step_max_nm", "largest torque step in a tick", COMMAND, 2),
    Quantity("friction_margin_min", "smallest friction margin of any foot", TRUTH, 2, always_shown=False),
    Quantity("friction_margin_loaded_min", "smallest friction margin of a loaded foot", TRUTH, 2),
    Quantity("foot_slip_max_m", "longest slip in a stance", TRUTH, 1),
    Quantity("penetration_max_m", "deepest penetration", TRUTH, 2),
    Quantity("shank_contacts", "shin or knee contacts", TRUTH, 0),
    Quantity("torso_contacts", "torso contacts", TRUTH, 0, always_shown=False),
    Quantity("lifted_s", "time off the ground, lifted", BELIEF, 2, always_shown=False),
    Quantity("torque_lifted_max_nm", "largest joint torque while lifted", TRUTH, 1, always_shown=False),
    Quantity("standing_up_s", "time to stand up", BELIEF, 2, always_shown=False),
    Quantity("torque_standing_up_max_nm", "largest joint torque while standing up", TRUTH, 1, always_shown=False),
    Quantity("fallback_ticks", "ticks without the hierarchy's optimum", COMMAND, 0, always_shown=False),
    Quantity("tick_us.median", "time per tick, median", CLOCK, 0),
    Quantity("tick_us.p99", "time per tick, 99 %", CLOCK, 0),
    Quantity("tick_us.max", "time per tick, longest", CLOCK, 0, always_shown=False),
    Quantity("solve_us.median", "of it the solver, median", CLOCK, 0),
    Quantity("solve_us.p99", "of it the solver, 99 %", CLOCK, 0, always_shown=False),
    Quantity("solve_us.max", "of it the solver, longest", CLOCK, 0, always_shown=False),
    Quantity("realtime_factor", "speed of the simulation", CLOCK, 1),
]  # fmt: skip


def unit_of(metric):
    """The unit of a metric in the report, and its scale. Angles are in degrees."""
    if metric == "realtime_factor":
        return "× real time", 1.0
    unit, scale = unit_of_metric(metric)
    return ("°", DEGREES) if unit == "rad" else (unit, scale)


def measure(value, quantity):
    unit, scale = unit_of(quantity.metric)
    return f"{decimal(scale * value, quantity.decimals)}{'' if unit in ('', '°') else ' '}{unit}"


def yes_no(truth):
    return "yes" if truth else "no"


def value_text(value, quantity):
    """The value as text; "–" if it could not be measured."""
    if isinstance(value, bool):
        return yes_no(value)
    if isinstance(value, (int, float)):
        return measure(value, quantity)
    return value if isinstance(value, str) else "–"


def limits(criterion, quantity):
    if criterion.equals is not None:
        return yes_no(criterion.equals)
    bounds = (("≥", criterion.min), ("≤", criterion.max))
    return ", ".join(f"{sign} {measure(bound, quantity)}" for sign, bound in bounds if bound is not None)


def required(criterion, quantity):
    if criterion is None:
        return Cell("")
    text = limits(criterion, quantity)
    if criterion.passed is None:
        return Cell(f"{text}  (not judged)", "soft")
    return Cell(f"{text}  ✓ holds", "good nowrap") if criterion.passed else Cell(f"{text}  ✗ missed", "bad nowrap")


def is_compared(outcome, metric):
    return outcome.criterion(metric) is not None or metric in outcome.paper


def quantities(outcome):
    """All of them, and what criteria and paper name besides, under its own name; first what is compared with something."""
    known = {quantity.metric for quantity in QUANTITIES}
    named = dict.fromkeys([criterion.metric for criterion in outcome.criteria] + list(outcome.paper))
    found = QUANTITIES + [Quantity(metric, metric) for metric in named if metric not in known]
    return sorted(found, key=lambda quantity: not is_compared(outcome, quantity.metric))


def basis(outcome, quantity):
    calibrates = outcome.metrics.get("com_error_calibrating_max_m") is not None
    over = "" if quantity.over == CALIBRATED and not calibrates else quantity.over
    return f"{quantity.basis}, {over}" if over else quantity.basis


def is_shown(outcome, quantity):
    """Leaves out metrics of the calibration if there was none, and the goal if there is none."""
    if is_compared(outcome, quantity.metric):
        return True
    value = outcome.metrics.get(quantity.metric)
    is_known = quantity.metric in outcome.metrics and (quantity.over != CALIBRATING or value is not None)
    return quantity.always_shown and is_known and (quantity.metric != "goal_reached" or outcome.goal != "")


def row(outcome, quantity):
    return [Cell(quantity.name), Cell(value_text(outcome.metrics.get(quantity.metric), quantity), "number"), Cell(basis(outcome, quantity), "basis"),
            required(outcome.criterion(quantity.metric), quantity), Cell(outcome.paper.get(quantity.metric, ""), "soft")]  # fmt: skip


BASES = ('<p class="soft">Truth is the simulator\'s, belief the controller\'s estimate; plan and command are the controller\'s, too. Where nothing '
         "else is said a number is of the whole run, with its calibration.</p>\n")  # fmt: skip


def all_metrics(outcome):
    rows = [[Cell(name), Cell(value_text(value, Quantity("", "", decimals=6)), "number")] for name, value in outcome.metrics.items()]
    return f"<details><summary>All metrics under their names</summary>\n{table(['metric', 'value'], rows)}</details>\n"


def name_of(metric):
    """What people call a metric, e.g. "goal reached"."""
    return next((quantity.name for quantity in QUANTITIES if quantity.metric == metric), metric)


def numbers(outcome):
    """First what a criterion limits or the paper has a figure of, then what else matters; below, all metrics under their names."""
    shown = [quantity for quantity in quantities(outcome) if is_shown(outcome, quantity)]
    compared = sum(is_compared(outcome, quantity.metric) for quantity in shown)
    rows = [row(outcome, quantity) for quantity in shown]
    return table(["quantity", "this run", "measured on", "required", "paper"], rows, compared) + BASES + (all_metrics(outcome) if outcome.known else "")
