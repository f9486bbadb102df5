"""From a log to the paper's Fig. 4 (balance) and Fig. 6 (terrain adaptation) as PDF: `python 10_read_a_log.py [RUN.mcap]`."""

import pathlib
import sys
import tempfile

import numpy as np

import surefoot

folder = pathlib.Path(tempfile.mkdtemp())
if len(sys.argv) > 1:
    log = pathlib.Path(sys.argv[1])
else:
    log = folder / "run.mcap"
    down = ["duration=9", "planner.calibration.duration=0", "criteria=none"]
    surefoot.run("step_down", set=down, record=log)

run = surefoot.read(log)
run.plot("com_tracking", path=folder / "fig4.pdf")
run.plot("terrain_adaptation", path=folder / "fig6.pdf")
print(run)
print(f"figures: {folder}/fig4.pdf, {folder}/fig6.pdf")

# The same numbers by hand. Estimate and truth are in two worlds; in_W() takes one to the other.
drift = np.linalg.norm(run["state.p_WB"] - run.in_W("truth.p_SB", at="start"), axis=1)
print(f"believed base off by at most {1e3 * drift.max():.2f} mm; largest torque {np.abs(run['command.torque']).max():.1f} N·m")
for event in run.events[:4]:
    print(f"{event['time']:6.3f} s  {event['leg'] or ''} {event['text']}")
assert (folder / "fig4.pdf").stat().st_size > 1000 and (folder / "fig6.pdf").stat().st_size > 1000
