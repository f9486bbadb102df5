"""A report: the page and its figures in a folder."""

import json
import os
import shutil
import subprocess
import sys
from contextlib import contextmanager, nullcontext
from pathlib import Path
from tempfile import TemporaryDirectory

from surefoot_campaign.errors import InputError
from surefoot_campaign.outcome import last_line
from surefoot_campaign.output_files import locked, make_folder, partial_name, written_whole
from surefoot_campaign.text import in_words
from surefoot_log.log_file import LogFile
from surefoot_report import captions, hierarchy_figures, motion_figures, space_figure
from surefoot_report.blockers import blocker_table
from surefoot_report.head import provenance, title, verdict
from surefoot_report.numbers import numbers
from surefoot_report.outcome import read_outcome
from surefoot_report.page import Pictures, figure, page, pictures_part
from surefoot_report.plotting import inline, saved
from surefoot_report.run_data import read_run

# Of each section the figures: name, what draws it, and its caption.
MOTION = [("com_tracking", motion_figures.com_figure, captions.com), ("terrain_adaptation", motion_figures.adaptation_figure, captions.adaptation),
          ("estimate", motion_figures.estimate_figure, captions.ESTIMATE), ("map", space_figure.map_figure, captions.space),
          ("events", hierarchy_figures.event_figure, captions.EVENTS)]  # fmt: skip
FORCES = [("torques", motion_figures.torque_figure, captions.TORQUES), ("forces", motion_figures.force_figure, captions.FORCES)]
LEVELS = [("residuals", hierarchy_figures.residual_figure, captions.residuals), ("active_limits", hierarchy_figures.active_rows_figure, captions.ACTIVE)]
TIMES = [("tick_times", hierarchy_figures.timing_figure, captions.timing)]
FIGURES = {name: draw for name, draw, _ in MOTION + FORCES + LEVELS + TIMES}
STRIP = "strip.jpg"
FILES = [STRIP, *(f"{name}.{form}" for name in FIGURES for form in ("svg", "pdf"))]
NONE_ACTED = '<p class="soft">No inequality acted but where a foot was lifted or set down.</p>\n'


class Report:
    """What stands on the page of a log, without its pictures, and the files of its figures."""

    def __init__(self, log):
        run = self._run = read_run(log)
        outcome = read_outcome(run.summary, run.header.get("options"))
        self._number, self._files = 0, {}
        self._title = f"{run.header['scenario']} – surefoot"
        self._above = title(run.header) + verdict(run, outcome)
        self._below = f"<h2>Numbers</h2>\n{numbers(outcome)}{provenance(run, outcome)}"
        self._below += f"<h2>Motion</h2>\n{captions.time_note(run)}{self._drawn(MOTION)}<h2>Forces</h2>\n{self._drawn(FORCES)}"
        self._below += f"<h2>Hierarchy</h2>\n{self._drawn(LEVELS)}{'' if 'active_limits.svg' in self._files else NONE_ACTED}"
        self._below += blocker_table(run) + self._drawn(TIMES)

    def _drawn(self, wanted):
        """Numbers the figures as they come, and keeps their files."""
        out = ""
        for name, draw, caption in wanted:
            made = draw(self._run)
            if made is None:
                continue
            self._number += 1
            svg, pdf = saved(made, name)
            self._files |= {f"{name}.svg": svg.encode(), f"{name}.pdf": pdf}
            out += figure(self._number, name, inline(svg, in_words(name)), caption if isinstance(caption, str) else caption(self._run))
        return out

    def page(self, pictures):
        return page(self._title, self._above + pictures_part(pictures) + self._below)

    def write_figures(self, folder):
        """None of an earlier run stay, even if this is ended half way: its page goes first."""
        place = folder / "figures"
        with fresh_folder(folder) as fresh:
            for name, data in self._files.items():
                (fresh / name).write_bytes(data)
            place.mkdir(exist_ok=True)
            for old in (folder / "index.html", *(place / name for name in FILES)):
                old.unlink(missing_ok=True)
            for name in self._files:
                os.replace(fresh / name, place / name)


@contextmanager
def fresh_folder(folder):
    fresh = Path(partial_name(folder / "figures"))
    try:
        fresh.mkdir()
        yield fresh
    except OSError as error:
        raise InputError(f"{folder}: can't be written: {error.strerror or error}") from None
    finally:
        shutil.rmtree(fresh, ignore_errors=True)


def write_page(folder, text):
    path = folder / "index.html"
    with written_whole(path) as partial:
        Path(partial).write_text(text, encoding="utf-8")
    return path


def make_pictures(log, folder):
    """Makes strip and clip in a process of its own: the report stands whatever becomes of it."""
    command = [sys.executable, "-m", "surefoot_log", "report-pictures", str(log), str(folder)]
    done = subprocess.run(command, capture_output=True, text=True)
    try:
        if done.returncode == 0:
            return Pictures(folder=Path(folder), **json.loads(done.stdout))
    except (ValueError, TypeError) as error:
        return Pictures(why_none=str(error))
    return Pictures(why_none=last_line(done.stderr) or f"their program ended with {done.returncode}")


def write_report(log, folder, with_pictures=True, is_locked=False, is_there=lambda page: None):
    """Returns the page's path. The page is written before its pictures, when `is_there` gets its path, and again with them. `is_locked`: the
    caller has locked the folder."""
    log, folder = LogFile(log), Path(folder)
    report = Report(log)
    make_folder(folder)
    with nullcontext() if is_locked else locked(folder, folder), TemporaryDirectory(prefix="surefoot_") as scratch:
        report.write_figures(folder)
        path = write_page(folder, report.page(Pictures(are_coming=with_pictures)))
        if with_pictures:
            is_there(path)
            add_pictures(report, folder, log.path, scratch)
    return path


def add_pictures(report, folder, log, scratch):
    """If the page with pictures can't be written, it stays without and says why."""
    try:
        pictures = make_pictures(log, scratch)
        write_page(folder, report.page(pictures))
        if pictures.folder:
            shutil.copyfile(pictures.folder / STRIP, folder / "figures" / STRIP)
    except (InputError, KeyboardInterrupt) as error:
        write_page(folder, report.page(Pictures(why_none=str(error) or "they were interrupted")))
        if isinstance(error, KeyboardInterrupt):
            raise
