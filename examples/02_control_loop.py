"""The control loop: fifteen simulated seconds, in which the robot turns on the spot to find its IMU's biases and begins to walk, and how far its
believed velocity was off. On a robot your driver takes the plant's place."""

import numpy as np

import surefoot

scenario = surefoot.load_scenario("walk_flat", set=["duration=15"])
plant = surefoot.Plant(scenario)
controller = surefoot.Controller(scenario)  # from readings alone, as on a robot
evaluator = surefoot.Evaluator(scenario, plant, controller)
while plant.time < scenario.duration:
    reading = plant.read()
    command = controller.step(reading, scenario.user(reading.time))
    evaluator.add()
    plant.write(command)

error = evaluator.metrics["velocity_error_rms_mps"]
print(f"{controller.steps_taken} steps, believed velocity off by {1e3 * error:.1f} mm/s rms, {plant.truth.p_SB[0]:.2f} m walked")
for level in controller.levels():  # of the last tick
    print(f"{level.name:28} missed by {level.residual:.2e}, {len(level.active)} rows at a bound")
assert controller.steps_taken > 0 and error < 0.02 and np.isfinite(command.torque).all()
