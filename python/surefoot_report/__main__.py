"""The command `surefoot report`, which runs with --report use, too."""

import argparse
import signal
import sys

from surefoot_campaign.command_line import Parser, folder_name, interrupt
from surefoot_campaign.errors import InputError

DONE, WRONG_INPUT = 0, 2
EPILOG = """Exit codes: 0 the report is written, 2 the log can't be read or the folder not be written.

Example:
  surefoot run walk_flat --record run.mcap && surefoot report run.mcap --out out
"""


def tell(text):
    print(f"surefoot: {text}", file=sys.stderr)


def report(typed):
    parser = Parser("surefoot report", description="Write the HTML report of a log, with its figures as SVG and PDF.", epilog=EPILOG, allow_abbrev=False,
                    formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    parser.add_argument("log", metavar="RUN.mcap", help="log of a run")
    parser.add_argument("--out", metavar="DIR", type=folder_name, required=True, help="folder to write into")
    parser.add_argument("--no-pictures", action="store_true", help="leave strip and clip out, which take most of the time")
    parser.add_argument("--of-run", action="store_true", help=argparse.SUPPRESS)  # called by the program, which has locked the folder
    parser.add_argument("--quiet", action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args(typed)
    from surefoot_report.report import write_report

    def is_there(page):
        if not arguments.quiet:
            print(f"report: {page} can be opened; its pictures are being made", file=sys.stderr)

    print(write_report(arguments.log, arguments.out, not arguments.no_pictures, arguments.of_run, is_there))


def main(typed):
    signal.signal(signal.SIGTERM, interrupt)
    try:
        report(typed)
        return DONE
    except InputError as error:
        tell(error)
    except KeyboardInterrupt:
        tell("interrupted")
    except (ImportError, OSError) as error:
        tell(" ".join(str(error).split()))
    return WRONG_INPUT


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
