import sys

from surefoot_campaign.cli import campaign
from surefoot_campaign.command_line import run_command

sys.exit(run_command(campaign, sys.argv[1:]))
