// Feet and shanks that meet a step which nobody knew of.
#include "surefoot/closed_loop/closed_loop.hpp"
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::scenario;

// Feet that rise by 8 cm hit the face of a step of 15 cm, and so do shanks.
TEST(StepUp, FeetThatMeetItsFaceOnTheirWayGoUpAndOver) {
  const closed_loop::RunResult result = closed_loop::run_closed_loop(
      scenario("step_up", {"planner.swing.apex=0.08", "goal.walk_on=0.0"}, 1), {});
  int caught = 0;
  for (const evaluation::EventCount& event : result.events) {
    if (event.event == PlanEvent::caught) caught += event.count;
  }
  EXPECT_GE(caught, 2) << "both front feet";
  EXPECT_GE(result.metrics.shank_contacts, 1);
  EXPECT_EQ(result.ending, closed_loop::Ending::goal_reached) << result.metrics.reason;
  EXPECT_FALSE(result.metrics.fell);
  EXPECT_FALSE(result.safety_stop);
}

}  // namespace
}  // namespace surefoot
