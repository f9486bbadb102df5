#include "surefoot/control/controller.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/signals/plan_event.hpp"
#include "surefoot/simulation/make_estimator.hpp"
#include "tests/scenarios/loop.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace surefoot {
namespace {

constexpr int kPoses = 3;  // of the world, beside the one as it is

/// Believes what another estimator does, of a world that is turned and shifted: where a robot that
/// feels its way is, and where it looks, nothing tells it.
class TurnedEstimator final : public estimation::StateEstimator {
 public:
  TurnedEstimator(std::unique_ptr<estimation::StateEstimator> estimator, double yaw, Vec3 shift)
      : estimator_(std::move(estimator)), turn_(rotation_about_z(yaw)), shift_(std::move(shift)) {}

  const RobotState& update(const SensorReading& reading,
                           const TickContext& context) noexcept override {
    state_ = estimator_->update(reading, context);
    state_.p_WB = turn_ * state_.p_WB + shift_;
    state_.v_WB = turn_ * state_.v_WB;
    state_.q_WB = (Quat(turn_) * state_.q_WB).normalized();
    return state_;
  }
  void restart() noexcept override { estimator_->restart(); }

 private:
  std::unique_ptr<estimation::StateEstimator> estimator_;
  Mat3 turn_;
  Vec3 shift_;
  RobotState state_;
};

struct Case {
  const char* name;
  const char* scenario;
  const char* calibration;  // [s]
  double push;              // sideways, from 3.5 s on for a second [N]
  int ticks;
  std::vector<PlanEvent> seen = {};       // what it is about
  std::vector<std::string> changes = {};  // in the scenario
};

class TurnedWorld : public testing::TestWithParam<Case> {};

/// Controllers get the same readings, and all but one believe another place and heading.
TEST_P(TurnedWorld, GetsTheSameTorques) {
  const Case& run = GetParam();
  std::vector<std::string> changes = run.changes;
  changes.push_back(std::string("planner.calibration.duration=") + run.calibration);
  config::Scenario scenario = test::scenario(run.scenario, changes, 3);
  if (run.push > 0.0) {
    scenario.plant.disturbances.pushes.push_back(
        {.body = "", .time = 3.5, .duration = 1.0, .force = Vec3(0.0, run.push, 0.0)});
  }
  simulation::Plant plant(scenario.robot, scenario.plant);
  const auto estimator = [&] {
    return simulation::make_estimator(
        scenario.estimation,
        {scenario.robot, scenario.controller.period, plant, scenario.estimator});
  };
  control::Controller here(scenario.robot, scenario.controller, estimator());
  std::vector<std::unique_ptr<control::Controller>> elsewhere;
  test::RandomMatrices random(11);
  const auto pose = [&] {
    const double yaw = random.uniform(-kPi, kPi);
    const Vec3 shift(random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0),
                     random.uniform(-2.0, 2.0));
    return std::make_unique<TurnedEstimator>(estimator(), yaw, shift);
  };
  for (int i = 0; i < kPoses; ++i) {
    elsewhere.push_back(
        std::make_unique<control::Controller>(scenario.robot, scenario.controller, pose()));
  }
  double felt = 0.0;
  std::set<PlanEvent> events;
  for (int tick = 0; tick < run.ticks; ++tick) {
    const SensorReading reading = plant.read();
    const UserCommand user = scenario.user(reading.time);
    const JointCommand& command = here.step(reading, user);
    for (int i = 0; i < kPoses; ++i) {
      const JointVector& other = elsewhere[static_cast<std::size_t>(i)]->step(reading, user).torque;
      ASSERT_LT((command.torque - other).cwiseAbs().maxCoeff(), 1e-6)
          << "pose " << i << ", tick " << tick;
    }
    for (const GaitEvent& event : here.record().plan.events) events.insert(event.kind);
    felt = std::max(felt, here.record().state.external_force.norm());
    plant.write(command);
  }
  EXPECT_GE(here.steps_taken(), 3);
  EXPECT_GE(felt, 0.5 * run.push);
  for (const PlanEvent event : run.seen) {
    EXPECT_TRUE(events.contains(event)) << name(event);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenarios, TurnedWorld,
    testing::Values(
        Case{"Walk", "walk_flat", "0", 0.0, 2400}, Case{"Calibrated", "walk_flat", "6", 0.0, 5600},
        Case{"CalibratedMismatch", "walk_flat_mismatch", "6", 0.0, 5600},
        Case{"StepDown", "step_down", "0", 0.0, 6000, {PlanEvent::probe_edge, PlanEvent::late}},
        Case{"Rough", "rough_field", "0", 0.0, 2400},
        Case{"Slippery", "slippery", "0", 0.0, 2400, {PlanEvent::slip}},
        Case{"PushedToStep", "walk_flat", "0", 200.0, 2400, {PlanEvent::push_step}},
        Case{"Pushed", "walk_flat", "0", 60.0, 2400, {PlanEvent::push_reloaded}},
        Case{"StepUp", "step_up", "0", 0.0, 6000, {PlanEvent::caught}, {"planner.swing.apex=0.08"}},
        Case{"Cliff", "cliff", "0", 0.0, 8000, {PlanEvent::no_ground}},
        Case{"BegunAnew",
             "walk_flat",
             "0",
             0.0,
             2400,
             {PlanEvent::begun_anew},
             {"sensors.faults.first={sensor: encoders, kind: spike, time: 0, size: 0.1}"}}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace surefoot
