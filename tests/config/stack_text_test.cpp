#include "surefoot/config/stack_text.hpp"

#include "surefoot/config/data_file.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/tasks/catalog.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

namespace surefoot::config {
namespace {

using test::holds;

control::StackOptions read(const std::string& text) {
  const test::TemporaryFolder folder;
  test::write_file(folder / "stack.yaml", text);
  return load_stack(folder / "stack.yaml");
}

void expect_same(const control::StackOptions& stack, const control::StackOptions& other) {
  EXPECT_EQ(stack.name, other.name);
  ASSERT_EQ(stack.levels.size(), other.levels.size());
  for (std::size_t i = 0; i < stack.levels.size(); ++i) {
    const control::LevelSpec &level = stack.levels[i], &other_level = other.levels[i];
    EXPECT_EQ(level.name, other_level.name);
    EXPECT_EQ(level.damping, other_level.damping);
    ASSERT_EQ(level.tasks.size(), other_level.tasks.size());
    for (std::size_t k = 0; k < level.tasks.size(); ++k) {
      EXPECT_EQ(level.tasks[k].task, other_level.tasks[k].task);
      EXPECT_EQ(level.tasks[k].numbers, other_level.tasks[k].numbers);
      EXPECT_EQ(level.tasks[k].choices, other_level.tasks[k].choices);
      EXPECT_EQ(level.tasks[k].weight, other_level.tasks[k].weight);
    }
  }
}

TEST(StackText, every_shipped_stack_reads_back_without_its_base) {
  for (const std::string& name : list_data("stacks")) {
    SCOPED_TRACE(name);
    const control::StackOptions stack = with_defaults(load_stack(name));
    const std::string text = stack_yaml(stack);
    EXPECT_FALSE(holds(text, "base:"));
    expect_same(read(text), stack);
  }
}

TEST(StackText, odd_names_and_numbers_read_back_bit_by_bit) {
  control::StackOptions stack{.name = "a \"b\": #c, {d}", .levels = {}};
  stack.levels = {{.name = "no", .tasks = {{"com_xy", {{"kp", 0.1 + 0.2}, {"kd", 1e-17}}, {}}}},
                  {.name = "- two\ttasks",
                   .tasks = {{"torque_limits", {}, {}}, {"swing_foot", {{"kp", 1e300}}, {}, 0.3}},
                   .damping = 0.02}};
  expect_same(read(stack_yaml(stack)), stack);
}

TEST(StackText, defaults_are_written_and_what_is_given_stays) {
  control::StackOptions stack{.name = "s", .levels = {}};
  stack.levels = {{.name = "legs", .tasks = {{"limb_extension_limits", {{"max", 0.5}}, {}}}}};
  const control::TaskSpec task = with_defaults(stack).levels[0].tasks[0];
  const tasks::TaskInfo& info = tasks::task_info("limb_extension_limits");
  EXPECT_EQ(task.numbers.size(), info.parameters.size());
  EXPECT_EQ(task.choices.size(), info.choices.size());
  EXPECT_EQ(task.numbers.at("max"), 0.5);
  for (const tasks::TaskParameter& parameter : info.parameters) {
    if (parameter.name == "min") {
      EXPECT_EQ(task.numbers.at("min"), parameter.default_value);
    }
  }
}

}  // namespace
}  // namespace surefoot::config
