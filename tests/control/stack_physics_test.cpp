// A stack that the robot can't move by is refused, or what it lacks is told.
#include "surefoot/config/stack_file.hpp"
#include "tests/control/statue.hpp"
#include "tests/support/messages.hpp"

#include <algorithm>

namespace surefoot::control {
namespace {

StackOptions stack_without(const std::string& level) {
  StackOptions stack = test::options_of().stack;
  std::erase_if(stack.levels, [&](const LevelSpec& spec) { return spec.name == level; });
  return stack;
}

std::string refusal_of(const StackOptions& stack) {
  ControllerOptions options = test::options_of();
  options.stack = stack;
  return test::message_of([&] { test::Statue statue(options); });
}

TEST(StackPhysics, AStackWithoutTheEquationsOfMotionIsRefused) {
  const std::string text = refusal_of(stack_without("equations_of_motion"));
  EXPECT_TRUE(test::holds(text, "the stack \"terrain_adaptation\" has no equations_of_motion: "));
  EXPECT_TRUE(test::holds(text, "valid is a stack that begins with equations_of_motion"));
}

TEST(StackPhysics, NothingElseMayStandAboveThemOrBesideThem) {
  StackOptions above = test::options_of().stack, beside = above;
  above.levels.insert(above.levels.begin(),
                      {.name = "tilt", .tasks = {{.task = "torso_tilt_limits"}}});
  EXPECT_TRUE(test::holds(refusal_of(above), "has torso_tilt_limits above equations_of_motion"));
  beside.levels.front().tasks.push_back({.task = "com_xy"});
  EXPECT_TRUE(test::holds(refusal_of(beside), "has com_xy beside equations_of_motion"));
  StackOptions physics = test::options_of().stack;
  std::swap(physics.levels[0], physics.levels[1]);
  EXPECT_NO_THROW(check_physics(physics)) << "what keeps the physics has any order";
}

TEST(StackPhysics, AChangeToSuchAStackIsRefused) {
  test::Statue statue;
  statue.run(3);
  StackOptions last = test::options_of().stack;
  std::rotate(last.levels.begin(), last.levels.begin() + 1, last.levels.end());
  EXPECT_TRUE(test::holds(test::message_of([&] { (void)statue.controller.set_stack(last); }),
                          " above equations_of_motion"));
}

TEST(StackPhysics, WhatElseIsMissingIsToldWithItsConsequence) {
  EXPECT_TRUE(missing_physics(test::options_of().stack).empty());
  for (const auto& [level, consequence] : {std::pair{"no_contact_motion", "it falls"},
                                           {"torque_limits", "cut off"},
                                           {"friction_cone", "slide"}}) {
    ControllerOptions options = test::options_of();
    options.stack = stack_without(level);
    const std::vector<std::string> notes = test::Statue(options).controller.notes();
    ASSERT_FALSE(notes.empty()) << level;
    EXPECT_TRUE(test::holds(notes.back(), std::string("has no ") + level));
    EXPECT_TRUE(test::holds(notes.back(), consequence));
  }
}

// At a stop the drive's torque looks like a force of the ground.
TEST(StackPhysics, StopsThatThighsStandNearComeBeforeTheSwingFeet) {
  const StackOptions stack = test::options_of().stack;
  model::RobotDescription robot = test::anymal_b();
  EXPECT_EQ(with_stops(stack, robot).levels.size(), stack.levels.size());
  const Eigen::Index thigh = first_joint(Leg::LF) + 1;
  robot.q_max[thigh] = robot.q_nominal[thigh] + 0.1;
  const StackOptions fitted = with_stops(stack, robot);
  const auto swing = std::ranges::find(fitted.levels, "swing_foot", &LevelSpec::name);
  ASSERT_NE(swing, fitted.levels.end());
  EXPECT_EQ((swing - 1)->name, "joint_position_limits");
  EXPECT_EQ(with_stops(fitted, robot).levels.size(), stack.levels.size() + 1);
  StackOptions of_arms = stack;
  TaskSpec& limits =
      of_arms.levels.emplace_back(LevelSpec{.name = "own", .tasks = {}}).tasks.emplace_back();
  limits.task = "joint_position_limits";
  limits.choices["joints"] = "arms";
  EXPECT_EQ(with_stops(of_arms, robot).levels.size(), of_arms.levels.size() + 1);
}

}  // namespace
}  // namespace surefoot::control
