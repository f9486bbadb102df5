"""Two stacks over the same seeds: which seeds one of them mends or breaks, and the paired difference with its 95 % interval."""

import math
import pathlib
import sys
import tempfile

from surefoot import Stack, campaign, tasks

SEEDS = int(sys.argv[1]) if len(sys.argv) > 1 else 4  # more of them tell more

with tempfile.TemporaryDirectory() as folder:
    files = {}
    for name, kp in {"as it is": 500, "softer": 250}.items():
        stack = Stack("terrain_adaptation").replace("com_xy", tasks.ComXy(kp=kp, kd=2 * math.sqrt(kp)))
        files[name] = pathlib.Path(folder) / f"kp_{kp}.yaml"
        stack.write(files[name])
    found = campaign(
        {
            "name": "balance",
            "scenario": "walk_flat_ideal",
            "seeds": list(range(1, SEEDS + 1)),
            "cases": {name: {"stack": str(file)} for name, file in files.items()},
            "set": {"duration": 3.0, "criteria": None, "disturbances.pushes.side.time": 1.5, "disturbances.pushes.side.force.y": 60.0},
            "judge": "com_error_max_m",
        },
        out=pathlib.Path(folder) / "results",
    )
    for point in found.points:
        print(point["parameters"], f"{point['successes']} of {point['trials']} succeeded, median error {1e3 * point['judge']['median']:.2f} mm")
    # A sign test needs no distribution: how likely is a difference of this sign in so many pairs by chance?
    errors = {name: found.table.filter([one == name for one in found.table["case"].to_pylist()])["com_error_max_m"].to_pylist() for name in files}
    worse = sum(soft > hard for hard, soft in zip(errors["as it is"], errors["softer"]))
    p = min(1.0, 2 * sum(math.comb(SEEDS, k) for k in range(max(worse, SEEDS - worse), SEEDS + 1)) / 2**SEEDS)
    [pair] = found.pairs
    print(f"softer less as it is: median {1e3 * pair['difference']['median']:+.2f} mm, worse in {worse} of {SEEDS} seeds, sign test p = {p:.2g}")
    assert found.table.num_rows == 2 * SEEDS
