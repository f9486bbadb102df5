// Frames of any part follow commands in simulation, by the truth.
#include "surefoot/model/frames.hpp"

#include "surefoot/config/stack_file.hpp"
#include "surefoot/model/robot_model.hpp"
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>

namespace surefoot {
namespace {

/// A scenario whose stack has tasks for a frame above the torso's.
struct Followed {
  Followed(const std::string& name, const std::vector<std::string>& changes,
           const std::string& frame, const std::string& held_in)
      : scenario(test::scenario(name, changes)), frames(scenario.robot), model(scenario.robot) {
    control::StackOptions stack =
        config::load_stack("terrain_adaptation", {}, scenario.robot.scale);
    std::vector<control::LevelSpec>& levels = stack.levels;
    const auto yaw = std::ranges::find(levels, "torso_yaw", &control::LevelSpec::name);
    levels.insert(yaw, {.name = "followed",
                        .tasks = {{.task = "frame_position",
                                   .choices = {{"frame", frame}, {"held_in", held_in}}}}});
    scenario.controller.stack = config::with_scaled_arms(stack, scenario.robot);
    number = frames.number(frame);
  }
  /// Place of the frame, by the truth, in S or B.
  Vec3 place(const test::Loop& loop, bool in_world) {
    const simulation::GroundTruth& truth = loop.truth();
    RobotState state;
    state.size_legs(scenario.robot.num_legs());
    state.p_WB = truth.p_SB;
    state.q_WB = truth.q_SB;
    state.v_WB = state.w_WB_B = Vec3::Zero();
    state.q = truth.q;
    state.qd = JointVector::Zero(truth.q.size());
    const model::Dynamics& dynamics = model.update(state, Vec3::UnitZ());
    const model::FrameKinematics frame = frame_kinematics(frames[number], dynamics);
    return in_world ? frame.point.p : relative_to_base(frame, dynamics).point.p;
  }

  config::Scenario scenario;
  model::Frames frames;
  model::RobotModel model;
  int number = -1;
};

const std::vector<std::string> kStanding{"user=[{time: 0}]", "planner.calibration.duration=0"};

class FramesOfAStandingRobot : public testing::TestWithParam<std::tuple<const char*, Vec3>> {};

TEST_P(FramesOfAStandingRobot, FollowACommandInTheWorld) {
  const auto& [frame, way] = GetParam();
  Followed followed("walk_flat", kStanding, frame, "world");
  test::Loop before(followed.scenario);
  before.run_until(2.0);
  const FramePlan plan = *before.record().plan.frames.find(followed.number);
  UserCommand command;
  command.reach = {.in_world = true, .position = plan.p_XF + way, .frame = followed.number};
  followed.scenario.commands.push_back({.time = 2.0, .user = command});
  test::Loop loop(followed.scenario);
  loop.run_until(2.0);
  const Vec3 first = followed.place(loop, true);
  loop.run_until(6.0);
  EXPECT_LT((followed.place(loop, true) - first - way).norm(), 0.003) << frame;
  EXPECT_EQ(loop.record().command.mode, CommandMode::optimal);
  EXPECT_EQ(loop.allocations(), 0U) << loop.last_allocation();
}

// Of the torso the place of a hip, and a shank, whose knee moves as the torso does.
INSTANTIATE_TEST_SUITE_P(TorsoAndShank, FramesOfAStandingRobot,
                         testing::Values(std::tuple{"RF_HAA", Vec3(0.0, 0.0, -0.03)},
                                         std::tuple{"LF_SHANK", Vec3(0.0, 0.01, -0.015)}));

TEST(FramesOfAWalkingRobot, AHandIsHeldInTheBase) {
  Followed followed("walk_flat", {"robot=anymal_b_kinova"}, "kinova", "base");
  test::Loop loop(followed.scenario);
  loop.run_until(11.0);
  const Vec3 first = followed.place(loop, false);
  double farthest = 0.0;
  loop.run_until(22.0, [&] {
    farthest = std::max(farthest, (followed.place(loop, false) - first).norm());
    return false;
  });
  EXPECT_GT(loop.steps_taken(), 10);
  EXPECT_LT(farthest, 0.005);
  EXPECT_EQ(loop.record().command.cause, StopCause::none);
}

}  // namespace
}  // namespace surefoot
