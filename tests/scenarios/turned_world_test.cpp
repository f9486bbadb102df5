#include "surefoot/control/controller.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/simulation/make_estimator.hpp"
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace surefoot {
namespace {

/// Believes what another estimator does, of a world that is turned and shifted: where a robot that
/// feels its way is, and where it looks, nothing tells it.
class TurnedEstimator final : public StateEstimator {
 public:
  TurnedEstimator(std::unique_ptr<StateEstimator> estimator, double yaw, Vec3 shift)
      : estimator_(std::move(estimator)), turn_(rotation_about_z(yaw)), shift_(std::move(shift)) {}

  const RobotState& update(const SensorReading& reading,
                           const TickContext& context) noexcept override {
    state_ = estimator_->update(reading, context);
    state_.p_WB = turn_ * state_.p_WB + shift_;
    state_.v_WB = turn_ * state_.v_WB;
    state_.q_WB = (Quat(turn_) * state_.q_WB).normalized();
    return state_;
  }

 private:
  std::unique_ptr<StateEstimator> estimator_;
  Mat3 turn_;
  Vec3 shift_;
  RobotState state_;
};

struct Case {
  const char* name;
  const char* scenario;
  double push;  // sideways, from 3.5 s on for a second [N]
};

class TurnedWorld : public testing::TestWithParam<Case> {};

/// Two controllers get the same readings, one of them believes another place and heading.
TEST_P(TurnedWorld, GetsTheSameTorques) {
  Scenario scenario = test::scenario(GetParam().scenario, {"planner.calibration.duration=0"}, 3);
  if (GetParam().push > 0.0) {
    scenario.plant.disturbances.pushes.push_back(
        {.body = "", .time = 3.5, .duration = 1.0, .force = Vec3(0.0, GetParam().push, 0.0)});
  }
  Plant plant(scenario.robot, scenario.plant);
  const auto estimator = [&] {
    return make_estimator(scenario.estimation,
                          {scenario.robot, scenario.controller.period, plant, scenario.estimator});
  };
  Controller here(scenario.robot, scenario.controller, estimator());
  Controller there(scenario.robot, scenario.controller,
                   std::make_unique<TurnedEstimator>(estimator(), 2.0, Vec3(-3.0, 7.0, 0.4)));
  double felt = 0.0;
  for (int tick = 0; tick < 2400; ++tick) {
    const SensorReading reading = plant.read();
    const UserCommand user = scenario.user(reading.time);
    const JointVector other = there.step(reading, user).torque;
    const JointCommand& command = here.step(reading, user);
    ASSERT_LT((command.torque - other).cwiseAbs().maxCoeff(), 1e-6) << "tick " << tick;
    felt = std::max(felt, here.record().state.external_force.norm());
    plant.write(command);
  }
  EXPECT_GE(here.steps_taken(), 3);
  EXPECT_GE(felt, 0.5 * GetParam().push);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, TurnedWorld,
                         testing::Values(Case{"Walk", "walk_flat", 0.0},
                                         Case{"StepDown", "step_down", 0.0},
                                         Case{"Rough", "rough_field", 0.0},
                                         Case{"Pushed", "walk_flat", 60.0}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace surefoot
