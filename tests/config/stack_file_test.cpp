#include "surefoot/config/stack_file.hpp"

#include "surefoot/config/data_file.hpp"
#include "surefoot/tasks/catalog.hpp"
#include "tests/config/messages.hpp"
#include "tests/logging/temporary_folder.hpp"

namespace surefoot {
namespace {

using test::holds;
using test::message_of;

std::vector<std::string> level_names(const StackOptions& stack) {
  std::vector<std::string> names;
  for (const LevelSpec& level : stack.levels) names.push_back(level.name);
  return names;
}

StackOptions read(const std::string& text) {
  const test::TemporaryFolder folder;
  test::write_file(folder / "s.yaml", text);
  return load_stack(folder / "s.yaml");
}

std::string complaint(const std::string& text) {
  return message_of([&] { (void)read(text); });
}

TEST(StackFile, terrain_adaptation_is_table_one_with_a_task_a_level) {
  EXPECT_EQ(level_names(load_stack("terrain_adaptation")),
            (std::vector<std::string>{"equations_of_motion", "no_contact_motion", "torque_limits",
                                      "friction_cone", "com_xy", "swing_foot",
                                      "limb_extension_limits", "torso_yaw", "torso_height",
                                      "torso_roll_pitch", "contact_force_minimisation"}));
}

TEST(StackFile, terrain_without_limits_leaves_out_only_level_seven) {
  StackOptions full = load_stack("terrain_adaptation");
  full.levels.erase(full.levels.begin() + 6);
  const StackOptions without = load_stack("terrain_without_limits");
  EXPECT_EQ(level_names(without), level_names(full));
  EXPECT_EQ(without.levels[4].tasks[0].numbers, full.levels[4].tasks[0].numbers);
}

TEST(StackFile, every_task_of_every_shipped_stack_can_be_made) {
  for (const std::string& name : list_data("stacks")) {
    for (const LevelSpec& level : load_stack(name).levels) {
      for (const TaskSpec& task : level.tasks) {
        EXPECT_NE(make_task(task.task, {task.numbers, task.choices}), nullptr) << name;
      }
    }
  }
}

TEST(StackFile, a_level_can_hold_several_tasks) {
  const StackOptions stack = read(
      "name: s\nlevels:\n"
      "  - {name: forces, tasks: [{task: torque_limits}, {task: friction_cone, pyramid: outer}]}\n"
      "  - {task: com_xy, name: balance, kp: 100}\n");
  EXPECT_EQ(level_names(stack), (std::vector<std::string>{"forces", "balance"}));
  EXPECT_EQ(stack.levels[0].tasks[1].choices.at("pyramid"), "outer");
  EXPECT_EQ(stack.levels[1].tasks[0].numbers.at("kp"), 100.0);
}

TEST(StackFile, an_unknown_task_lists_the_tasks) {
  const std::string message = complaint("name: s\nlevels:\n  - task: swing_feet\n");
  EXPECT_TRUE(holds(message, "s.yaml:3: levels.0.task: unknown task \"swing_feet\""));
  EXPECT_TRUE(holds(message, "did you mean \"swing_foot\"?"));
}

TEST(StackFile, an_unknown_parameter_lists_those_of_the_task) {
  const std::string message = complaint("name: s\nlevels:\n  - task: com_xy\n    kpp: 3\n");
  EXPECT_TRUE(holds(message, "s.yaml:4: levels.0.kpp"));
  EXPECT_TRUE(holds(message, "kp, kd, max_error"));
}

TEST(StackFile, a_negative_gain_and_an_unknown_form_are_told_with_their_lines) {
  EXPECT_TRUE(
      holds(complaint("name: s\nlevels:\n  - {task: com_xy, kp: -1}\n"), "s.yaml:3: levels.0.kp"));
  EXPECT_TRUE(holds(complaint("name: s\nlevels:\n  - {task: limb_extension_limits, form: round}\n"),
                    "s.yaml:3: levels.0.form"));
}

TEST(StackFile, a_nan_gain_is_told) {
  EXPECT_TRUE(holds(complaint("name: s\nlevels:\n  - {task: com_xy, kp: .nan}\n"), "\".nan\""));
}

TEST(StackFile, without_levels_says_so) {
  EXPECT_TRUE(holds(complaint("name: s\n"), "levels: this key is missing"));
  EXPECT_TRUE(holds(complaint("name: s\nlevels: []\n"), "at least one level"));
}

TEST(StackFile, leaving_out_a_level_that_is_not_there_lists_the_levels) {
  EXPECT_TRUE(holds(complaint("name: s\nbase: terrain_adaptation\nwithout: [limb_limits]\n"),
                    "s.yaml:3: without: unknown level \"limb_limits\""));
}

TEST(StackFile, what_is_left_out_must_be_a_list_of_levels) {
  for (const std::string without : {"limb_extension_limits", "", "[]", "{com_xy: 1}"}) {
    const std::string message =
        complaint("name: s\nbase: terrain_adaptation\nwithout: " + without + "\n");
    EXPECT_TRUE(holds(message, "s.yaml:3: without: must be a list of at least one level"));
    EXPECT_TRUE(holds(message, "valid are: equations_of_motion, no_contact_motion"));
  }
  EXPECT_TRUE(holds(complaint("name: s\nbase: terrain_adaptation\nwithout: [[com_xy]]\n"),
                    "s.yaml:3: without: a list of 1 is not a text"));
}

TEST(StackFile, levels_can_only_be_left_out_of_a_base) {
  for (const std::string levels : {"levels: [{task: com_xy}]\n", ""}) {
    EXPECT_TRUE(holds(complaint("name: s\nwithout: [com_xy]\n" + levels),
                      "s.yaml:2: without: needs a base"));
  }
}

TEST(StackFile, levels_of_a_base_are_taken_by_name_in_any_order_with_others_between) {
  const StackOptions stack = read(
      "name: s\nbase: terrain_adaptation\nlevels:\n  - swing_foot\n"
      "  - {task: body_height_limits, min: 0.25}\n  - com_xy\n");
  EXPECT_EQ(level_names(stack),
            (std::vector<std::string>{"swing_foot", "body_height_limits", "com_xy"}));
  const StackOptions base = load_stack("terrain_adaptation");
  EXPECT_EQ(stack.levels[0].tasks[0].numbers, base.levels[5].tasks[0].numbers);
  EXPECT_EQ(stack.levels[1].tasks[0].numbers.at("min"), 0.25);
  EXPECT_EQ(stack.levels[2].tasks[0].numbers, base.levels[4].tasks[0].numbers);
}

TEST(StackFile, a_level_by_a_name_that_the_base_has_not_lists_its_levels) {
  const std::string message =
      complaint("name: s\nbase: terrain_adaptation\nlevels:\n  - swing_feet\n");
  EXPECT_TRUE(holds(message, "s.yaml:4: levels.0: unknown level \"swing_feet\"")) << message;
  EXPECT_TRUE(holds(message, "did you mean \"swing_foot\"?")) << message;
  EXPECT_TRUE(
      holds(complaint("name: s\nlevels: [com_xy]\n"),
            "s.yaml:2: levels.0: unknown level \"com_xy\"; a level by its name needs a base"));
}

TEST(StackFile, what_levels_do_not_name_can_not_be_left_out_once_more) {
  EXPECT_TRUE(holds(complaint("name: s\nbase: walk\nlevels: [com_xy]\nwithout: [swing_foot]\n"),
                    "s.yaml:4: without: there are levels, too"));
}

TEST(StackFile, tasks_of_a_level_have_weights_and_a_level_its_damping) {
  const StackOptions stack = read(
      "name: s\nlevels:\n"
      "  - {name: both, weight: 2, damping: 0.1, tasks: [{task: com_xy, weight: 3}, {task: "
      "torso_yaw}]}\n"
      "  - {task: swing_foot, weight: 5, damping: 0.2, kp: 100}\n");
  EXPECT_EQ(stack.levels[0].tasks[0].weight, 6.0);
  EXPECT_EQ(stack.levels[0].tasks[1].weight, 2.0);
  EXPECT_EQ(stack.levels[0].damping, 0.1);
  EXPECT_EQ(stack.levels[1].tasks[0].weight, 5.0);
  EXPECT_EQ(stack.levels[1].damping, 0.2);
  EXPECT_EQ(stack.levels[1].tasks[0].numbers.at("kp"), 100.0);
}

TEST(StackFile, weights_and_dampings_that_are_none_are_told) {
  for (const std::string key : {"weight: 0", "weight: -1", "weight: heavy", "damping: -0.1"}) {
    const std::string message = complaint("name: s\nlevels:\n  - {task: com_xy, " + key + "}\n");
    EXPECT_TRUE(holds(message, "s.yaml:3: levels.0." + key.substr(0, key.find(':')))) << message;
  }
  EXPECT_TRUE(holds(complaint("name: s\nbase: walk\nweights: {com_xy: 0}\n"), "weights.com_xy"));
}

TEST(StackFile, a_stack_can_be_weighted_from_a_level_on) {
  const StackOptions stack =
      read("name: s\nbase: terrain_adaptation\nweights: {com_xy: 100}\nweighted_from: com_xy\n");
  EXPECT_EQ(level_names(stack),
            (std::vector<std::string>{"equations_of_motion", "no_contact_motion", "torque_limits",
                                      "friction_cone", "weighted"}));
  ASSERT_EQ(stack.levels[4].tasks.size(), 7u);
  EXPECT_EQ(stack.levels[4].tasks[0].weight, 100.0);
  EXPECT_EQ(stack.levels[4].tasks[1].weight, 1.0);
  EXPECT_EQ(stack.levels[4].tasks[1].task, "swing_foot");
}

TEST(StackFile, what_keeps_the_physics_cannot_be_weighted) {
  const std::string message = complaint("name: s\nbase: walk\nweighted_from: no_contact_motion\n");
  EXPECT_TRUE(holds(message,
                    "s.yaml:3: weighted_from: the level \"friction_cone\" keeps the physics and "
                    "can't be weighted; valid is a level after it"))
      << message;
}

TEST(StackFile, weights_and_weighted_from_name_levels_of_the_stack) {
  const std::string message = complaint("name: s\nbase: walk\nweighted_from: com\n");
  EXPECT_TRUE(holds(message, "s.yaml:3: weighted_from: unknown level \"com\"")) << message;
  EXPECT_TRUE(
      holds(complaint("name: s\nbase: walk\nweights: {com: 2}\n"), "s.yaml:3: weights.com"));
}

TEST(StackFile, parameters_laid_over_a_stack_reach_every_task_of_that_name) {
  StackOptions stack = load_stack("walk");
  override_tasks(stack, parse_yaml("com_xy: {kp: 150}", "o.yaml"), "tasks");
  EXPECT_EQ(stack.levels[4].tasks[0].numbers.at("kp"), 150.0);
}

TEST(StackFile, parameters_for_a_task_that_the_stack_has_not_are_an_error) {
  StackOptions stack = load_stack("walk");
  const ConfigNode tasks = parse_yaml("limb_extension_limits: {max: 0.5}", "o.yaml");
  EXPECT_TRUE(holds(message_of([&] { override_tasks(stack, tasks, "tasks"); }),
                    "o.yaml:1: tasks.limb_extension_limits"));
}

}  // namespace
}  // namespace surefoot
