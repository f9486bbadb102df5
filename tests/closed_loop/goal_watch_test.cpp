#include "surefoot/closed_loop/goal_watch.hpp"

#include <gtest/gtest.h>

namespace surefoot::closed_loop {
namespace {

/// All four feet on the ground at these x, the base at another.
simulation::GroundTruth standing(const PerLeg<double>& feet_x, double base_x) {
  simulation::GroundTruth truth;
  truth.p_SB.x() = base_x;
  for (const Leg leg : kLegs) {
    truth.feet[index(leg)].touching = true;
    truth.p_SF[index(leg)].x() = feet_x[index(leg)];
  }
  return truth;
}

TEST(GoalWatch, without_a_goal_never_ends_a_run_and_says_nothing_of_one) {
  GoalWatch goal{config::Goal{}};
  EXPECT_FALSE(goal.update(standing({9, 9, 9, 9}, 9)));
  EXPECT_EQ(goal.reached(), std::nullopt);
}

TEST(GoalWatch, needs_all_feet_beyond_then_the_way_on) {
  GoalWatch goal({.feet_beyond_x = 0.5, .walk_on = 0.2});
  EXPECT_FALSE(goal.update(standing({0.9, 0.9, 0.6, 0.4}, 0.7)));
  EXPECT_FALSE(goal.update(standing({0.9, 0.9, 0.6, 0.6}, 0.7)));
  EXPECT_FALSE(goal.update(standing({1.0, 1.0, 0.7, 0.7}, 0.89)));
  EXPECT_EQ(goal.reached(), false);
  EXPECT_TRUE(goal.update(standing({1.1, 1.1, 0.8, 0.8}, 0.91)));
  EXPECT_EQ(goal.reached(), true);
}

TEST(GoalWatch, a_foot_in_the_air_is_not_down_beyond) {
  GoalWatch goal({.feet_beyond_x = 0.5, .walk_on = 0.0});
  simulation::GroundTruth truth = standing({0.9, 0.9, 0.6, 0.6}, 0.7);
  truth.feet[index(Leg::RH)].touching = false;
  EXPECT_FALSE(goal.update(truth));
  truth.feet[index(Leg::RH)].touching = true;
  EXPECT_TRUE(goal.update(truth));
}

}  // namespace
}  // namespace surefoot::closed_loop
