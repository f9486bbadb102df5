"""What stands below the figures."""

from surefoot_log.frames import visible_residuals
from surefoot_report.motion_figures import calibration, limits_acting
from surefoot_report.run_data import SEARCH
from surefoot_report.words import decimal

ESTIMATE = ("How far what the estimator believes of the base is off the truth, until the robot stops for good. Position and heading count from the first "
            "tick: no sensor knows these, and nothing in control depends on them.")  # fmt: skip
EVENTS = "What the planner did, by what it believed: how often, and when."
TORQUES = "Commanded joint torques and their limits; what the drives apply is not drawn, but has a row in the table."
FORCES = ("Normal force of the ground on each foot: true (broad, coloured), and in the hierarchy's solution (thin line). Shaded: by the plan the leg "
          "stands. Short spikes where it swings are first touches, of probes too.")  # fmt: skip
ACTIVE = ("Inequalities that acted for 10 ms or longer, with the number of their level, by task and leg. Friction and normal force are left out where a "
          "foot is lifted or set down: there they hold by themselves.")  # fmt: skip


def time_note(run):
    times = ", ".join(f"{decimal(begin, 1)} to {decimal(end, 1)} s" for begin, end in calibration(run))
    return ('<p class="soft">The bar at the upper edge of figures over time: the robot calibrates itself on the spot '
            f"({times}), and leans and turns to do so.</p>\n" if times else "")  # fmt: skip


def com(run):
    believed, laid = (("as it truly was, ", " The plan is laid into the true world by the feet that stand.") if run.has_truth
                      else ("as the controller believed it, ", ""))  # fmt: skip
    return (f"Tracking of the centre of mass, as the paper's Fig. 4: lateral and forward position, {believed}against the plan, and the distance between "
            f"the two in the plane.{laid}")  # fmt: skip


def adaptation(run):
    level, text = run.header["limb"]["level"], "Adaptation to the terrain, as the paper's Fig. 6. "
    if run.has_truth:
        text += "(a), (b) Errors of the true torso against its reference, in the control frame"
        if level >= 0:
            text += "; amber: the limb limits act" if limits_acting(run) else "; the limb limits never act"
        text += ". "
    text += "Below, the distance of each hip from its foot" if run.has_truth else "The distance of each hip from its foot"
    text += ", as the controller believes it"
    text += f", with the limits of level {level + 1}" if level >= 0 else "; this stack does not limit it"
    searches = "amber: it searches for ground, " if (run.phase == SEARCH).any() else ""
    return f"{text}. Grey: by the plan the leg stands, {searches}white: it swings."


def space(run):
    has_ground = bool(run.header.get("terrain"))
    text = (f"The walk{' on its ground' if has_ground else ''}, as {'it truly was' if run.has_truth else 'the controller believed it'}, both views to the "
            "same scale. (a) Footprints in the leg's colour (front feet large), path of the centre of mass, and triangles of three feet "
            "that carry the robot while the fourth swings. (b) Paths of the feet's lowest points, of base and centre of mass")  # fmt: skip
    if not has_ground:
        return f"{text}."
    return (f"{text}, over the ground under the left and the right feet. Heavy lines are edges of the ground, lighter ones changes of its slope, grey ones "
            "its contours; the lower, the darker.")  # fmt: skip


def residuals(run):
    text = ("Residual of each level over time, √Σ violation², each from 0 to its own largest value at the right; 0 stands for less than 10⁻⁶. A level that "
            "is not zero is kept from its goal by those above it.")  # fmt: skip
    restless = None in visible_residuals(run.header).values()
    return f"{text} * asks for no force or torque at all: never zero by nature." if restless else text


def timing(run):
    period, count = 1e6 * run.period, len(run.totals)
    late = int((run.totals > period).sum())
    return (f"Wall-clock time of all of the controller's ticks, on a logarithmic axis. The control period is {decimal(period, 0)} µs; {late} of {count} "
            f"ticks ({decimal(100 * late / max(1, count), 2)} %) took longer, on a machine that promises nothing.")  # fmt: skip
