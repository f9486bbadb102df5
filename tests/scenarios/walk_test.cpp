#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/math/rotation.hpp"
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace surefoot {
namespace {

using test::Loop;
using test::scenario;

TEST(Walk, WithDelayLagAndNoiseItStillFollowsWithinAMillimetre) {
  const evaluation::Metrics metrics =
      closed_loop::run_closed_loop(scenario("walk_flat_sea", {"duration=5"}, 3), {}).metrics;
  EXPECT_FALSE(metrics.fell);
  EXPECT_LE(metrics.com_error_max_m, 0.001);
  EXPECT_GE(metrics.steps_taken, 5);
}

// At any moment of a step, blind and through the drives: back instead of forwards, to the other
// side, stop and go, and a height that the legs can't step with.
TEST(Walk, CommandsMayChangeAtAnyTime) {
  const UserCommand forwards{.walk = true, .velocity = {0.2, 0.0}},
      back{.walk = true, .velocity = {-0.2, 0.0}}, left{.walk = true, .velocity = {0.0, 0.1}},
      right{.walk = true, .velocity = {0.0, -0.1}}, mark_time{.walk = true},
      low{.walk = true, .velocity = {0.2, 0.0}, .height = -0.25};
  const std::vector<std::pair<UserCommand, UserCommand>> pairs{
      {forwards, back}, {left, right}, {forwards, left}, {forwards, mark_time}, {forwards, low}};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (const double time : {3.0, 3.15, 3.3, 3.45}) {
      config::Scenario changed = scenario("walk_flat", {"planner.calibration.duration=0"}, 1);
      changed.commands = {
          {0.5, pairs[i].first}, {time, pairs[i].second}, {time + 1.0, pairs[i].first}};
      Loop loop(changed);
      loop.run_until(8.0);
      EXPECT_EQ(loop.record().command.mode, CommandMode::optimal) << i << " at " << time;
      EXPECT_EQ(loop.count(PlanEvent::push_step), 0) << i << " at " << time;
    }
  }
}

TEST(Walk, NothingIsAllocatedAfterTheFirstTick) {
  Loop loop(scenario("walk_flat", {"planner.calibration.duration=0"}));
  loop.tick();
  const std::size_t first = loop.allocations();
  loop.run_until(6.0);
  EXPECT_EQ(loop.allocations(), first) << "the last at " << loop.last_allocation() << " s";
  EXPECT_GE(loop.count(PlanEvent::touchdown), 7);
  EXPECT_GE(loop.count(PlanEvent::lift_off), 7);
}

// Of a robot with links that weigh other than modelled, once each leg has swung.
TEST(Walk, KnowsItsCenterOfMassBetterWhereItWeighsItsLegsInTheAir) {
  const auto com_error = [](bool weighs) {
    Loop loop(scenario(
        "walk_flat",
        {"disturbances.link_mass_scale.LF_THIGH=1.3", "disturbances.link_mass_scale.LF_SHANK=1.3",
         "disturbances.link_mass_scale.RH_THIGH=0.7", "disturbances.link_mass_scale.RH_SHANK=0.7",
         std::string("link_masses.enabled=") + (weighs ? "true" : "false")},
        5));
    loop.run_until(16.0);
    Vec2 sum = Vec2::Zero();
    int count = 0;
    while (loop.truth().time < 20.0) {
      loop.tick();
      Vec3 believed = loop.record().model.p_WCom, truth = loop.truth().p_SCom;
      for (const Leg leg : kLegs) {
        believed -= loop.record().model.p_WF[index(leg)] / kNumLegs;
        truth -= loop.truth().p_SF[index(leg)] / kNumLegs;
      }
      const Mat3 turn = Eigen::AngleAxisd(yaw(loop.truth().q_SB.toRotationMatrix()) -
                                              yaw(loop.record().state.q_WB.toRotationMatrix()),
                                          Vec3::UnitZ())
                            .toRotationMatrix();
      sum += (truth - turn * believed).head<2>();
      ++count;
    }
    return sum.norm() / count;
  };
  const double without = com_error(false), with = com_error(true);
  EXPECT_GT(without, 0.001);
  EXPECT_LT(with, 0.5 * without);
}

// In the turn, and from the beginning of the weighing to shortly before its end.
TEST(Walk, APushBeforeItDoesNotHideAPayload) {
  // Early in the turn it goes unnoticed beside what follows; later the robot does so once more.
  for (const auto& [time, again] : {std::pair("3", 0), std::pair("4.5", 1), std::pair("7.3", 1)}) {
    const config::Scenario pushed =
        scenario("walk_flat",
                 {"disturbances.payload.mass=6", "duration=23",
                  std::string("disturbances.pushes.kick={duration: 1, force: [30, 20, 0], time: ") +
                      time + "}"},
                 2);
    Loop loop(pushed);
    loop.run_until(22.0);
    EXPECT_EQ(loop.count(PlanEvent::calibration_disturbed), again) << time;
    EXPECT_EQ(loop.count(PlanEvent::calibration), again) << time;
    EXPECT_NEAR(loop.record().model.load.mass, 6.0, 0.5) << time;
    EXPECT_GT(loop.count(PlanEvent::touchdown), 0) << time;
    EXPECT_LT(closed_loop::run_closed_loop(pushed, {}).metrics.com_error_max_m, 0.0025)
        << time << ": what it did not know yet counts apart";
  }
}

TEST(Walk, BeginsItsEstimateAnewWhenItIsAskedTo) {
  config::Scenario asked = scenario("walk_flat", {"planner.calibration.duration=3"}, 4);
  asked.commands.push_back(asked.commands.back());
  asked.commands.back().time = 9.0;
  asked.commands.back().user.calibrate = true;
  Loop loop(asked);
  loop.tick();
  const std::size_t first = loop.allocations();
  RobotState before;
  loop.run_until(20.0, [&] {
    before = loop.record().state;
    return loop.count(PlanEvent::calibration) > 0;
  });
  ASSERT_EQ(loop.count(PlanEvent::calibration), 1);
  const int steps = loop.steps_taken();
  ASSERT_GE(steps, 1);
  JointVector torque = loop.record().command.torque;
  loop.tick();
  const RobotState& now = loop.record().state;
  EXPECT_LT((now.p_WB - before.p_WB).norm(), 1e-3);
  EXPECT_LT(box_minus(now.q_WB, before.q_WB).norm(), 0.01);
  double greatest = 0.0;
  while (loop.truth().time < 22.0) {
    greatest = std::max(greatest, (loop.record().command.torque - torque).cwiseAbs().maxCoeff());
    torque = loop.record().command.torque;
    loop.tick();
  }
  EXPECT_LT(greatest, 8.0) << "N·m within a tick: as at a touchdown";
  EXPECT_GE(loop.steps_taken(), steps + 2) << "and walks on";
  EXPECT_EQ(loop.allocations(), first);
}

/// A walk as commanded from half a second on.
std::string walks(const std::string& command) {
  return "user=[{time: 0.5, walk: true, " + command + "}]";
}

TEST(Walk, TurnsOnTheSpotAsFastAsItsStridesAllow) {
  for (const char* yaw_rate : {"0.6", "-0.6"}) {
    Loop loop(scenario("walk_flat", {walks(std::string("yaw_rate: ") + yaw_rate)}, 1));
    loop.run_until(22.0);
    const int steps = loop.steps_taken();
    const double before = yaw(loop.truth().q_SB.toRotationMatrix());
    loop.run_until(28.0);
    EXPECT_GE(loop.steps_taken(), steps + 8) << yaw_rate;
    EXPECT_EQ(loop.record().command.mode, CommandMode::optimal) << yaw_rate;
    EXPECT_GT(loop.truth().p_SB.z(), 0.4) << yaw_rate;
    const double turned = yaw(loop.truth().q_SB.toRotationMatrix()) - before;
    EXPECT_GT(std::abs(std::remainder(turned, 2.0 * kPi)), 6.0 * 0.2) << yaw_rate;
  }
}

TEST(Walk, HeldHigherThanItsLegsReachItCalibratesAndWalks) {
  for (const char* velocity : {"0", "0.2"}) {
    Loop loop(scenario("walk_flat",
                       {walks(std::string("height: 0.1, velocity: [") + velocity + ", 0]")}, 1));
    loop.run_until(20.0);
    const int steps = loop.steps_taken();
    loop.run_until(25.0);
    EXPECT_GE(loop.steps_taken(), steps + 7) << velocity;
    EXPECT_EQ(loop.record().command.mode, CommandMode::optimal) << velocity;
    EXPECT_GT(loop.truth().p_SB.z(), 0.4) << velocity;
    EXPECT_EQ(loop.count(PlanEvent::lowered), 1) << velocity;
  }
}

// Its prints and its plane are of the estimate before: hind feet would look for ground that isn't
// there, centimetres above it.
TEST(Walk, AfterItCalibratedItselfOnTheWayItWalksAsBefore) {
  Loop loop(scenario("walk_flat",
                     {"user=[{time: 0.5, walk: true, velocity: [0.2, 0.0]}, {time: 14, walk: true, "
                      "velocity: [0.2, 0.0], calibrate: true}]"},
                     7));
  loop.run_until(31.0);
  EXPECT_EQ(loop.count(PlanEvent::calibration), 1);
  EXPECT_EQ(loop.count(PlanEvent::late), 0);
  EXPECT_GE(loop.steps_taken(), 12);
}

/// Every torque commanded in a short walk.
std::vector<JointVector> torques(std::uint64_t seed) {
  Loop loop(scenario("walk_flat_sea", {}, seed));
  std::vector<JointVector> commands;
  for (int tick = 0; tick < 1200; ++tick) {
    loop.tick();
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
