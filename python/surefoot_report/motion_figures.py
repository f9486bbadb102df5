"""Figures over time: how the robot moved, with which torques and forces, and what its controller believed."""

import numpy as np

from surefoot_report.plotting import (AMBER, BLUE, GREEN, INK, LEG_COLOURS, ORANGE, PURPLE, STANCE, Panel, limits_of, time_figure)  # fmt: skip
from surefoot_report.run_data import SEARCH, matrices, stretches, turns
from surefoot_report.words import decimal

JOINTS = ("HAA", "HFE", "KFE")
SHADED, MARKED = 0.14, 0.35  # opacities of stance and of highlights


def source(run):
    return "true" if run.has_truth else "estimated"


def calibration(run):
    return stretches(run.calibrates, run.time, run.period)


def drawn(run, panels):
    return time_figure(run, panels, calibration(run))


def line(colour, y, label="", **style):
    return y, {"color": colour, "label": label, **style}


def stance(run, leg):
    return stretches(run.contact[:, leg], run.time, run.period), STANCE, SHADED


def search(run, leg):
    return stretches(run.phase[:, leg] == SEARCH, run.time, run.period), AMBER, MARKED


def times_of(run, ticks):
    acts = np.zeros(len(run.time), bool)
    acts[ticks] = True
    return stretches(acts, run.time, run.period)


def limits_acting(run):
    """Times at which rows of the limb limits were at their bounds."""
    return times_of(run, run.active["tick"][run.active["level"] == run.header["limb"]["level"]])


def com_figure(run):
    """After Fig. 4 of the paper. Forward and lateral as seen from the start."""
    along = (run.R_SW[0] @ run.R_WC[0])[:2, :2]
    there, desired = ((points - run.desired_com[0]) @ along for points in (run.seen.p_SCom[:, :2], run.desired_com))
    error = 1e3 * np.linalg.norm(run.seen.p_SCom[:, :2] - run.desired_com, axis=1)

    def position(title, axis):
        return Panel(title, "position [m]", [line(BLUE, there[:, axis], source(run)), line(ORANGE, desired[:, axis], "desired", linestyle="--")])

    return drawn(run, [position("(a) COM, lateral", 1), position("(b) COM, forward", 0),
                       Panel("(c) COM tracking error in the plane", "error [mm]", [line(PURPLE, error)], from_zero=True)])  # fmt: skip


def rotation_vectors(R):
    """The rotation vectors of rotation matrices."""
    twice = np.stack([R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]], axis=1)
    sine = np.linalg.norm(twice, axis=1)
    angle = np.arctan2(sine, np.trace(R, axis1=1, axis2=2) - 1)
    return twice * np.where(sine > 1e-12, angle / np.maximum(sine, 1e-12), 0.5)[:, None]


def orientation_errors(run):
    """Torso against its reference as a rotation vector in C: roll, pitch, yaw [rad]."""
    desired = run.R_SW @ matrices(run.torso_q)
    off = rotation_vectors(matrices(run.truth.q_SB) @ np.swapaxes(desired, 1, 2))
    return np.einsum("nji,nj->ni", run.R_SW @ run.R_WC, off)


def hip_foot_distances(run):
    apart = run.p_WH - run.belief.p_WF
    return apart[..., 2] if run.header["limb"]["form"] == "vertical" else np.linalg.norm(apart, axis=2)


def limb_panels(run):
    """All legs on one scale, with the limits that are near: one that is far would squeeze the curves."""
    limb, distances = run.header["limb"], hip_foot_distances(run)
    finite = distances[np.isfinite(distances)]
    limits = [limit for limit in (limb["min"], limb["max"]) if limit is not None]
    low, high = (finite.min(), finite.max()) if len(finite) else (0.0, 1.0)
    near = [limit for limit in limits if low - 0.5 * (high - low) < limit < high + 0.5 * (high - low)]
    y_range = limits_of([distances, np.array(near)])
    shown = [limit for limit in limits if y_range[0] < limit < y_range[1]]
    note = " and ".join(f"{decimal(limit, 3)} m{'' if limit in shown else ' (outside)'}" for limit in limits)
    title = "hip above foot" if limb["form"] == "vertical" else "hip–foot distance"
    return [Panel(f"{leg} {title}", "distance [m]", [line(LEG_COLOURS[k], distances[:, k])], [stance(run, k), search(run, k)],
                  [(limit, "") for limit in shown], f"limits {note}" if note else "", 0.78, y_range=y_range)
            for k, leg in enumerate(run.legs)]  # fmt: skip


def adaptation_figure(run):
    """After Fig. 6 of the paper."""
    panels = []
    if run.has_truth:
        acting = [(limits_acting(run), AMBER, MARKED)]
        roll, pitch, _ = np.degrees(orientation_errors(run)).T
        height = 1e3 * (run.truth.p_SB[:, 2] - run.desired_height)
        panels = [Panel("(a) orientation error", "error [°]", [line(BLUE, roll, "roll"), line(ORANGE, pitch, "pitch", linestyle="--")], acting),
                  Panel("(b) height error", "error [mm]", [line(PURPLE, height)], acting)]  # fmt: skip
    return drawn(run, panels + limb_panels(run))


def torque_figure(run):
    panels = []
    for joint, name in enumerate(JOINTS):
        limit = run.header["robot"]["torque_limit"][joint]
        curves = [line(LEG_COLOURS[k], run.torque[:, 3 * k + joint], leg) for k, leg in enumerate(run.legs)]
        panels.append(Panel(f"({'abc'[joint]}) {name}", "torque [N·m]", curves, bounds=[] if limit is None else [(limit, "limit"), (-limit, "")]))
    return drawn(run, panels)


def force_figure(run):
    if not run.has_truth:
        return None
    solution = np.einsum("ni,nki->nk", run.R_WC[:, :, 2], run.force)
    return drawn(run, [Panel(leg, "force [N]", [line(LEG_COLOURS[k], run.normal_force[:, k], "true", linewidth=2.2, alpha=0.5),
                                                line(INK, solution[:, k], "solution", linewidth=0.7)], [stance(run, k)], height=0.7, from_zero=True)
                       for k, leg in enumerate(run.legs)])  # fmt: skip


def estimate_errors(run):
    """Tilt [°], velocity [mm/s], drift of position [mm] and heading [°]; NaN where something is not known, or the robot has stopped for good."""
    belief, truth = run.belief, run.truth
    R, R_true = matrices(belief.q_WB), matrices(truth.q_SB)
    up, true_up = R[:, 2], R_true[:, 2]
    tilt = np.degrees(np.arctan2(np.linalg.norm(np.cross(up, true_up), axis=1), (up * true_up).sum(axis=1)))
    velocity = 1e3 * np.linalg.norm(np.einsum("nji,nj->ni", R, belief.v_WB) - np.einsum("nji,nj->ni", R_true, truth.v_SB), axis=1)
    heading = np.arctan2(R[:, 1, 0], R[:, 0, 0]) - np.arctan2(R_true[:, 1, 0], R_true[:, 0, 0])
    known = np.isfinite(tilt) & np.isfinite(velocity) & np.isfinite(belief.p_WB).all(axis=1) & ~np.isin(run.mode, ["sit", "damping"])
    if not known.any():
        return [np.full(len(run.time), np.nan)] * 4
    first = int(np.argmax(known))
    laid = (belief.p_WB - belief.p_WB[first]) @ turns(-heading[first]).T + truth.p_SB[first]
    position = 1e3 * np.linalg.norm(laid - truth.p_SB, axis=1)
    drift = np.degrees(np.remainder(heading - heading[first] + np.pi, 2 * np.pi) - np.pi)
    return [np.where(known, values, np.nan) for values in (tilt, velocity, position, drift)]


def estimate_figure(run):
    if not run.has_truth or run.header["estimation"] == "truth":
        return None
    parts = [("(a) tilt", "error [°]", BLUE), ("(b) velocity", "error [mm/s]", PURPLE), ("(c) position, drift", "drift [mm]", ORANGE),
             ("(d) heading, drift", "drift [°]", GREEN)]  # fmt: skip
    return drawn(run, [Panel(title, unit, [line(colour, values)], height=0.78, from_zero=not title.startswith("(d)"))
                       for (title, unit, colour), values in zip(parts, estimate_errors(run))])  # fmt: skip
