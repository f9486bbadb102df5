// The control loop: two simulated seconds of a walk, and how far the centre of mass was off its
// plan. On a robot, your RobotPort takes the plant's place and your StateEstimator the truth's.
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/simulation/plant.hpp"
#include "surefoot/simulation/truth_estimator.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

using surefoot::Controller, surefoot::JointCommand, surefoot::Plant, surefoot::Scenario,
    surefoot::SensorReading, surefoot::TruthEstimator;

int main() {
  // Robot, task hierarchy, gait and ground, read from scenarios/walk_flat.yaml. Only set-up throws.
  const Scenario scenario =
      surefoot::load_scenario({.name_or_path = "walk_flat", .seed = 0, .assignments = {}});
  Plant plant(scenario.robot, scenario.plant);
  Controller controller(scenario.robot, scenario.controller,
                        std::make_unique<TruthEstimator>(plant.truth()));
  double com_error = 0.0;
  while (plant.time() < 2.0) {
    const SensorReading& reading = plant.read();
    const JointCommand& command = controller.step(reading, scenario.user(reading.time));

    // What the tick was made of: state, plan, residual of every level, active limits, forces.
    const surefoot::TickRecord& tick = controller.record();
    const surefoot::Vec2 error = tick.plan.com.p - plant.truth().p_WCom.head<2>();
    com_error = std::max(com_error, error.norm());

    plant.write(command);
  }
  std::printf("%d steps, centre of mass off its plan by at most %.3f mm\n",
              controller.steps_taken(), 1e3 * com_error);
  return controller.steps_taken() > 0 && com_error < 1e-3 ? 0 : 1;
}
