#include "server/live_operator.hpp"

#include "server/view_tasks.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/config/stack_text.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot::server {
namespace {

using Type = ViewCommandType;

class LiveOperatorTest : public ::testing::Test {
 protected:
  LiveOperatorTest() { operator_.begin({"base", "LF_SHANK"}); }

  std::string push(const std::string& body, const Vec3& impulse, double duration) {
    return operator_.command(
        {.type = Type::push, .body = body, .impulse = impulse, .duration = duration});
  }
  std::string gain(const std::string& level, const std::string& name, double value) {
    return operator_.command(
        {.type = Type::gain, .level = level, .task = level, .name = name, .value = value});
  }
  OperatorWishes taken() {
    OperatorWishes wishes;
    EXPECT_TRUE(operator_.take(wishes));
    return wishes;
  }

  config::Scenario scenario_ =
      config::load_scenario({"walk_flat_ideal", 0, {"stack=terrain_adaptation"}});
  LiveOperator operator_{scenario_, ViewLimits()};
};

TEST_F(LiveOperatorTest, pushes_are_capped_and_the_caps_are_told) {
  EXPECT_EQ(push("base", Vec3(0, 20, 0), 0.2), "");
  EXPECT_EQ(taken().pushes.at(0).force, Vec3(0, 100, 0));
  for (const double size : {0.0, 61.0})
    EXPECT_TRUE(
        test::holds(push("base", Vec3(0, size, 0), 1.0), "valid is more than 0, up to 60 N·s"));
  EXPECT_TRUE(test::holds(push("base", Vec3(0, 60, 0), 0.1), "a duration of at least 0.2 s"));
  EXPECT_TRUE(test::holds(push("base", Vec3(0, 59, 0), 0.1), "a duration of at least 0.197 s"));
  EXPECT_EQ(push("base", Vec3(0, 59, 0), 0.197), "") << "what is told to be valid is";
  EXPECT_EQ(taken().pushes.size(), 1U);
  EXPECT_TRUE(test::holds(push("base", Vec3(0, 1, 0), 2.0), "valid is 0.001 to 1 s"));
  EXPECT_TRUE(test::holds(push("LF_SHNK", Vec3(0, 1, 0), 0.1), "did you mean \"LF_SHANK\""));
  OperatorWishes wishes;
  EXPECT_FALSE(operator_.take(wishes)) << "what is refused changes nothing";
  EXPECT_EQ(operator_.command({.type = Type::pause}), "");
  EXPECT_TRUE(taken().pushes.empty()) << "each is handed over once";
}

TEST_F(LiveOperatorTest, ticks_that_wait_are_capped_and_a_pause_takes_them_back) {
  const auto step = [&](int ticks) {
    return operator_.command({.type = Type::step, .ticks = ticks});
  };
  for (int i = 0; i < 4; ++i) EXPECT_EQ(step(1000), "");
  EXPECT_TRUE(test::holds(step(1), "valid is up to 4000"));
  EXPECT_EQ(operator_.command({.type = Type::pause}), "");
  EXPECT_EQ(step(3), "");
  const OperatorWishes wishes = taken();
  EXPECT_TRUE(wishes.halt);
  EXPECT_EQ(wishes.steps, 3);
}

TEST_F(LiveOperatorTest, what_is_wrong_with_a_command_is_told_with_what_would_be_valid) {
  EXPECT_TRUE(test::holds(gain("com", "kp", 1.0), "com_xy"));
  EXPECT_TRUE(test::holds(gain("com_xy", "ki", 1.0), "kp"));
  EXPECT_TRUE(test::holds(gain("com_xy", "kp", -1.0), "valid is 0 to "));
  EXPECT_TRUE(test::holds(gain("com_xy", "kp", 1e6), "valid is 0 to "));
  EXPECT_TRUE(test::holds(operator_.command({.type = Type::friction, .value = 0.0}), "valid is"));
  EXPECT_TRUE(test::holds(operator_.command({.type = Type::speed, .factor = 100.0}), "to 8"));
  EXPECT_TRUE(test::holds(
      operator_.command({.type = Type::walk, .walk = true, .velocity = Vec2(3, 0)}), "m/s"));
}

TEST_F(LiveOperatorTest, a_refusal_names_the_level_and_gives_every_number_its_unit) {
  EXPECT_TRUE(test::holds(gain("com_xy", "kp", 1e6), "com_xy kp is 1e+06 1/s²; valid is 0 to "));
  EXPECT_TRUE(test::holds(push("base", Vec3(200, 0, 0), 0.2),
                          "the impulse's size is 200 N·s; valid is more than 0, up to 60 N·s"));
  control::LevelSpec merged = scenario_.controller.stack.levels.back();
  merged.name = "motion";
  EXPECT_EQ(task_title(merged, merged.tasks.at(0)), "motion, " + merged.tasks.at(0).task);
}

TEST_F(LiveOperatorTest, a_bound_beyond_the_robots_reach_is_refused_as_a_scenario_with_it_is) {
  EXPECT_TRUE(test::holds(gain("limb_extension_limits", "max", 5.2), "valid is 0 to 0.571 m"));
  EXPECT_TRUE(test::holds(gain("limb_extension_limits", "min", 0.6), "valid is 0 to "));
  EXPECT_EQ(gain("limb_extension_limits", "max", 0.57), "");
  EXPECT_TRUE(test::holds(
      test::message_of([] {
        (void)config::load_scenario(
            {"walk_flat_ideal",
             0,
             {"stack=terrain_adaptation", "tasks.limb_extension_limits.max=5.2"}});
      }),
      "tasks: limb_extension_limits: max is 5.2, but this robot reaches only 0.5713 m"));
}

TEST_F(LiveOperatorTest, an_order_must_have_all_levels_and_those_of_the_physics_above) {
  std::vector<std::string> order;
  for (const control::LevelSpec& level : scenario_.controller.stack.levels)
    order.push_back(level.name);
  const auto asked = [&](const std::vector<std::string>& levels) {
    return operator_.command({.type = Type::order, .levels = levels});
  };
  EXPECT_TRUE(test::holds(asked({order[0]}), "all"));
  std::vector<std::string> twice = order;
  twice.back() = twice.front();
  EXPECT_NE(asked(twice), "");
  std::vector<std::string> upside_down(order.rbegin(), order.rend());
  EXPECT_TRUE(test::holds(asked(upside_down), "keeps the physics"));
  std::iter_swap(order.end() - 1, order.end() - 2);
  EXPECT_EQ(asked(order), "");
  EXPECT_EQ(taken().control.stack.levels.back().name, order.back());
}

TEST_F(LiveOperatorTest, after_its_end_a_run_can_only_be_begun_again) {
  operator_.set_ended("fell");
  const std::string error = push("base", Vec3(0, 1, 0), 0.1);
  EXPECT_TRUE(test::holds(error, "fell")) << error;
  EXPECT_TRUE(test::holds(error, "reset")) << error;
  EXPECT_EQ(operator_.command({.type = Type::reset}), "");
  EXPECT_TRUE(taken().reset);
}

TEST(ViewLimits, GoWithTheRobotsSizeInTwoDigits) {
  const ViewLimits reference = limits_for({}), limits;
  EXPECT_EQ(reference.push_impulse, limits.push_impulse);
  EXPECT_EQ(reference.walk_height, limits.walk_height);
  const ViewLimits small = limits_for({.length = 0.36, .mass = 0.1});
  EXPECT_EQ(small.push_impulse, 3.6);
  EXPECT_EQ(small.push_force, 30.0);
  EXPECT_EQ(small.walk_velocity, 0.3);
  EXPECT_EQ(small.walk_yaw_rate, 1.0);
  EXPECT_EQ(small.walk_height, 0.036);
}

}  // namespace
}  // namespace surefoot::server
