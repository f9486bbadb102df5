#include "surefoot/tasks/check_task.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/numbers.hpp"
#include "surefoot/tasks/catalog.hpp"
#include "surefoot/tasks/task_rows.hpp"
#include "tests/control/own_task.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/hexapod.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace surefoot::tasks {
namespace {

using test::OwnTask;

std::vector<std::string> faults_of(OwnTask::Write write) {
  OwnTasks own;
  own.add(test::own_task(std::move(write)));
  return check_task("own", test::anymal_b(), own);
}

TEST(CheckTask, FindsNothingWrongWithTheLibrarysTasks) {
  for (const TaskInfo& info : task_catalog()) {
    for (const model::RobotDescription& robot :
         {test::anymal_b(), test::anymal_b_with_arm(), test::hexapod()}) {
      const bool lacks_arm = info.name.starts_with("frame_") && robot.arms.empty();
      EXPECT_EQ(check_task(info.name, robot).size(), lacks_arm ? 1u : 0u) << info.name;
    }
  }
}

TEST(CheckTask, FindsWhatIsWrongAndNamesTheTask) {
  const auto row = [](const OwnTask& task, solver::Level& level, double b) {
    level.add(1, task.first_id()).set_equal(0, b);
  };
  EXPECT_EQ(faults_of([](const auto&, const auto&, auto&) { throw std::runtime_error("oh"); }),
            std::vector<std::string>{R"(task "own": write() threw: oh)"});
  EXPECT_EQ(
      faults_of([](const auto&, const auto&, auto&) { throw 42; }),
      std::vector<std::string>{R"(task "own": write() threw something that is no std::exception)"});
  EXPECT_EQ(
      faults_of([&](const auto& task, const auto&, auto& level) { row(task, level, kNaN); }),
      std::vector<std::string>{R"(task "own": wrote row 0 (base upward) with the bounds nan and )"
                               "nan; two numbers, the lower first, would be valid"});
  EXPECT_EQ(faults_of([&](const auto& task, const auto&, auto& level) {
              static int count = 0;
              row(task, level, ++count);
            }),
            std::vector<std::string>{
                R"(task "own": wrote other rows for the same input; keep no state)"});
  EXPECT_EQ(faults_of([&](const auto& task, const auto&, auto& level) {
              const Eigen::VectorXd ones = Eigen::VectorXd::Ones(level.unknowns());
              row(task, level, ones.sum());
            }),
            std::vector<std::string>{R"(task "own": write() allocates; make its memory in the )"
                                     "constructor or in fixed-size matrices"});
}

/// With a number of rows that the user mistyped.
class ManyRows final : public Task {
 public:
  explicit ManyRows(int rows) : rows_(rows) {}
  void write(const TaskInput&, solver::Level&) const override {}
  [[nodiscard]] int max_rows() const override { return rows_; }
  [[nodiscard]] std::string_view name() const override { return "many"; }
  [[nodiscard]] std::string row_name(int) const override { return "row"; }

 private:
  int rows_;
};

TEST(CheckTask, RefusesMoreRowsThanATickCanHave) {
  EXPECT_NO_THROW(check_sizes(ManyRows(Task::kMostRows), "many"));
  for (const int rows : {-1, Task::kMostRows + 1, 100'000'000}) {
    const ManyRows task(rows);
    EXPECT_TRUE(test::holds(test::message_of([&] { check_sizes(task, "many"); }),
                            "give the largest number of rows in a tick, from 0 to 1000"));
  }
}

TEST(OwnTasks, RefusesWhatCantBeNamed) {
  const auto added = [](TaskDefinition task) {
    return test::message_of([&] {
      OwnTasks own = test::own_tasks();
      own.add(std::move(task));
    });
  };
  TaskDefinition task = test::own_task({});
  EXPECT_EQ(added(task), R"(there is a task "own" already; give yours another name)");
  task.info.name = "com_xy";
  EXPECT_EQ(added(task), R"(there is a task "com_xy" already; give yours another name)");
  task.info.name = "";
  EXPECT_EQ(added(task), "a task of your own needs a name, by which stacks call it");
  EXPECT_EQ(added({.info = {.name = "mine"}, .make = {}}),
            R"(task "mine" needs a factory that makes it)");
}

TEST(OwnTasks, AreMadeByNameWithTheirParametersChecked) {
  const OwnTasks own = test::own_tasks();
  EXPECT_EQ(make_task("own", {{{"acceleration", 0.3}}, {}}, own)->name(), "own");
  EXPECT_EQ(test::message_of([&] { (void)make_task("own", {{{"speed", 0.3}}, {}}, own); }),
            R"(own: there is no number "speed"; the task has: acceleration)");
  EXPECT_EQ(test::message_of([&] { (void)make_task("own", {{{"acceleration", -1.0}}, {}}, own); }),
            "own: acceleration is -1, but must be a number of at least 0 m/s²");
  EXPECT_NE(test::message_of([&] { (void)make_task("owm", {}, own); }).find("own"),
            std::string::npos);
  EXPECT_EQ(task_names(own).back(), "own");
}

}  // namespace
}  // namespace surefoot::tasks
