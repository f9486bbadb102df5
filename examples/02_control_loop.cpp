// The control loop: fifteen simulated seconds, in which the robot turns on the spot to find its
// IMU's biases and begins to walk, and how far its believed velocity was off. On a robot, your
// RobotPort takes the plant's place.
#include "surefoot/controller.hpp"
#include "surefoot/scenario.hpp"
#include "surefoot/simulation.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

using surefoot::control::Controller, surefoot::JointCommand,
    surefoot::estimation::LegInertialEstimator, surefoot::simulation::Plant,
    surefoot::config::Scenario, surefoot::SensorReading, surefoot::Vec3;

int main() {
  // Robot, task hierarchy, gait and ground, read from scenarios/walk_flat.yaml. Only set-up throws.
  const Scenario scenario =
      surefoot::config::load_scenario({.name_or_path = "walk_flat", .seed = 0, .assignments = {}});
  Plant plant(scenario.robot, scenario.plant);
  Controller controller(scenario.robot, scenario.controller,
                        std::make_unique<LegInertialEstimator>(scenario.robot, scenario.estimator,
                                                               scenario.controller.period));
  double largest_error = 0.0;
  while (plant.time() < 15.0) {
    const SensorReading& reading = plant.read();
    const JointCommand& command = controller.step(reading, scenario.user(reading.time));

    // What the tick was made of: state, plan, residual of every level, active limits, forces.
    const surefoot::TickRecord& tick = controller.record();
    const Vec3 believed = tick.state.q_WB.conjugate() * tick.state.v_WB;  // in B: without heading
    const Vec3 error = believed - plant.truth().q_SB.conjugate() * plant.truth().v_SB;
    if (plant.time() > 1.0) largest_error = std::max(largest_error, error.norm());

    plant.write(command);
  }
  std::printf("%d steps, believed velocity off by at most %.1f mm/s\n", controller.steps_taken(),
              1e3 * largest_error);
  return controller.steps_taken() > 0 && largest_error < 0.02 ? 0 : 1;
}
