// Robots with arms walk by the stacks of the others, and their hands follow the operator.
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "tests/scenarios/loop.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

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
    EXPECT_EQ(metrics.succeeded, true) << robot << ": " << metrics.reason;
    EXPECT_EQ(metrics.false_touchdowns, 0) << robot;
    EXPECT_EQ(metrics.fallback_ticks, 0) << robot;
  }
}

TEST(Arms, KeepTheirPostureInTheWalk) {
  const config::Scenario scenario = test::scenario("walk_flat", {"robot=anymal_b_kinova"}, 1);
  test::Loop loop(scenario);
  const JointVector& q_nominal = scenario.robot.q_nominal;
  double off = 0.0;  // largest error of an arm's joint [rad]
  const auto watch = [&] {
    const Eigen::Index count = q_nominal.size() - kNumLegJoints;
    off = std::max(off, (loop.truth().q - q_nominal).tail(count).cwiseAbs().maxCoeff());
    return false;
  };
  loop.run_until(13.0, watch);
  EXPECT_LT(off, 0.05);
  EXPECT_EQ(loop.allocations(), 0U) << loop.last_allocation();
}

TEST(Arms, LightJointsKeepStillAsTheRobotGetsUp) {
  test::Loop loop(test::scenario("lying_start", {"robot=b1_z1"}, 1));
  double fastest = 0.0;  // of an arm's joint [rad/s]
  loop.run_until(2.0, [&] {
    fastest = std::max(fastest, loop.truth().qd.tail(7).cwiseAbs().maxCoeff());
    return loop.record().command.cause != StopCause::none;
  });
  EXPECT_EQ(loop.record().command.cause, StopCause::none);
  EXPECT_LT(fastest, 5.0);
}

TEST(Arms, FollowTheOperatorStandingAndWalking) {
  const evaluation::Metrics metrics = walked("reach");
  EXPECT_EQ(metrics.succeeded, true) << metrics.reason << ", hand " << metrics.reach_error_max_m;
}

// Beyond its reach, straight up from its shoulder, and behind a singular posture.
TEST(Arms, KeepStillWhereTheTipCanNotFollow) {
  for (const auto& [robot, target] : {std::pair{"anymal_b_kinova", "[0.7, 0, 1.6]"},
                                      {"anymal_b_kinova", "[0.3, 0.9, 0.3]"},
                                      {"b1_z1", "[2.5, 0, 0.8]"},
                                      {"spot_arm", "[1.0, 0, 0.8]"}}) {
    const std::string user = std::string("user=[{time: 10, reach: {arm: 0, position: ") + target +
                             "}}, {time: 20, reach: {arm: 0, position: [0.6, 0, 0.5]}}]";
    const evaluation::Metrics metrics =
        walked("reach", {std::string("robot=") + robot, user, "duration=28", "criteria=none"});
    EXPECT_EQ(metrics.succeeded, true) << robot << target << ": " << metrics.reason;
    EXPECT_LT(metrics.max_tilt_rad, 0.1) << robot << target;
    EXPECT_LT(metrics.fallback_ticks, 5) << robot << target;
  }
}

TEST(Arms, ThatTheRobotDoesNotHaveCanNotReachAndThoseThatNoTaskFollowsAreTold) {
  const auto error_of = [](std::vector<std::string> assignments) {
    return test::message_of(
        [&] { (void)config::load_scenario({"reach", 1, std::move(assignments)}); });
  };
  EXPECT_TRUE(
      test::holds(error_of({"robot=anymal_b"}), "reach.arm: is 0, but the robot has no arms"));
  const std::vector<std::string> notes =
      config::load_scenario({"reach", 1, {"stack=flat_feet"}}).notes;
  EXPECT_TRUE(std::ranges::any_of(notes, [](const std::string& note) {
    return test::holds(note, "at 10 s, reach.arm: no task of the stack \"flat_feet\" follows");
  }));
}

}  // namespace
}  // namespace surefoot
