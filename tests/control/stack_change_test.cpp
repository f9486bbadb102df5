// What changes the controller between two ticks: another stack in the place of the present one, and
// the friction that it assumes.
#include "surefoot/base/error.hpp"
#include "tests/control/statue.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/messages.hpp"

#include <algorithm>

namespace surefoot::control {
namespace {

LevelSpec& level(StackOptions& stack, const std::string& name) {
  return *std::ranges::find(stack.levels, name, &LevelSpec::name);
}

/// Stiffer about the height, and the last two levels in another order.
StackOptions changed(StackOptions stack) {
  level(stack, "torso_height").tasks.at(0).numbers["kp"] = 3.0;
  std::iter_swap(stack.levels.end() - 1, stack.levels.end() - 2);
  return stack;
}

TEST(StackChange, ends_at_the_torques_of_the_new_stack_and_begins_at_those_of_the_old) {
  ControllerOptions options = test::options_of();
  test::Statue before(options), going(options);
  options.stack = changed(options.stack);
  test::Statue after(options);
  for (test::Statue* statue : {&before, &going, &after}) {
    statue->state.p_WB.z() -= 0.02;
    statue->run(40);
  }
  ASSERT_GT(
      (before.controller.record().command.torque - after.controller.record().command.torque).norm(),
      0.5);
  EXPECT_TRUE(going.controller.set_stack(options.stack, 0.1));
  for (test::Statue* statue : {&before, &going}) statue->run(1);
  EXPECT_LT(
      (before.controller.record().command.torque - going.controller.record().command.torque).norm(),
      1e-9);
  EXPECT_EQ(going.controller.record().hierarchy.transition_share, 0.0);
  EXPECT_FALSE(going.controller.record().hierarchy.blocking_is_known);
  for (test::Statue* statue : {&going, &after}) statue->run(60);
  EXPECT_EQ(going.controller.record().hierarchy.transition_share, 1.0);
  after.run(1);
  EXPECT_LT(
      (after.controller.record().command.torque - going.controller.record().command.torque).norm(),
      0.3)
      << "but for what they did meanwhile";
}

TEST(StackChange, the_controllers_names_are_those_of_the_new_stack) {
  const ControllerOptions options = test::options_of();
  test::Statue statue(options);
  const std::vector<std::string> before = statue.controller.level_names();
  EXPECT_TRUE(statue.controller.set_stack(changed(options.stack)));
  const std::vector<std::string> after = statue.controller.level_names();
  EXPECT_EQ(before[before.size() - 1], after[after.size() - 2]);
  const auto rows = statue.controller.row_names();
  ASSERT_EQ(rows.size(), after.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (std::size_t id = 0; id < rows[k].size(); ++id) {
      EXPECT_EQ(rows[k][id], statue.controller.row_name(static_cast<int>(k), static_cast<int>(id)));
    }
  }
}

TEST(StackChange, one_at_a_time) {
  const ControllerOptions options = test::options_of();
  test::Statue statue(options);
  statue.run(10);
  EXPECT_TRUE(statue.controller.set_stack(changed(options.stack), 0.05));
  EXPECT_FALSE(statue.controller.set_stack(options.stack, 0.05));
  EXPECT_FALSE(statue.controller.switch_levels({.remove = {"torso_yaw"}}));
  statue.run(30);
  EXPECT_TRUE(statue.controller.switch_levels({.remove = {"torso_yaw"}, .duration = 0.05}));
  EXPECT_FALSE(statue.controller.set_stack(options.stack, 0.05));
  statue.run(30);
  EXPECT_TRUE(statue.controller.set_stack(options.stack, 0.05));
}

TEST(StackChange, levels_that_are_out_stay_out) {
  const ControllerOptions options = test::options_of();
  test::Statue statue(options);
  EXPECT_TRUE(statue.controller.switch_levels({.remove = {"torso_yaw"}, .duration = 0.0}));
  statue.run(5);
  StackOptions stack = options.stack;
  std::iter_swap(std::ranges::find(stack.levels, "torso_yaw", &LevelSpec::name),
                 stack.levels.end() - 1);
  EXPECT_TRUE(statue.controller.set_stack(stack, 0.0));
  statue.run(5);
  const auto& levels = statue.controller.record().hierarchy.levels;
  EXPECT_EQ(levels[stack.levels.size() - 1].num_rows, 0) << "torso_yaw";
}

TEST(StackChange, a_tick_allocates_nothing_on_the_way) {
  const ControllerOptions options = test::options_of();
  test::Statue statue(options);
  statue.run(10);
  EXPECT_TRUE(statue.controller.set_stack(changed(options.stack), 0.05));
  const test::MallocCounter counter;
  statue.run(40);
  EXPECT_EQ(counter.count(), 0u);
}

TEST(StackChange, a_stack_with_other_levels_or_a_time_that_is_none_is_refused) {
  const ControllerOptions options = test::options_of();
  test::Statue statue(options);
  StackOptions stack = options.stack;
  stack.levels.pop_back();
  const std::string text = test::message_of([&] { (void)statue.controller.set_stack(stack); });
  EXPECT_TRUE(test::holds(text, "valid are those of the present one")) << text;
  EXPECT_THROW((void)statue.controller.set_stack(options.stack, -1.0), Error);
  stack = options.stack;
  level(stack, "com_xy").tasks.at(0).numbers["kp"] = -1.0;
  EXPECT_THROW((void)statue.controller.set_stack(stack), Error);
  statue.run(10);
  EXPECT_EQ(statue.controller.record().command.mode, CommandMode::optimal);
}

TEST(StackChange, friction_reaches_the_contact_forces_limits) {
  test::Statue statue;
  statue.run(10);
  statue.controller.set_friction(0.23);
  statue.run(1);
  for (const FootPlan& foot : statue.controller.record().plan.feet) {
    EXPECT_EQ(foot.friction, 0.23);
  }
  for (const double bad : {0.0, -0.5, kNaN, kInfinity}) {
    EXPECT_TRUE(
        test::holds(test::message_of([&] { statue.controller.set_friction(bad); }), "above 0"));
  }
}

}  // namespace
}  // namespace surefoot::control
