"""Unpacks the wanted robots from the wheel of robot descriptions into this Python's environment.

    .venv/bin/python tools/unpack_robots.py WHEEL FOLDER...
"""

import pathlib
import sys
import sysconfig
import zipfile

wheel, *folders = sys.argv[1:]
with zipfile.ZipFile(wheel) as archive:
    names = archive.namelist()
    for folder in folders:
        wanted = [name for name in names if f"/example-robot-data/robots/{folder}/" in name]
        if not wanted:
            sys.exit(f"{pathlib.Path(wheel).name} holds no robot folder {folder}")
        archive.extractall(sysconfig.get_path("platlib"), wanted)
