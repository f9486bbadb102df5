// The controller's torques do not depend on which solver it asks.
#include "surefoot/control/controller.hpp"
#include "surefoot/simulation/make_estimator.hpp"
#include "surefoot/simulation/plant.hpp"
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot {
namespace {

/// A scenario walked by one solver, while the others are asked the same at each tick.
class ThreeSolvers {
 public:
  explicit ThreeSolvers(const config::Scenario& scenario)
      : scenario_(scenario),
        plant_(scenario.robot, scenario.plant),
        lexicographic_(controller({})),
        general_(controller({.structure = false})),
        cascade_(controller({.method = control::SolverMethod::cascade})) {}

  /// Largest difference of a torque at the next tick [N·m].
  double tick() {
    const SensorReading& reading = plant_.read();
    const UserCommand& user = scenario_.user(reading.time);
    const JointVector expected = cascade_.step(reading, user).torque;
    const JointVector general = general_.step(reading, user).torque;
    const JointCommand& command = lexicographic_.step(reading, user);
    optimal_ = optimal_ && command.mode == CommandMode::optimal;
    const double difference = std::max((command.torque - expected).cwiseAbs().maxCoeff(),
                                       (general - expected).cwiseAbs().maxCoeff());
    plant_.write(command);
    return difference;
  }

  [[nodiscard]] bool always_optimal() const { return optimal_; }
  [[nodiscard]] int steps_taken() const { return lexicographic_.steps_taken(); }

 private:
  [[nodiscard]] control::Controller controller(const control::SolverOptions& solver) const {
    control::ControllerOptions options = scenario_.controller;
    options.solver = solver;
    return {scenario_.robot, options,
            simulation::make_estimator(scenario_.estimation, {scenario_.robot, options.period,
                                                              plant_, scenario_.estimator})};
  }

  const config::Scenario& scenario_;
  simulation::Plant plant_;
  control::Controller lexicographic_, general_, cascade_;
  bool optimal_ = true;
};

class SolverChoice : public testing::TestWithParam<const char*> {};

TEST_P(SolverChoice, ChangesNoTorqueOfAWalk) {
  const config::Scenario scenario =
      test::scenario(GetParam(), {"planner.calibration.duration=0"}, 4);
  ThreeSolvers loop(scenario);
  double largest = 0.0;
  for (int tick = 0; tick < 3200; ++tick) largest = std::max(largest, loop.tick());
  EXPECT_LT(largest, 1e-6);
  EXPECT_TRUE(loop.always_optimal());
  EXPECT_GE(loop.steps_taken(), 3);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, SolverChoice,
                         testing::Values("walk_flat", "walk_flat_ideal", "step_down"));

}  // namespace
}  // namespace surefoot
