"""A log in Python: aligned worlds, plots, pictures."""

import numpy as np
import pytest

import surefoot


def test_positions_of_the_simulators_world_are_taken_to_the_controllers(tmp_path):
    surefoot.run("walk_flat", set=["duration=2", "initial.yaw=0.5", "initial.x=1.0"], record=tmp_path / "run.mcap")
    run = surefoot.read(tmp_path / "run.mcap")
    apart = np.asarray(run["state.p_WB"]) - np.asarray(run["truth.p_SB"])
    assert np.abs(run["state.p_WB"] - run.in_W("truth.p_SB", at="start")).max() < 0.15 < np.abs(apart).max()
    with pytest.raises(ValueError, match="one of these is in W"):
        run["state.p_WB"] - run["truth.p_SB"]


def test_figures_of_the_report_and_channels_are_plotted(log, tmp_path):
    run = surefoot.read(log)
    for name in ("com_tracking", "terrain_adaptation"):
        run.plot(name, path=tmp_path / f"{name}.pdf")
        assert (tmp_path / f"{name}.pdf").read_bytes().startswith(b"%PDF")
    figure = run.plot("state.v_WB", "command.torque.LF_KFE", "truth.torque.LF_KFE")
    assert [axes.get_ylabel() for axes in figure.axes] == ["[m/s]", "[N·m]"]
    assert set(run.figures) >= {"com_tracking", "torques", "residuals"}
    with pytest.raises(surefoot.Error, match="two worlds"):
        run.plot("state.p_WB.x", "truth.p_SB.x")
    with pytest.raises(surefoot.Error, match="no channel or figure com_traking; did you mean"):
        run.plot("com_traking")
    with pytest.raises(surefoot.Error, match="there is no folder .*/nowhere; one that exists would be valid"):
        run.plot("com_tracking", path=tmp_path / "nowhere/com.pdf")


def test_its_channels_are_a_collection(log):
    run = surefoot.read(log)
    assert "state.p_WB" in run and "state.p_WB.x" in run and "time" in run and "state.p_W" not in run
    assert list(run) == list(run.channels) and len(run) == len(run.channels)
    with pytest.raises(TypeError, match=r"a channel is named by a text, as run\[\"state.p_WB.x\"\]; \['a', 'b'\] was given"):
        run[["a", "b"]]


def test_it_has_the_metrics_and_criteria_of_its_run(tmp_path):
    result = surefoot.run("walk_flat_ideal", set=["duration=0.5"], record=tmp_path / "run.mcap")
    run = surefoot.read(tmp_path / "run.mcap")
    assert run.metrics.keys() == result.metrics.keys() and run.metrics["succeeded"] is None
    np.testing.assert_equal(run.metrics, result.metrics)
    assert len(run.criteria) == len(result.criteria) > 2 and run.criteria[0]["metric"] == "fell" and run.criteria[0]["passed"] is None


def test_a_topic_is_a_data_frame_by_its_times(log):
    run = surefoot.read(log)
    frame = run.frame("state")
    assert frame.index.name == "time" and list(frame.index) == list(run.time)
    np.testing.assert_array_equal(frame["state.p_WB.x"], np.asarray(run["state.p_WB.x"]))


def test_a_topic_comes_in_parts_too(log):
    run = surefoot.read(log)
    parts = list(run.parts("state"))
    assert sum(part.num_rows for part in parts) == len(run.time) and len(parts) > 1
    with pytest.raises(KeyError, match=r'no channel state.time; the times of the ticks are log.time, or log\["time"\]'):
        run["state.time"]
    with pytest.raises(KeyError, match="has no topic states; did you mean"):
        next(run.parts("states"))


def test_of_a_long_log_only_the_channels_asked_for_are_kept(log, monkeypatch):
    whole = surefoot.read(log)["state.p_WB"]
    monkeypatch.setattr("surefoot_log.recorded.KEPT", 0)
    run = surefoot.read(log)
    np.testing.assert_array_equal(run["state.p_WB"], whole)
    assert not run._tables and set(run._columns) == {"state.p_WB.x", "state.p_WB.y", "state.p_WB.z"}


def test_it_is_drawn_filmed_and_reported(log, tmp_path):
    run = surefoot.read(log)
    assert run.picture(1.0, tmp_path / "a.png", size=(320, 240)).size == (320, 240) and (tmp_path / "a.png").stat().st_size > 1000
    assert run.film(tmp_path / "a.mp4", 0.0, 0.3, size=(320, 240), rate=10).stat().st_size > 1000
    assert run.report(tmp_path / "report", pictures=False).name == "index.html"
    with pytest.raises(surefoot.Error, match="no tick lies at 9 s; the log goes from 0 s to"):
        run.picture(9.0)
