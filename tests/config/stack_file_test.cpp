#include "surefoot/config/stack_file.hpp"

#include "surefoot/config/data_file.hpp"
#include "surefoot/tasks/catalog.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

namespace surefoot::config {
namespace {

using test::holds;
using test::message_of;

std::vector<std::string> level_names(const control::StackOptions& stack) {
  std::vector<std::string> names;
  for (const control::LevelSpec& level : stack.levels) names.push_back(level.name);
  return names;
}

control::StackOptions read(const std::string& text) {
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
  control::StackOptions full = load_stack("terrain_adaptation");
  full.levels.erase(full.levels.begin() + 6);
  const control::StackOptions without = load_stack("terrain_without_limits");
  EXPECT_EQ(level_names(without), level_names(full));
  EXPECT_EQ(without.levels[4].tasks[0].numbers, full.levels[4].tasks[0].numbers);
}

TEST(StackFile, every_task_of_every_shipped_stack_can_be_made) {
  for (const std::string& name : list_data("stacks")) {
    for (const control::LevelSpec& level : load_stack(name).levels) {
      for (const control::TaskSpec& task : level.tasks) {
        EXPECT_NE(tasks::make_task(task.task, {task.numbers, task.choices}), nullptr) << name;
      }
    }
  }
}

TEST(StackFile, a_level_can_hold_several_tasks) {
  const control::StackOptions stack = read(
      "name: s\nlevels:\n"
      "  - {name: forces, tasks: [{task: torque_limits}, {task: friction_cone, pyramid: outer}]}\n"
      "  - {task: com_xy, name: balance, kp: 100}\n");
  EXPECT_EQ(level_names(stack), (std::vector<std::string>{"forces", "balance"}));
  EXPECT_EQ(stack.levels[0].tasks[1].choices.at("pyramid"), "outer");
  EXPECT_EQ(stack.levels[1].tasks[0].numbers.at("kp"), 100.0);
}

TEST(StackFile, that_is_wrong_says_where_and_what_would_be_valid) {
  struct Case {
    const char *text, *told;
  };
  for (const Case& one : std::vector<Case>{
           {"name: s\nlevels:\n  - task: swing_feet\n",
            "s.yaml:3: levels.0.task: unknown task \"swing_feet\""},
           {"name: s\nlevels:\n  - task: swing_feet\n", "did you mean \"swing_foot\"?"},
           {"name: s\nlevels:\n  - task: com_xy\n    kpp: 3\n", "s.yaml:4: levels.0.kpp"},
           {"name: s\nlevels:\n  - task: com_xy\n    kpp: 3\n", "kp, kd, max_error"},
           {"name: s\nlevels:\n  - {task: com_xy, kp: -1}\n", "s.yaml:3: levels.0.kp"},
           {"name: s\nlevels:\n  - {task: limb_extension_limits, form: round}\n",
            "s.yaml:3: levels.0.form"},
           {"name: s\nlevels:\n  - {task: com_xy, kp: .nan}\n", "\".nan\""},
           {"name: s\n", "levels: this key is missing"},
           {"name: s\nlevels: []\n", "at least one level"},
           {"name: s\nbase: terrain_adaptation\nwithout: [limb_limits]\n",
            "s.yaml:3: without: unknown level \"limb_limits\""},
           {"name: s\nwithout: [com_xy]\nlevels: [{task: com_xy}]\n",
            "s.yaml:2: without: needs a base"},
           {"name: s\nwithout: [com_xy]\n", "s.yaml:2: without: needs a base"},
           {"name: s\nbase: terrain_adaptation\nlevels:\n  - swing_feet\n",
            "s.yaml:4: levels.0: unknown level \"swing_feet\""},
           {"name: s\nlevels: [com_xy]\n",
            "s.yaml:2: levels.0: unknown level \"com_xy\"; a level by its name needs a base"},
           {"name: s\nbase: walk\nlevels: [com_xy]\nwithout: [swing_foot]\n",
            "s.yaml:4: without: there are levels, too"},
           {"name: s\nbase: walk\nweights: {com_xy: 0}\n", "weights.com_xy"},
           {"name: s\nbase: walk\nweighted_from: no_contact_motion\n",
            "s.yaml:3: weighted_from: the level \"friction_cone\" keeps the physics and can't be "
            "weighted; valid is a level after it"},
           {"name: s\nbase: walk\nweighted_from: com\n",
            "s.yaml:3: weighted_from: unknown level \"com\""},
           {"name: s\nbase: walk\nweights: {com: 2}\n", "s.yaml:3: weights.com"}}) {
    EXPECT_TRUE(holds(complaint(one.text), one.told));
  }
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

TEST(StackFile, levels_of_a_base_are_taken_by_name_in_any_order_with_others_between) {
  const control::StackOptions stack = read(
      "name: s\nbase: terrain_adaptation\nlevels:\n  - swing_foot\n"
      "  - {task: body_height_limits, min: 0.25}\n  - com_xy\n");
  EXPECT_EQ(level_names(stack),
            (std::vector<std::string>{"swing_foot", "body_height_limits", "com_xy"}));
  const control::StackOptions base = load_stack("terrain_adaptation");
  EXPECT_EQ(stack.levels[0].tasks[0].numbers, base.levels[5].tasks[0].numbers);
  EXPECT_EQ(stack.levels[1].tasks[0].numbers.at("min"), 0.25);
  EXPECT_EQ(stack.levels[2].tasks[0].numbers, base.levels[4].tasks[0].numbers);
}

TEST(StackFile, tasks_of_a_level_have_weights_and_a_level_its_damping) {
  const control::StackOptions stack = read(
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
}

TEST(StackFile, a_stack_can_be_weighted_from_a_level_on) {
  const control::StackOptions stack =
      read("name: s\nbase: terrain_adaptation\nweights: {com_xy: 100}\nweighted_from: com_xy\n");
  EXPECT_EQ(level_names(stack),
            (std::vector<std::string>{"equations_of_motion", "no_contact_motion", "torque_limits",
                                      "friction_cone", "weighted"}));
  ASSERT_EQ(stack.levels[4].tasks.size(), 7u);
  EXPECT_EQ(stack.levels[4].tasks[0].weight, 100.0);
  EXPECT_EQ(stack.levels[4].tasks[1].weight, 1.0);
  EXPECT_EQ(stack.levels[4].tasks[1].task, "swing_foot");
}

TEST(StackFile, parameters_laid_over_a_stack_reach_every_task_of_that_name) {
  control::StackOptions stack = load_stack("walk");
  override_tasks(stack, parse_yaml("com_xy: {kp: 150}", "o.yaml"), "tasks");
  EXPECT_EQ(stack.levels[4].tasks[0].numbers.at("kp"), 150.0);
}

TEST(StackFile, names_of_the_robot_may_be_a_list) {
  const control::StackOptions stack = read(
      "name: s\nlevels:\n  - {task: posture, joints: [LF_HAA, RF_HAA]}\n"
      "  - {task: frame_position, frame: LF_SHANK, held_in: world}\n");
  EXPECT_EQ(stack.levels[0].tasks[0].choices.at("joints"), "LF_HAA RF_HAA");
  EXPECT_EQ(stack.levels[1].tasks[0].choices.at("frame"), "LF_SHANK");
}

TEST(StackFile, parameters_for_a_task_that_the_stack_has_not_are_an_error) {
  control::StackOptions stack = load_stack("walk");
  const ConfigNode tasks = parse_yaml("limb_extension_limits: {max: 0.5}", "o.yaml");
  EXPECT_TRUE(holds(message_of([&] { override_tasks(stack, tasks, "tasks"); }),
                    "o.yaml:1: tasks.limb_extension_limits"));
}

}  // namespace
}  // namespace surefoot::config
