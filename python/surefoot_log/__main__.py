import sys

from surefoot_campaign.command_line import run_command
from surefoot_log.cli import command

sys.exit(run_command(command, sys.argv[1:], "interrupted: nothing is kept"))
