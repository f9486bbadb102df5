"""The figures of a report: what their curves, legends, units and shades show, against the log's own messages."""

import copy

import numpy as np
import pytest
from damaged_logs import changed
from log_file import messages

from surefoot_log.log_file import LogFile  # isort: skip
from surefoot_report import blockers, hierarchy_figures, motion_figures, plotting, report, run_data, space_figure  # isort: skip
from surefoot_report.ground import Ground  # isort: skip

LEGS = ["LF", "RF", "LH", "RH"]
ALL = report.MOTION + report.FORCES + report.LEVELS + report.TIMES


@pytest.fixture(scope="module")
def run(steps_down):
    return run_data.read_run(LogFile(steps_down))


@pytest.fixture(scope="module")
def said(steps_down):
    """The messages of a topic, as other readers of MCAP have them."""
    read = {}
    return lambda topic: read.setdefault(topic, messages(steps_down, topic))


@pytest.fixture
def whole_curves(monkeypatch):
    for module in (plotting, hierarchy_figures):
        monkeypatch.setattr(module, "thinned", lambda x, y: (x, y))


def curves(figure, panel):
    return [line.get_ydata() for line in figure.axes[panel].lines]


def legend(axes):
    return [text.get_text() for text in axes.get_legend().get_texts()] if axes.get_legend() else []


def test_axes_have_units_and_curves_of_one_axes_are_told_apart(run):
    for name, draw, _ in ALL:
        figure = draw(run)
        labels = [text for axes in figure.axes for text in (axes.get_xlabel(), axes.get_ylabel()) if text]
        assert labels and all(label.endswith("]") for label in labels), name
        assert figure.axes[-1].get_xlabel() in ("time [s]", "x [m]", "time per tick [µs]")
    assert [legend(axes) for axes in motion_figures.com_figure(run).axes] == [["true", "desired"]] * 2 + [[]]
    assert [legend(axes) for axes in motion_figures.torque_figure(run).axes] == [LEGS] * 3
    assert legend(motion_figures.adaptation_figure(run).axes[0]) == ["roll", "pitch"]
    assert legend(motion_figures.force_figure(run).axes[0]) == ["true", "solution"]
    assert legend(space_figure.map_figure(run).axes[0]) == ["base (side)", "true COM", "desired COM", *LEGS]


def test_curves_are_the_values_of_the_log(run, said, whole_curves):
    plan, model, truth, command = (said(topic) for topic in ("/plan", "/model", "/truth", "/command"))
    assert np.allclose(run.time, [one["time"] for one in plan], atol=1e-9)
    limb, torque, force = motion_figures.adaptation_figure(run), motion_figures.torque_figure(run), motion_figures.force_figure(run)
    for k, leg in enumerate(LEGS):
        assert np.allclose(curves(limb, 2 + k)[-1], [np.linalg.norm(np.subtract(one["p_WH"][leg], one["p_WF"][leg])) for one in model])
        for joint in range(3):
            curve = curves(torque, joint)[2 + k]  # behind the two limits
            assert np.array_equal(curve, [one["torque"][3 * k + joint] for one in command])
        true, solution = curves(force, k)
        assert np.allclose(true, [np.dot(one["feet"][leg]["force"], one["feet"][leg]["normal"]) for one in truth])
        assert np.allclose(solution, [np.dot(np.array(p["R_WC"])[:, 2], m["force"][leg]) for p, m in zip(plan, model)])
    limits = [line.get_ydata()[0] for line in motion_figures.torque_figure(run).axes[0].lines[:2]]
    assert limits == [run.header["robot"]["torque_limit"][0], -run.header["robot"]["torque_limit"][0]]


def test_the_com_error_is_that_of_the_metrics(run, whole_curves):
    """Which are measured in C++, without calibration."""
    error = curves(motion_figures.com_figure(run), 2)[0][~run.calibrates]
    metrics = report.read_outcome(run.summary, {}).metrics
    assert error.max() == pytest.approx(1e3 * metrics["com_error_max_m"], rel=1e-6)
    angle = np.linalg.norm(motion_figures.orientation_errors(run), axis=1)
    assert np.sqrt(np.mean(angle**2)) == pytest.approx(metrics["orientation_error_rms_rad"], rel=0.02)
    tilt, velocity, position, heading = (errors[np.isfinite(errors)] for errors in motion_figures.estimate_errors(run))
    assert np.radians(tilt.max()) == pytest.approx(metrics["tilt_error_max_rad"], rel=1e-6)
    assert 1e-3 * np.sqrt(np.mean(velocity**2)) == pytest.approx(metrics["velocity_error_rms_mps"], rel=0.02)
    assert position[0] == pytest.approx(0, abs=1e-9) and heading[0] == 0


def rotated(run, R, p):
    """The same run in a world that lies elsewhere."""
    other = copy.copy(run)
    other.truth = copy.copy(run.truth)
    for name in ("p_SB", "p_SCom", "p_SF"):
        setattr(other.truth, name, getattr(run.truth, name) @ R.T + p)
    other.truth.v_SB, q = run.truth.v_SB @ R.T, run.truth.q_SB
    half = 0.5 * np.arctan2(R[1, 0], R[0, 0])
    c, s = np.cos(half), np.sin(half)
    other.truth.q_SB = np.stack([c * q[:, 0] - s * q[:, 3], c * q[:, 1] - s * q[:, 2], c * q[:, 2] + s * q[:, 1], c * q[:, 3] + s * q[:, 0]], axis=1)
    return other


def test_errors_of_the_estimate_do_not_hang_on_where_the_robot_began(run):
    R, p = run_data.turns(2.0), np.array([3.0, -7.0, 0.5])
    for here, there in zip(motion_figures.estimate_errors(run), motion_figures.estimate_errors(rotated(run, R, p))):
        assert np.allclose(here, there, atol=1e-6, equal_nan=True)
    lifted, v = rotated(run, np.eye(3), np.zeros(3)), run.truth.v_SB
    lifted.truth.v_SB = v + [0, 0, 0.01]
    assert not np.allclose(motion_figures.estimate_errors(lifted)[1], motion_figures.estimate_errors(run)[1], atol=1, equal_nan=True)


def test_plans_are_where_the_standing_feet_are():
    random = np.random.default_rng(3)
    believed, contact = random.normal(size=(50, 4, 3)), random.random((50, 4)) < 0.6
    R, p = run_data.turns(0.4), np.array([0.5, -2.0, 0.1])
    contact[:2], contact[2], believed[7, 0, 0] = [True, False, False, False], True, np.nan
    found_R, found_p = run_data.laid_by_feet(contact, believed, believed @ R.T + p)
    assert np.allclose(found_R[:2], np.eye(3)) and np.allclose(found_p[:2], 0), "one foot says nothing"
    assert np.allclose(found_R[2:], R) and np.allclose(found_p[2:], p), "and where nothing is known it stays"


def test_rotation_vectors_undo_rotations():
    vectors = np.random.default_rng(1).normal(size=(100, 3)) * 0.9
    angles = np.linalg.norm(vectors, axis=1, keepdims=True)
    q = np.hstack([np.cos(angles / 2), np.sin(angles / 2) * vectors / angles])
    inside = angles[:, 0] < np.pi
    assert np.allclose(motion_figures.rotation_vectors(run_data.matrices(q))[inside], vectors[inside]) and inside.sum() > 90
    assert np.array_equal(motion_figures.rotation_vectors(np.eye(3)[None]), np.zeros((1, 3)))


def test_shades_are_the_times_of_the_log(run, said):
    level = run.levels[run.header["limb"]["level"]]
    acts = [any(row["level"] == level for row in one["active"]) for one in said("/hierarchy")]
    assert run_data.stretches(acts, run.time, run.period) == motion_figures.limits_acting(run) != []
    phases = [one["feet"]["LF"]["phase"] for one in said("/plan")]
    for wanted, times in (({"stance", "unloading"}, motion_figures.stance(run, 0)[0]), ({"search"}, motion_figures.search(run, 0)[0])):
        inside = [phase in wanted for phase in phases]
        assert times and sum(end - begin for begin, end in times) == pytest.approx(sum(inside) * run.period)
        assert times[0][0] == pytest.approx(run.time[inside.index(True)])
    (calibration,) = motion_figures.calibration(run)
    assert calibration == pytest.approx((0.0, 9.5), abs=0.2)


def test_stretches_end_a_period_after_their_last_tick():
    assert run_data.stretches([1, 1, 0, 1], np.arange(4.0), 0.5) == [(0.0, 1.5), (3.0, 3.5)] and run_data.stretches([0, 0], np.arange(2.0), 1) == []


def test_thinned_curves_keep_every_peak_and_every_gap():
    x = np.arange(20_000.0)
    y = np.sin(x / 300)
    y[7777], y[12_345], y[5000:5100] = 9, -9, np.nan
    few_x, few_y = plotting.thinned(x, y)
    assert len(few_x) < 4 * plotting.COLUMNS + 4 and np.nanmax(few_y) == 9 and np.nanmin(few_y) == -9
    assert np.all(np.diff(few_x) > 0) and np.isnan(few_y[(few_x >= 5000) & (few_x < 5100)]).all() and not np.isnan(few_y[few_x == 4999]).any()
    assert np.abs(np.interp(x, few_x[np.isfinite(few_y)], few_y[np.isfinite(few_y)]) - y)[10:4990].max() < 0.05
    assert plotting.thinned(x[:99], y[:99])[0] is not None and len(plotting.thinned(x[:99], y[:99])[0]) == 99


def test_levels_that_were_not_solved_have_neither_residual_nor_rows_at_their_bounds(steps_down, run, tmp_path):
    tick = int(run.active["tick"][run.active["level"] == 6][0])
    log = changed(steps_down, tmp_path, "/hierarchy", tick, lambda hierarchy: hierarchy.update(status=1, failed_level=6))
    cut = run_data.read_run(LogFile(log))
    assert np.isnan(cut.residual[tick, 6:]).all() and np.array_equal(cut.residual[tick, :6], run.residual[tick, :6])
    assert not (cut.active["level"][cut.active["tick"] == tick] >= 6).any() and len(run.active["tick"]) > len(cut.active["tick"])


def test_a_level_that_came_while_it_ran_has_a_row_of_its_own(log, tmp_path):
    changed_log = changed(log, tmp_path, "/hierarchy", 5, lambda hierarchy: hierarchy["levels"][0].update(name="newcomer", residual=7.0))
    run = run_data.read_run(LogFile(changed_log))
    assert run.levels[-1] == "newcomer" and run.residual[5, -1] == 7 and np.isnan(run.residual[5, 0]) and np.isnan(run.residual[4, -1])


def test_residuals_have_their_largest_value_with_its_unit_at_the_right(run):
    texts = [text.get_text() for text in hierarchy_figures.residual_figure(run).axes[0].texts]
    for level, name in enumerate(run.levels):
        largest = np.nanmax(run.residual[:, level])
        text = texts[1 + level]  # behind "largest"
        assert text.endswith("*") == name.endswith("_minimisation")
        if largest < 1e-6:
            assert text == "0"
        else:
            assert float(text.split(" ")[0].split("·")[0]) == pytest.approx(largest, rel=0.06) and run.header["level_units"][level] in text


def test_what_gave_way_to_what_is_added_up(run, said):
    found = blockers.held_back(run)
    level = next(iter(found))
    by, name, ticks, total, largest, time = found[level][0]
    costs = {one["time"]: row["cost"] for one, tick in zip(said("/plan"), said("/hierarchy")) if tick["blocking_is_known"] for row in tick["blocked_by"]
             if (row["level"], row["by"], row["row"]) == (run.levels[level], run.levels[by], name) and row["cost"] > 1e-6}  # fmt: skip
    assert (ticks, total, largest) == (len(costs), pytest.approx(sum(costs.values())), max(costs.values())) and costs[round(time, 6)] == largest
    table = blockers.blocker_table(run)
    assert f"{run.levels[by].replace('_', ' ')}: {name}" in table and "Known at" not in table
    quiet = copy.copy(run)
    quiet.explained = np.arange(len(run.time)) % 4 == 0
    assert "Known at 25 % of the ticks" in blockers.blocker_table(quiet)
    quiet.blocked = run_data.chosen(run.blocked, [])
    assert "No level was held back" in blockers.blocker_table(quiet)
    quiet.explained = np.zeros(len(run.time), bool)
    assert blockers.blocker_table(quiet) == ""


def test_limits_that_acted_are_told_by_task_and_leg_but_not_where_a_foot_is_set_down(run):
    axes = hierarchy_figures.active_rows_figure(run).axes[0]
    names = [label.get_text() for label in axes.get_yticklabels()]
    assert "7  limb extension limit LF" in names and names == sorted(names, key=lambda name: int(name.split()[0])) and len(set(names)) == len(names)
    assert hierarchy_figures.informative(run, run.active).sum() < 0.9 * len(run.active["tick"])


def test_events_are_counted(run):
    names = [label.get_text() for label in hierarchy_figures.event_figure(run).axes[0].get_yticklabels()]
    assert f"touchdown ({len(run.event_times[2])})" in names and any(name.startswith("probe: edge") for name in names)


def test_the_time_of_the_ticks_is_marked_at_its_quantiles(run):
    axes = hierarchy_figures.timing_figure(run).axes[0]
    places = [line.get_xdata()[0] for line in axes.lines]
    quantiles = np.quantile(run.totals, [0.5, 0.99, 1.0], method="inverted_cdf")  # the program's
    assert places == pytest.approx([*quantiles, 2500])
    assert sum(bar.get_height() for bar in axes.patches) >= 99.9 and axes.texts[-1].get_text() == "period 2500 µs"


def test_the_map_has_both_views_to_one_scale_the_prints_and_the_edge(run, said):
    figure = space_figure.map_figure(run)
    above, side = figure.axes
    scales = [axes.get_window_extent().width / np.ptp(axes.get_xlim()) for axes in figure.axes]
    scales += [axes.get_window_extent().height / np.ptp(axes.get_ylim()) for axes in figure.axes]
    assert np.ptp(scales) < 1e-6 * scales[0] and above.get_xlim() == side.get_xlim()
    edges = above.collections[1].get_segments() + above.collections[2].get_segments()
    assert edges and all(segment[:, 0] == pytest.approx(0.42, abs=1e-3) for segment in edges), "where the step of the scenario is"
    legs, places = space_figure.footprints(run)
    touched = sum(len(run_data.stretches(run.contact[:, leg], run.time, run.period)) for leg in range(4))
    assert len(legs) == len(places) == touched > 4 and set(legs) == {0, 1, 2, 3}
    z = side.lines[0].get_ydata()
    assert {round(z[0], 3), round(z[-1], 3)} == {0.0, -0.14}


def piece(shape, position, size=(0, 0, 0), pitch=0.0, **more):
    return {"shape": shape, "position": position, "q_SG": [np.cos(pitch / 2), 0, np.sin(pitch / 2), 0], "size": size, **more}


def test_the_ground_is_its_highest_piece():
    ground = Ground([piece("plane", (0, 0, 0)), piece("box", (0, 0, 0), (1, 1, 0.3)), piece("box", (5, 0, -1), (1, 1, 0.3))])
    face, z, _ = ground.at([0, 2, 5], 0)
    assert z == pytest.approx([0.15, 0, 0]) and face[0] != face[1] == face[2]
    alone = Ground([piece("box", (1, 0, 0.1), (2, 1, 0.2))])
    assert alone.at(0.5, 0.4)[1] == pytest.approx(0.2) and alone.at(0.5, 0.6)[0] == -1 and np.isnan(alone.at(-0.1, 0)[1])


def test_a_tilted_box_slopes_and_ends_where_its_edge_is():
    pitch, c, s = -0.3, np.cos(0.3), np.sin(0.3)  # rises ahead
    ground = Ground([piece("box", (0, 0, 0), (2, 2, 0.4), pitch)])
    face, z, slope = ground.at(0.1, 0)
    assert slope[0] == pytest.approx(np.tan(0.3)) and z == pytest.approx(0.2 / c + 0.1 * np.tan(0.3))
    faces, _, _ = ground.at([c - 0.2 * s - 1e-3, c - 0.2 * s + 1e-3, c + 0.2 * s + 1e-3], 0)  # round the upper and the lower right edge
    assert faces[0] == face != faces[1] and faces[2] == -1


def test_between_the_heights_of_a_grid_is_interpolated():
    ground = Ground([piece("heights", (1, 0, 0.5), (2, 1, 0), columns=3, rows=2, heights=[0, 0.1, 0.2, 1, 1.1, 1.2])])
    _, z, slope = ground.at([0.5, 1.0, 1.5], [-0.5, 0, 0])
    assert z[:2] == pytest.approx([0.55, 1.1]) and slope[2][0] == pytest.approx(0.1) and ground.at(1, 0.51)[0] == -1
