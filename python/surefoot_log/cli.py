"""The commands `surefoot export` and `surefoot video`, and what `run` and `report` ask for their pictures."""

import argparse
import json
import math
import pathlib
import sys

from surefoot_campaign.command_line import Parser, tell, whole_number
from surefoot_campaign.errors import InputError, valid_names
from surefoot_campaign.output_files import partial_name
from surefoot_log.log_file import LogFile

LARGEST = (3840, 2160)  # pixels
FASTEST = 400  # images a second

EXPORT_EPILOG = """Columns are called by topic and field: plan.feet.LF.p_WF.x, hierarchy.level.com_xy.residual; in CSV with
their unit behind them, plan.feet.LF.p_WF.x[m], in Parquet with unit and description as metadata. Lists that
change their length from tick to tick (rows at a bound, blocked_by) are left out.

The file for Foxglove and Lichtblick has frame transforms (/tf), the robot, the ground, forces and support
polygon (/scene/…), events and stops (/events), and the log's own topics beside them.

Exit codes: 0 written, 2 the log can't be read or the file not be written.

Examples:
  surefoot export run.mcap --parquet run.parquet
  surefoot export run.mcap --csv feet.csv --topics plan model --every 10
  surefoot export run.mcap --foxglove scene.mcap
"""

VIDEO_EPILOG = """Exit codes: 0 written, 2 the log can't be read, the part has no tick, or the film can't be made.

Examples:
  surefoot video run.mcap --out run.mp4
  surefoot video run.mcap --out step.mp4 --from 13 --to 20 --speed 2
"""


def number(text):
    """NaN where the text is none."""
    try:
        return float(text)
    except ValueError:
        return math.nan


def positive(text):
    value = number(text)
    if not 0.0 < value < 1e3:
        raise argparse.ArgumentTypeError(f'"{text}" is not a number above 0 and below 1000')
    return int(value) if value == int(value) else value


def time_of_run(text):
    value = number(text)
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f'"{text}" is not a time; a number of seconds is valid')
    return value


def image_size(text):
    words = text.lower().split("x")
    sizes = [int(word) for word in words if word.isdecimal()]
    if len(words) != 2 or len(sizes) != 2 or any(not 64 <= size <= most or size % 2 for size, most in zip(sizes, LARGEST)):
        raise argparse.ArgumentTypeError(f'"{text}" is not a size such as 1280x720: even numbers, 64x64 to {LARGEST[0]}x{LARGEST[1]}')
    return tuple(sizes)


def parser(name, description, epilog=""):
    made = Parser(name, description, epilog)
    made.add_argument("log", metavar="RUN.mcap", help="log of a run")
    return made


def check_writable(path, log):
    """Throws InputError before the work, not after it."""
    path = pathlib.Path(path)
    if path.exists() and pathlib.Path(log).exists() and path.samefile(log):
        raise InputError(f"{path}: is the log itself, which would be lost; another name would be valid")
    if path.is_dir():
        raise InputError(f"{path}: is a folder; the name of a file would be valid")
    if not path.parent.is_dir():
        raise InputError(f"{path}: there is no folder {path.parent}; make it first")
    try:
        partial = pathlib.Path(partial_name(path))
        partial.touch()
        partial.unlink()
    except OSError as error:
        raise InputError(f"{path}: can't be written: {error.strerror}") from None


def tell_problem(log):
    for note in log.notes:
        tell(note)
    if log.problem:
        tell(f"warning: {log.path}: the log is not whole: {log.problem}")


def export(typed):
    made = parser("export", "Write a log as a table, or its scene for Foxglove.", EXPORT_EPILOG)
    made.add_argument("--csv", metavar="FILE", help="a row a tick, a column a channel, named with its unit, state.p_WB.x[m]")
    made.add_argument("--parquet", metavar="FILE", help="the same with types, units and descriptions")
    made.add_argument("--foxglove", metavar="FILE.mcap", help="the scene, and the log's topics beside it")
    made.add_argument("--topics", metavar="TOPIC", nargs="+", action="extend", help="of the log; all by default")
    made.add_argument("--every", type=whole_number(), metavar="N", default=1, help="of so many ticks, write one; 1 by default")
    arguments = made.parse_args(typed)
    files = [file for file in (arguments.csv, arguments.parquet, arguments.foxglove) if file]
    if not files:
        raise InputError("export needs to be told what to write: --csv FILE, --parquet FILE or --foxglove FILE.mcap")
    if len({pathlib.Path(file).resolve() for file in files}) < len(files):
        raise InputError(f"two of {', '.join(files)} are the same file; a name for each would be valid")
    for file in files:
        check_writable(file, arguments.log)
    write_exports(arguments)
    for file in files:
        print(file)


def write_exports(arguments):
    from surefoot_log import table

    log, topics = LogFile(arguments.log), table.wanted_topics(arguments.topics)
    files = [(file, make) for file, make in ((arguments.csv, table.Csv), (arguments.parquet, table.parquet_writer)) if file]
    if files:
        table.write_table(table.Table(log, topics, arguments.every), files)
    if arguments.foxglove:
        from surefoot_log import foxglove, pictures

        for note in foxglove.write_scene(log, arguments.foxglove, pictures.package_folders(), pictures.cache_folder(), topics, arguments.every):
            tell(f"note: {note}")
    tell_problem(log)


def video(typed):
    made = parser("video", "Film a log, without a screen.", VIDEO_EPILOG)
    made.add_argument("--out", metavar="FILE.mp4", required=True, help="the film: H.264 in MP4")
    made.add_argument("--from", dest="first", type=time_of_run, metavar="S", help="time at which it begins [s]; by default that of the log")
    made.add_argument("--to", dest="last", type=time_of_run, metavar="S", help="time at which it ends [s]; by default that of the log")
    made.add_argument("--size", type=image_size, metavar="WxH", default=(1280, 720), help="in pixels; 1280x720 by default")
    made.add_argument("--rate", type=whole_number(FASTEST), metavar="N", default=25, help="images a second; 25 by default")
    made.add_argument("--speed", type=positive, metavar="F", default=1, help="so many times as fast as the run; 1 by default")
    arguments = made.parse_args(typed)
    check_writable(arguments.out, arguments.log)
    from surefoot_log import pictures

    log = LogFile(arguments.log)
    for note in pictures.make_film(log, arguments.out, arguments.size, arguments.rate, arguments.speed, arguments.first, arguments.last, sys.stderr):
        tell(f"note: {note}")
    tell_problem(log)
    print(arguments.out)


def report_pictures(typed):
    """Of a report: writes strip.jpg and clip.mp4 into a folder, and says in JSON what they show."""
    made = parser("report-pictures", "Make the pictures of a report.")
    made.add_argument("folder")
    arguments = made.parse_args(typed)
    from surefoot_log import pictures

    print(json.dumps(pictures.make_report_pictures(LogFile(arguments.log), arguments.folder)))


COMMANDS = {"export": export, "video": video, "report-pictures": report_pictures}


def command(typed):
    if not typed or typed[0] not in COMMANDS:
        raise InputError(f"unknown command; {valid_names(typed[0] if typed else '', COMMANDS)}")
    COMMANDS[typed[0]](typed[1:])
