#include "surefoot/tasks/catalog.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/numbers.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/sizes.hpp"
#include "tests/tasks/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

namespace surefoot::tasks {
namespace {

using test::all_contact_sets;
using test::message_of;
using test::plan_with_contacts;
using test::Random;
using test::Scene;
using test::written;
using test::WrittenRows;

TEST(TaskCatalog, makes_every_task_under_its_own_name_with_its_defaults) {
  EXPECT_EQ(task_catalog().size(), 20u);
  for (const TaskInfo& info : task_catalog()) {
    TaskParameters defaults;
    for (const TaskParameter& parameter : info.parameters) {
      defaults.numbers[std::string(parameter.name)] = parameter.default_value;
      EXPECT_GE(parameter.default_value, parameter.minimum) << info.name << " " << parameter.name;
      EXPECT_FALSE(parameter.unit.empty()) << info.name << " " << parameter.name;
      EXPECT_FALSE(parameter.help.empty()) << info.name << " " << parameter.name;
    }
    for (const TaskChoice& choice : info.choices) {
      defaults.choices[std::string(choice.name)] = choice.default_value;
      const bool is_listed = std::ranges::count(choice.values, choice.default_value) == 1;
      EXPECT_TRUE(is_listed || !choice.others.empty()) << info.name << " " << choice.name;
    }
    EXPECT_EQ(make_task(info.name)->name(), info.name);
    EXPECT_EQ(make_task(info.name, defaults)->name(), info.name);
    EXPECT_FALSE(info.summary.empty());
    EXPECT_FALSE(info.equation.empty());
    EXPECT_FALSE(info.unit.empty()) << info.name;
  }
}

TEST(TaskCatalog, makes_tasks_whose_written_defaults_are_those_of_the_code) {
  Scene scene;
  Random random(70);
  const RobotState state = random.standing_state(scene.model.description().q_nominal);
  test::randomise_references(random, scene.model.update(state, Vec3::UnitZ()), scene.plan);
  scene.plan.feet[3].phase = LegPhase::swing;
  const TaskInput input = scene.update(state);
  for (const TaskInfo& info : task_catalog()) {
    TaskParameters defaults;
    for (const TaskParameter& parameter : info.parameters) {
      defaults.numbers[std::string(parameter.name)] = parameter.default_value;
    }
    for (const TaskChoice& choice : info.choices) {
      defaults.choices[std::string(choice.name)] = choice.default_value;
    }
    const WrittenRows implicit = written(*make_task(info.name), input);
    const WrittenRows explicit_rows = written(*make_task(info.name, defaults), input);
    EXPECT_TRUE(implicit.A == explicit_rows.A) << info.name;
    EXPECT_TRUE(implicit.lower == explicit_rows.lower) << info.name;
    EXPECT_TRUE(implicit.upper == explicit_rows.upper) << info.name;
  }
}

TEST(TaskCatalog, gives_parameters_and_choices_to_the_task) {
  Scene scene;
  const RobotState state = Random(71).standing_state(scene.model.description().q_nominal);
  scene.plan.torso.height = scene.model.update(state, Vec3::UnitZ()).base.p.z() + 0.01;
  const TaskInput input = scene.update(state);
  const double kd0 =
      written(*make_task("torso_height", {{{"kp", 100.0}, {"kd", 0.0}}, {}}), input).lower[0];
  EXPECT_NEAR(kd0, 1.0, 1e-9);
  const auto limits = [&](const char* form) {
    return written(*make_task("limb_extension_limits", {{{"max", 0.53}}, {{"form", form}}}), input);
  };
  EXPECT_FALSE(limits("radial").A == limits("relative").A);
  EXPECT_FALSE(limits("paper").A == limits("relative").A);
  const auto weights = [&](const char* leg) {
    TaskParameters one{{{"weight_LF", 0.0},
                        {"weight_RF", 0.0},
                        {"weight_LH", 0.0},
                        {"weight_RH", 0.0},
                        {"kd", 0.0}},
                       {}};
    one.numbers[leg] = 1.0;
    return written(*make_task("manipulability", one), input).lower[0];
  };
  EXPECT_NE(weights("weight_LF"), weights("weight_RH"));
}

TEST(TaskCatalog, refuses_what_it_does_not_know_and_says_what_there_is) {
  EXPECT_THROW(static_cast<void>(make_task("com_yx")), UnknownNameError);
  EXPECT_EQ(message_of([] { static_cast<void>(task_info("com_yx")); }).substr(0, 46),
            "unknown task \"com_yx\"; there are: equations_of");
  EXPECT_EQ(message_of([] { static_cast<void>(make_task("com_xy", {{{"gain", 1.0}}, {}})); }),
            "com_xy: there is no number \"gain\"; the task has: kd kp max_error");
  EXPECT_EQ(message_of([] { static_cast<void>(make_task("com_xy", {{}, {{"form", "radial"}}})); }),
            "com_xy: there is no choice \"form\"; the task has: none");
  EXPECT_EQ(message_of([] {
              static_cast<void>(make_task("limb_extension_limits", {{}, {{"form", "round"}}}));
            }),
            "limb_extension_limits: form is \"round\", but must be one of: paper relative radial");
}

TEST(TaskCatalog, refuses_numbers_out_of_range) {
  for (const double value : {-1.0, kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(static_cast<void>(make_task("com_xy", {{{"kp", value}}, {}})), Error);
  }
  EXPECT_EQ(message_of([] { static_cast<void>(make_task("com_xy", {{{"kp", -1.0}}, {}})); }),
            "com_xy: kp is -1, but must be a number of at least 0 1/s²");
  EXPECT_THROW(static_cast<void>(make_task("body_height_limits", {{{"min", 0.9}}, {}})), Error);
}

TEST(EveryTask, fits_its_rows_and_names_them_uniquely) {
  Scene scene;
  Random random(72);
  for (const TaskInfo& info : task_catalog()) {
    const std::unique_ptr<Task> task = make_task(info.name);
    std::set<std::string> names;
    for (int id = 0; id < task->num_ids(); ++id) names.insert(task->row_name(id));
    EXPECT_EQ(names.size(), static_cast<std::size_t>(task->num_ids())) << info.name;
    for (const PerLeg<bool>& contacts : all_contact_sets()) {
      scene.plan = plan_with_contacts(contacts);
      const TaskInput input =
          scene.update(random.standing_state(scene.model.description().q_nominal));
      const WrittenRows rows = written(*task, input);
      EXPECT_LE(rows.count(), task->max_rows());
      EXPECT_TRUE(rows.A.allFinite()) << info.name;
      EXPECT_TRUE((rows.lower.array() <= rows.upper.array()).all()) << info.name;
      for (const int id : rows.ids) {
        EXPECT_TRUE(id >= 0 && id < task->num_ids()) << info.name << " " << id;
      }
    }
  }
}

TEST(EveryTask, gives_the_same_rows_for_the_same_input) {
  Scene scene;
  const TaskInput input =
      scene.update(Random(73).standing_state(scene.model.description().q_nominal));
  for (const TaskInfo& info : task_catalog()) {
    const std::unique_ptr<Task> task = make_task(info.name);
    const WrittenRows first = written(*task, input);
    const WrittenRows second = written(*task, input);
    EXPECT_TRUE(first.A == second.A) << info.name;
    EXPECT_TRUE(first.lower == second.lower && first.upper == second.upper) << info.name;
  }
}

TEST(EveryTask, moves_its_row_ids_by_what_its_level_asks_for) {
  Scene scene;
  const TaskInput input =
      scene.update(Random(74).standing_state(scene.model.description().q_nominal));
  for (const TaskInfo& info : task_catalog()) {
    const std::unique_ptr<Task> task = make_task(info.name);
    std::vector<int> ids = written(*task, input).ids;
    task->set_first_id(100);
    for (int& id : ids) id += 100;
    EXPECT_EQ(written(*task, input).ids, ids) << info.name;
  }
}

TEST(EveryTask, does_not_allocate) {
  Scene scene;
  const RobotState state = Random(75).standing_state(scene.model.description().q_nominal);
  for (const TaskInfo& info : task_catalog()) {
    const std::unique_ptr<Task> task = make_task(info.name);
    solver::Level level("test", task->max_rows(), kNumUnknowns);
    for (const PerLeg<bool>& contacts : all_contact_sets()) {
      scene.plan = plan_with_contacts(contacts);
      const test::MallocCounter counter;
      const TaskInput input = scene.update(state);
      level.clear();
      task->write(input, level);
      EXPECT_EQ(counter.count(), 0u) << info.name;
    }
  }
}

}  // namespace
}  // namespace surefoot::tasks
