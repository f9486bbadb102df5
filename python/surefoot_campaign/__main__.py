import sys

from surefoot_campaign.cli import main

sys.exit(main(sys.argv[1:]))
