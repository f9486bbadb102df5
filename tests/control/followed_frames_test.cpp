// Frames that tasks follow, in the controller: references from the first tick on, commands,
// changes.
#include "tests/control/statue.hpp"
#include "tests/support/messages.hpp"

namespace surefoot::control {
namespace {

/// The paper's stack with a task for a frame below the centre of mass.
ControllerOptions following(const std::string& frame, const std::string& held_in = "base") {
  ControllerOptions options = test::options_of();
  options.stack.levels.insert(options.stack.levels.begin() + 5,
                              {.name = "frame",
                               .tasks = {{.task = "frame_position",
                                          .numbers = {},
                                          .choices = {{"frame", frame}, {"held_in", held_in}}}}});
  return options;
}

std::string error_of(const StackOptions& stack) {
  ControllerOptions options = test::options_of();
  options.stack = stack;
  return test::message_of([&] { test::Statue statue(options); });
}

TEST(FollowedFrames, AreInThePlanFromTheFirstTick) {
  test::Statue statue(following("base", "world"));
  statue.run(3);
  const FrameList& frames = statue.controller.record().plan.frames;
  ASSERT_EQ(frames.count, 1u);
  EXPECT_TRUE(frames.items[0].in_world);
  EXPECT_LT((frames.items[0].p_XF - statue.state.p_WB).norm(), 1e-12);
  EXPECT_EQ(statue.controller.record().command.mode, CommandMode::optimal);
  EXPECT_EQ(statue.controller.row_name(5, 2), "base z");
}

TEST(FollowedFrames, GoWhereTheCommandSays) {
  test::Statue statue(following("base", "world"));
  statue.run(3);
  const FramePlan first = statue.controller.record().plan.frames.items[0];
  statue.user.reach = {
      .in_world = true, .position = first.p_XF + Vec3(0.0, 0.0, 0.03), .frame = first.frame};
  statue.run(400);
  const FramePlan last = statue.controller.record().plan.frames.items[0];
  EXPECT_GT(last.p_XF.z(), first.p_XF.z() + 0.01);
}

TEST(FollowedFrames, OfANewStackAreFollowedFromThen) {
  test::Statue statue(following("LF_SHANK"));
  statue.run(3);
  const int before = statue.controller.record().plan.frames.items[0].frame;
  ASSERT_TRUE(statue.controller.set_stack(following("RF_SHANK").stack, 0.0));
  statue.run(3);
  ASSERT_EQ(statue.controller.record().plan.frames.count, 1u);
  EXPECT_NE(statue.controller.record().plan.frames.items[0].frame, before);
  EXPECT_EQ(statue.controller.record().command.mode, CommandMode::optimal);
}

TEST(FollowedFrames, ThatTheRobotHasNotOrThatAreHeldTwiceAreRefused) {
  EXPECT_TRUE(test::holds(error_of(following("LF_SHNK").stack),
                          "has no frame \"LF_SHNK\"; did you mean \"LF_SHANK\"?"));
  EXPECT_TRUE(test::holds(error_of(following("").stack),
                          "frame_position: no frame is given, and the robot anymal_b has no arm "
                          "whose tip could be meant; valid is the name of a link or joint"));
  ControllerOptions twice = following("LF_SHANK");
  twice.stack.levels.push_back(following("LF_SHANK", "world").stack.levels[5]);
  EXPECT_TRUE(
      test::holds(error_of(twice.stack),
                  "one task holds the frame \"LF_SHANK\" in the base, another in the world"));
}

}  // namespace
}  // namespace surefoot::control
