"""Figures of a log: those of its report by name, and channels over time."""

import numpy as np

from surefoot_campaign.errors import InputError, valid_names

HEIGHT, WIDTH = 1.5, 7.2  # of a plot [in]


def figure_of(run, names):
    from surefoot_report.report import FIGURES
    from surefoot_report.run_data import read_run

    known = [name for name in names if name in FIGURES]
    if not known:
        return channel_figure(run, names)
    if len(names) > 1:
        raise InputError(f"{known[0]} is a figure by itself; plot it alone, and channels alone")
    figure = FIGURES[known[0]](read_run(run._log))
    if figure is None:
        raise InputError(f"{run.path} has nothing for the figure {known[0]}")
    return figure


def channels_of(run, name):
    """The channels of a name, which may be all that begin so."""
    inside = [channel for channel in run.channels if channel == name or channel.startswith(f"{name}.")]
    if inside:
        return inside
    from surefoot_report.report import FIGURES

    members = dict.fromkeys(".".join(channel.split(".")[:2]) for channel in run.channels)
    raise InputError(f"{run.path} has no channel or figure {name}; {valid_names(name, [*FIGURES, *members])}")


def channel_figure(run, names):
    import surefoot_report.plotting  # noqa: F401 its style

    from matplotlib.figure import Figure

    channels = [channel for name in names for channel in channels_of(run, name)]
    worlds = {run._worlds[channel] for channel in channels} - {""}
    if len(worlds) > 1:
        raise InputError("these are in two worlds, the controller's W and the simulator's S; run.in_W(name) takes one of S to W, and "
                         "run.aligned_error(name) has the differences")  # fmt: skip
    by_unit = {}
    for channel in channels:
        by_unit.setdefault(run.channels[channel], []).append(channel)
    figure = Figure((WIDTH, HEIGHT * len(by_unit) + 0.5), layout="constrained")
    for axes, (unit, drawn) in zip(np.atleast_1d(figure.subplots(len(by_unit), 1, sharex=True)), by_unit.items()):
        for channel in drawn:
            axes.plot(run.time, np.asarray(run[channel]), label=channel)
        axes.set_ylabel(f"[{unit}]" if unit else "")
        axes.legend(loc="upper right")
    axes.set_xlabel("time [s]")
    return figure
