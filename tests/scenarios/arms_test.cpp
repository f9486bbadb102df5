// Robots with arms walk by the stacks of the others, and their hands follow the operator.
#include "surefoot/base/error.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/scenario_file.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

evaluation::Metrics walked(const std::string& scenario, std::vector<std::string> assignments = {}) {
  return closed_loop::run_closed_loop(config::load_scenario({scenario, 1, std::move(assignments)}),
                                      {})
      .metrics;
}

TEST(Arms, AreHeldWhileTheRobotWalks) {
  for (const char* robot : {"anymal_b_kinova", "b1_z1"}) {
    const evaluation::Metrics metrics = walked("walk_flat", {std::string("robot=") + robot});
    EXPECT_TRUE(metrics.succeeded) << robot << ": " << metrics.reason;
    EXPECT_EQ(metrics.false_touchdowns, 0) << robot;
    EXPECT_EQ(metrics.fallback_ticks, 0) << robot;
  }
}

TEST(Arms, FollowTheOperatorStandingAndWalking) {
  const evaluation::Metrics metrics = walked("reach");
  EXPECT_TRUE(metrics.succeeded) << metrics.reason << ", hand " << metrics.reach_error_max_m;
}

TEST(Arms, ThatTheRobotDoesNotHaveCanNotReach) {
  try {
    (void)config::load_scenario({"reach", 1, {"robot=anymal_b"}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("reach.arm: is 0, but the robot has no arms"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace surefoot
