// Frames of any part follow commands in simulation, by the truth.
#include "surefoot/model/frames.hpp"

#include "surefoot/config/stack_file.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/model/robot_model.hpp"
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace surefoot {
namespace {

/// A scenario whose stack has a task for a frame above another level.
struct Followed {
  Followed(const std::vector<std::string>& changes, const std::string& below,
           const std::string& task, const std::string& frame, const std::string& held_in)
      : scenario(test::scenario("walk_flat", changes)),
        frames(scenario.robot),
        model(scenario.robot),
        number(frames.number(frame)) {
    control::StackOptions stack =
        config::load_stack("terrain_adaptation", {}, scenario.robot.scale);
    std::vector<control::LevelSpec>& levels = stack.levels;
    const auto next = std::ranges::find(levels, below, &control::LevelSpec::name);
    levels.insert(next,
                  {.name = "followed",
                   .tasks = {{.task = task, .choices = {{"frame", frame}, {"held_in", held_in}}}}});
    scenario.controller.stack = config::with_scaled_arms(stack, scenario.robot);
  }
  /// The frame by the truth, in S or B.
  model::FrameKinematics at(const test::Loop& loop, bool in_world) {
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
    return in_world ? frame : relative_to_base(frame, dynamics);
  }

  config::Scenario scenario;
  model::Frames frames;
  model::RobotModel model;
  int number;
};

constexpr double kCommanded = 2.0, kEnd = 6.0;  // [s]
const std::vector<std::string> kStanding{"user=[{time: 0}]", "planner.calibration.duration=0"};

/// Motion by the truth of a frame of a standing robot that is asked to move and turn in W.
struct Way {
  Vec3 p, turn;  // [m], [rad]
};

Way way_of(Followed followed, const Way& asked) {
  test::Loop before(followed.scenario);
  before.run_until(kCommanded);
  const FramePlan plan = *before.record().plan.frames.find(followed.number);
  UserCommand command;
  command.reach = {
      .in_world = true,
      .position = plan.p_XF + asked.p,
      .orientation = roll_pitch_yaw((exp_rotation(asked.turn) * plan.q_XF).toRotationMatrix()),
      .frame = followed.number};
  followed.scenario.commands.push_back({.time = kCommanded, .user = command});
  test::Loop loop(followed.scenario);
  loop.run_until(kCommanded);
  const model::FrameKinematics first = followed.at(loop, true);
  loop.run_until(kEnd);
  const model::FrameKinematics last = followed.at(loop, true);
  EXPECT_EQ(loop.record().command.mode, CommandMode::optimal);
  EXPECT_EQ(loop.allocations(), 0U) << loop.last_allocation();
  return {last.point.p - first.point.p, box_minus(Quat(last.rotation.R), Quat(first.rotation.R))};
}

TEST(FramesOfAStandingRobot, APlaceOfTheTorsoGoesWhereACommandSays) {
  const Vec3 asked(0.0, 0.0, -0.03);
  const Way way = way_of({kStanding, "torso_yaw", "frame_position", "RF_HAA", "world"},
                         {.p = asked, .turn = Vec3::Zero()});
  EXPECT_LT((way.p - asked).norm(), 0.006) << way.p.transpose();
}

TEST(FramesOfAStandingRobot, AShankTurnsAsACommandSays) {
  const Vec3 asked(0.0, 0.06, 0.0);
  const Way way = way_of({kStanding, "torso_yaw", "frame_orientation", "LF_SHANK", "world"},
                         {.p = Vec3::Zero(), .turn = asked});
  EXPECT_LT((way.turn - asked).norm(), 0.015) << way.turn.transpose();
}

// Below the centre of mass the arm would be thrown about to save that where contacts change.
TEST(FramesOfAWalkingRobot, AHandIsHeldInTheBase) {
  Followed followed({"robot=anymal_b_kinova"}, "com_xy", "frame_position", "kinova", "base");
  test::Loop loop(followed.scenario);
  loop.run_until(11.0);
  const Vec3 first = followed.at(loop, false).point.p;
  double farthest = 0.0;
  loop.run_until(22.0, [&] {
    farthest = std::max(farthest, (followed.at(loop, false).point.p - first).norm());
    return false;
  });
  EXPECT_GT(loop.steps_taken(), 10);
  EXPECT_LT(farthest, 0.05) << "of a metre of arm, with drives that lag";
  EXPECT_EQ(loop.record().command.cause, StopCause::none);
}

}  // namespace
}  // namespace surefoot
