"""The same walk with a strict hierarchy and with weights: what a push of 60 N does to balance and torso."""

import surefoot
from surefoot import Stack, tasks

strict = Stack("terrain_adaptation").without("limb_extension_limits").replace("torso_yaw", tasks.TorsoYaw(kp=200, kd=28))
weighted = strict.weighted_from("com_xy", com_xy=10, swing_foot=10, contact_force_minimisation=0.01)  # its rows are in N
print(strict, weighted, sep="\n\n", end="\n\n")


def push(tick: surefoot.Tick) -> None:
    if abs(tick.time - 1.5) < 1e-6:
        tick.plant.push([0, 60, 0], duration=0.3)


found = {}
for name, stack in {"strict": strict, "weighted": weighted}.items():
    scenario = surefoot.load_scenario("walk_flat_ideal", stack=stack, set=["duration=3"])
    result = found[name] = surefoot.run(scenario, every_tick=push)
    print(f"{name:8}: centre of mass off by {1e3 * result['com_error_max_m']:5.1f} mm, torso by {result['orientation_error_rms_rad']:.4f} rad rms")
assert not any(result["fell"] for result in found.values())
