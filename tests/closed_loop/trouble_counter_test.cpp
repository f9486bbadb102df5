#include "surefoot/closed_loop/trouble_counter.hpp"

#include "tests/support/anymal_b.hpp"

#include <gtest/gtest.h>

namespace surefoot::closed_loop {
namespace {

TickRecord tick(SampleFault imu = SampleFault::none, CommandMode mode = CommandMode::optimal) {
  TickRecord record;
  record.health.imu = {.fault = imu, .age = 0.005};
  record.command.mode = mode;
  return record;
}

TEST(TroubleCounter, TellsHowOftenASensorWasMarkedAndWhenFirst) {
  TroubleCounter troubles{test::anymal_b()};
  troubles.add(1.0, tick(), {});
  for (const double time : {2.0, 2.1, 4.0}) troubles.add(time, tick(SampleFault::silent), {});
  troubles.add(5.0, tick(), {});
  troubles.add(6.0, tick(SampleFault::silent), {});
  troubles.add(6.1, tick(SampleFault::jump), {});
  ASSERT_EQ(troubles.counts().size(), 2U);
  EXPECT_EQ(troubles.counts()[0].what, "IMU stopped");
  EXPECT_EQ(troubles.counts()[0].count, 2);
  EXPECT_EQ(troubles.counts()[0].first, 2.0);
  EXPECT_EQ(troubles.counts()[1].what, "IMU changed too fast");
  EXPECT_EQ(troubles.counts()[1].count, 1);
}

TEST(TroubleCounter, TellsOfTheModesThatEndAWalkOnceEach) {
  TroubleCounter troubles{test::anymal_b()};
  for (const CommandMode mode : {CommandMode::hold, CommandMode::optimal, CommandMode::degraded,
                                 CommandMode::sit, CommandMode::sit, CommandMode::damping}) {
    troubles.add(static_cast<double>(mode), tick(SampleFault::none, mode), {});
  }
  ASSERT_EQ(troubles.counts().size(), 2U);
  EXPECT_EQ(troubles.counts()[0].what, "command mode: sit");
  EXPECT_EQ(troubles.counts()[0].count, 1);
  EXPECT_EQ(troubles.counts()[1].what, "command mode: damping");
}

TEST(TroubleCounter, ASensorThatNeverGaveAGoodSampleIsNone) {
  TroubleCounter troubles{test::anymal_b()};
  TickRecord record = tick(SampleFault::silent);
  record.health.imu.age = kNaN;
  troubles.add(0.0, record, {});
  EXPECT_TRUE(troubles.counts().empty());
}

/// Arm 0 is told to reach 1 m; its reference and its tip are there or not, for a second and a half.
std::vector<TroubleCount> told_of_reach(double reference, double tip, int arm = 0,
                                        const Scale& scale = {}) {
  model::RobotDescription robot = test::anymal_b();
  robot.scale = scale;
  TroubleCounter troubles(robot);
  TickRecord record = tick();
  record.user.reach = {.arm = arm, .in_world = true, .position = Vec3(1.0, 0.0, 0.0)};
  record.plan.arm = {.arm = 0, .p_WT = Vec3(reference, 0.0, 0.0)};
  record.state.p_WB = Vec3(0.2, 0.0, 0.0);  // 10 cm off
  record.state.q_WB = Quat::Identity();
  simulation::GroundTruth truth;
  truth.p_SB = Vec3(0.1, 0.0, 0.0);
  truth.p_ST = {Vec3(tip - 0.1, 0.0, 0.0)};
  for (truth.time = 0.0; truth.time < 1.5; truth.time += 0.1)
    troubles.add(truth.time, record, truth);
  return troubles.counts();
}

TEST(TroubleCounter, TellsOnceOfATargetThatAnArmDoesNotComeTo) {
  EXPECT_TRUE(told_of_reach(1.0, 0.98).empty());
  EXPECT_TRUE(told_of_reach(0.81, 0.8).empty()) << "its reference is on its way";
  EXPECT_EQ(told_of_reach(0.82, 0.8).size(), 1U) << "its reference waits";
  const std::vector<TroubleCount> troubles = told_of_reach(1.0, 0.8);
  ASSERT_EQ(troubles.size(), 1U);
  EXPECT_EQ(troubles[0].what, "arm 0: can't get to its target");
  EXPECT_EQ(troubles[0].count, 1);
  EXPECT_NEAR(troubles[0].first, 1.1, 0.15);
}

TEST(TroubleCounter, TellsMoreOfASmallerRobotsArm) {
  const std::vector<TroubleCount> troubles = told_of_reach(1.0, 0.98, 0, Scale{.length = 0.25});
  ASSERT_EQ(troubles.size(), 1U);
  EXPECT_NEAR(troubles[0].first, 0.6, 0.15);
}

TEST(TroubleCounter, TellsOfAnArmThatThereIsNot) {
  const std::vector<TroubleCount> troubles = told_of_reach(0.0, 0.0, 3);
  ASSERT_EQ(troubles.size(), 1U);
  EXPECT_EQ(troubles[0].what, "told to reach with arm 3, which there is not");
}

/// The frame of this name, which is ahead of the base by its own place, and is told to reach
/// `ahead` of it, in the base; the plan is there, if it has the frame at all.
std::vector<TroubleCount> told_of_frame(std::string_view name, double ahead, bool is_followed) {
  const model::RobotDescription robot = test::anymal_b();
  const int number = model::Frames(robot).number(name);
  TroubleCounter troubles(robot);
  model::RobotModel model(robot);
  simulation::GroundTruth truth;
  truth.q = robot.q_nominal;
  RobotState state = tick().state;
  state.p_WB = state.v_WB = state.w_WB_B = Vec3::Zero();
  state.q_WB = Quat::Identity();
  state.q = truth.q;
  state.qd = JointVector::Zero(state.q.size());
  const Vec3 is =
      frame_kinematics(model::Frames(robot)[number], model.update(state, Vec3::UnitZ())).point.p;
  TickRecord record = tick();
  record.user.reach = {.position = is + Vec3(ahead, 0.0, 0.0), .frame = number};
  if (is_followed) record.plan.frames.add({.frame = number, .p_XF = record.user.reach.position});
  for (truth.time = 0.0; truth.time < 1.5; truth.time += 0.1)
    troubles.add(truth.time, record, truth);
  return troubles.counts();
}

TEST(TroubleCounter, TellsByNameOfAFrameThatDoesNotComeToItsTarget) {
  EXPECT_TRUE(told_of_frame("LF_SHANK", 0.02, true).empty());
  const std::vector<TroubleCount> troubles = told_of_frame("LF_SHANK", 0.1, true);
  ASSERT_EQ(troubles.size(), 1U);
  EXPECT_EQ(troubles[0].what, "LF_SHANK: can't get to its target");
}

TEST(TroubleCounter, TellsOfAFrameThatNoTaskFollows) {
  const std::vector<TroubleCount> troubles = told_of_frame("LF_SHANK", 0.1, false);
  ASSERT_EQ(troubles.size(), 1U);
  EXPECT_EQ(troubles[0].what, "told to reach with LF_SHANK, which no task follows");
}

}  // namespace
}  // namespace surefoot::closed_loop
