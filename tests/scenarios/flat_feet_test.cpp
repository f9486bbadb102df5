// A humanoid stands on flat feet, shifts its weight, squats and takes a push, from what it senses.
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/model/robot_model.hpp"
#include "tests/scenarios/loop.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

TEST(FlatFeet, ShiftSquatAndTakeAPush) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const evaluation::Metrics metrics =
        closed_loop::run_closed_loop(config::load_scenario({"flat_feet", seed, {}}), {}).metrics;
    EXPECT_EQ(metrics.succeeded, true) << seed << ": " << metrics.reason;
    EXPECT_EQ(metrics.fallback_ticks, 0) << seed;
    EXPECT_EQ(metrics.false_touchdowns, 0) << seed;
  }
}

/// Where the true ground force acts, in a sole's axes from its centre [m].
Vec2 true_pressure(const simulation::GroundTruth& truth, const model::Dynamics& dynamics,
                   std::size_t leg) {
  const Vec3 arm = truth.feet[leg].point - truth.p_SF[leg];
  return (dynamics.shank[leg].R.transpose() * arm).head<2>();
}

TEST(FlatFeet, KeepTheCentreOfPressureInTheirSoles) {
  const config::Scenario scenario = test::scenario("flat_feet", {}, 4);
  model::RobotModel model(scenario.robot);
  test::Loop loop(scenario);
  double worst = 0.0;  // share of half a sole
  loop.run_until(20.0, [&] {
    RobotState state = loop.record().state;
    if (!state.p_WB.allFinite()) return false;
    const simulation::GroundTruth& truth = loop.truth();
    state.p_WB = truth.p_SB;
    state.q_WB = truth.q_SB;
    state.q = truth.q;
    const model::Dynamics& dynamics = model.update(state, Vec3::UnitZ());
    for (std::size_t leg = 0; leg < 2; ++leg) {
      EXPECT_TRUE(truth.feet[leg].touching);
      if (truth.feet[leg].force.z() < 20.0) continue;
      const Vec2 at = true_pressure(truth, dynamics, leg);
      worst = std::max(worst, at.cwiseAbs().cwiseQuotient(dynamics.sole).maxCoeff());
    }
    return false;
  });
  EXPECT_GT(worst, 0.1);
  EXPECT_LT(worst, 1.0);
  EXPECT_EQ(loop.allocations(), 0U) << loop.last_allocation();
  EXPECT_EQ(loop.record().command.mode, CommandMode::optimal);
}

TEST(FlatFeet, FollowTheCommand) {
  const config::Scenario scenario = test::scenario("flat_feet", {}, 5);
  test::Loop loop(scenario);
  loop.run_until(1.9);
  const double height = loop.truth().p_SB.z();
  const auto left = [&] {  // of the feet's middle [m]
    const simulation::GroundTruth& truth = loop.truth();
    const Vec3 across = truth.p_SF[0] - truth.p_SF[1];
    return (truth.p_SCom - 0.5 * (truth.p_SF[0] + truth.p_SF[1])).dot(across) / across.norm();
  };
  loop.run_until(5.9);
  EXPECT_NEAR(left(), scenario.user(5.0).shift.y(), 0.015);
  loop.run_until(9.9);
  EXPECT_NEAR(left(), scenario.user(9.0).shift.y(), 0.015);
  loop.run_until(16.9);
  EXPECT_NEAR(loop.truth().p_SB.z() - height, scenario.user(16.0).height, 0.015);
}

TEST(FlatFeet, DoNotWalk) {
  const std::string message =
      test::message_of([] { (void)config::load_scenario({"walk_flat", 1, {"robot=g1"}}); });
  EXPECT_TRUE(test::holds(message, "walk_flat.yaml:"));
  EXPECT_TRUE(test::holds(message, "g1 has flat feet and only stands"));
}

}  // namespace
}  // namespace surefoot
