"""The command `surefoot report`, which runs with --report use, too."""

import argparse
import sys

from surefoot_campaign.command_line import folder_name, run_command
from surefoot_log.cli import parser

EPILOG = """Exit codes: 0 the report is written, 2 the log can't be read or the folder not be written.

Example:
  surefoot run walk_flat --record run.mcap && surefoot report run.mcap --out out
"""


def report(typed):
    made = parser("report", "Write the HTML report of a log, with its figures as SVG and PDF.", EPILOG)
    made.add_argument("--out", metavar="DIR", type=folder_name, required=True, help="folder to write into")
    made.add_argument("--no-pictures", action="store_true", help="leave strip and clip out, which take most of the time")
    made.add_argument("--of-run", action="store_true", help=argparse.SUPPRESS)  # called by the program, which has locked the folder
    arguments = made.parse_args(typed)
    from surefoot_report.report import write_report

    def is_there(page):
        print(f"report: {page} can be opened; its pictures are being made", file=sys.stderr)

    print(write_report(arguments.log, arguments.out, not arguments.no_pictures, arguments.of_run, is_there))


if __name__ == "__main__":
    sys.exit(run_command(report, sys.argv[1:], "interrupted"))
