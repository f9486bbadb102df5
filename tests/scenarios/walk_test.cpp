#include "app/closed_loop.hpp"
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace surefoot {
namespace {

using test::Loop;
using test::scenario;

TEST(Walk, WithDelayLagAndNoiseItStillFollowsWithinAMillimetre) {
  const Metrics metrics = run_closed_loop(scenario("walk_flat_sea", {"duration=5"}, 3), {}).metrics;
  EXPECT_FALSE(metrics.fell);
  EXPECT_LE(metrics.com_error_max_m, 0.001);
  EXPECT_GE(metrics.steps_taken, 5);
}

TEST(Walk, NothingIsAllocatedAfterTheFirstTick) {
  Loop loop(scenario("walk_flat", {"planner.calibration.duration=0"}));
  (void)loop.tick();
  const std::size_t first = loop.allocations();
  loop.run_until(6.0);
  EXPECT_EQ(loop.allocations(), first) << "the last at " << loop.last_allocation() << " s";
  EXPECT_GE(loop.count(PlanEvent::touchdown), 7);
  EXPECT_GE(loop.count(PlanEvent::lift_off), 7);
}

/// Every torque commanded in a short walk.
std::vector<JointVector> torques(std::uint64_t seed) {
  Loop loop(scenario("walk_flat_sea", {}, seed));
  std::vector<JointVector> commands;
  for (int tick = 0; tick < 1200; ++tick) {
    (void)loop.tick();
    commands.push_back(loop.record().command.torque);
  }
  EXPECT_GE(loop.steps_taken(), 2);
  return commands;
}

TEST(Walk, TheSameSeedGivesTheSameCommandsToTheBit) {
  const std::vector<JointVector> first = torques(11), again = torques(11);
  for (std::size_t i = 0; i < first.size(); ++i) ASSERT_EQ(first[i], again[i]) << "tick " << i;
  EXPECT_NE(first, torques(12)) << "another seed is another noise";
}

}  // namespace
}  // namespace surefoot
