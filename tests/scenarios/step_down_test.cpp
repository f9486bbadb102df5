#include "surefoot/closed_loop/closed_loop.hpp"
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::Loop;
using test::scenario;

TEST(StepDown, FourteenCentimetresThatNobodyKnewOfAreWalkedDown) {
  const closed_loop::RunResult result =
      closed_loop::run_closed_loop(scenario("step_down", {"goal.walk_on=0.0"}), {});
  EXPECT_EQ(result.ending, closed_loop::Ending::goal_reached) << result.metrics.reason;
  EXPECT_FALSE(result.metrics.fell);
  EXPECT_FALSE(result.safety_stop);
  EXPECT_EQ(result.metrics.succeeded, true);
}

TEST(StepDown, NothingIsAllocatedWhileAFootProbesSearchesAndTheGaitWaits) {
  Loop loop(scenario("step_down", {}));
  loop.tick();
  const std::size_t first = loop.allocations();
  loop.run_until(30.0, [&] { return loop.count(PlanEvent::probe_edge) == 2; });
  EXPECT_EQ(loop.allocations(), first) << "the last at " << loop.last_allocation() << " s";
  EXPECT_GE(loop.count(PlanEvent::late), 1);
  EXPECT_EQ(loop.count(PlanEvent::probe_edge), 2);
}

}  // namespace
}  // namespace surefoot
