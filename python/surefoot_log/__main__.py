import sys

from surefoot_log.cli import main

sys.exit(main(sys.argv[1:]))
