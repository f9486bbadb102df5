#include "surefoot/base/error.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/control/asked_stack.hpp"
#include "surefoot/replay/log_replay.hpp"
#include "surefoot/replay/log_verification.hpp"
#include "surefoot/replay/stack_comparison.hpp"
#include "tests/control/own_task.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::replay {
namespace {

using test::holds;

void record(const std::string& path, const config::ScenarioRequest& request) {
  closed_loop::ClosedLoopOptions options;
  options.record_path = path;
  (void)closed_loop::run_closed_loop(config::load_scenario(request), options);
}

const config::ScenarioRequest kSensors{
    "step_down", 3, {"duration=2", "planner.calibration.duration=0"}};
const config::ScenarioRequest kTruth{"walk_flat_ideal", 0, {"duration=2"}};

TEST(Verification, EstimatesTheStateOfARunWithSensorsAgain) {
  const test::TemporaryFolder folder;
  record(folder / "run.mcap", kSensors);
  const Verification result = verify_log(folder / "run.mcap");
  EXPECT_TRUE(result.estimated);
  EXPECT_TRUE(result.is_same());
  EXPECT_EQ(result.ticks, 800);
  for (const MessageDifferences& topic : result.messages) EXPECT_EQ(topic.ticks, 0) << topic.topic;
}

// The log has the robot's own numbers, so nothing is scaled again.
TEST(Verification, IsToTheBitForARobotOfAnotherSize) {
  for (const char* robot : {"go2", "hyq"}) {
    const test::TemporaryFolder folder;
    record(folder / "run.mcap",
           {"walk_flat",
            1,
            {"duration=2", "planner.calibration.duration=0", std::string("robot=") + robot}});
    EXPECT_TRUE(verify_log(folder / "run.mcap").is_same()) << robot;
  }
}

TEST(Verification, BelievesTheLoggedStateWhereTheRunHadTheTruth) {
  const test::TemporaryFolder folder;
  record(folder / "run.mcap", kTruth);
  const Verification result = verify_log(folder / "run.mcap");
  EXPECT_FALSE(result.estimated);
  EXPECT_TRUE(result.is_same());
}

/// A run with a task of the user's and a planner that only asks the library's.
struct OwnRun {
  class Planner final : public gaits::MotionPlanner {
   public:
    explicit Planner(const config::Scenario& scenario)
        : library_(gaits::make_planner(scenario.controller.planner, scenario.controller.period,
                                       scenario.robot.scale)) {}
    const MotionPlan& update(const UserCommand& user, const RobotState& state,
                             const model::Dynamics& dynamics,
                             const HierarchyOutcome& last) override {
      return library_->update(user, state, dynamics, last);
    }
    void restart() override { library_->restart(); }

   private:
    std::unique_ptr<gaits::MotionPlanner> library_;
  };

  OwnRun() {
    scenario.controller.stack.own_tasks = test::own_tasks();
    const control::TaskSpec mine{.task = "own", .numbers = {}, .choices = {}};
    auto& levels = scenario.controller.stack.levels;
    levels.insert(levels.begin() + 4, {.name = "mine", .tasks = {mine}});
    (void)closed_loop::run_closed_loop(scenario, {.record_path = log, .make_planner = [this] {
                                                    return std::make_unique<Planner>(scenario);
                                                  }});
  }

  const test::TemporaryFolder folder;
  const std::string log = folder / "run.mcap";
  config::Scenario scenario = config::load_scenario(kTruth);
};

/// The user's tasks, of which the one does this.
tasks::OwnTasks own_tasks_that(test::OwnTask::Write write) {
  tasks::OwnTasks own;
  own.add(
      {.info = test::own_tasks().find("own")->info, .make = test::own_task(std::move(write)).make});
  return own;
}

TEST(Verification, OfARunWithATaskOfTheUsersNeedsIt) {
  const OwnRun run;
  EXPECT_TRUE(holds(test::message_of([&] { (void)verify_log(run.log); }),
                    "the run's task own is the user's own and was not given"));
  const Verification result = verify_log(run.log, {.own_tasks = test::own_tasks()});
  EXPECT_TRUE(result.is_same());
  EXPECT_EQ(result.played_back, std::vector<std::string>{"planner"});

  tasks::OwnTasks another;
  another.add(
      {.info = test::own_tasks().find("own")->info, .make = [](const tasks::TaskParameters&) {
         return std::make_unique<test::OwnTask>(test::OwnTask::Options{.acceleration = 1});
       }});
  EXPECT_FALSE(verify_log(run.log, {.own_tasks = another}).is_same());
}

TEST(Replay, TellsWhatATaskOfTheUsersDoesWrong) {
  const OwnRun run;
  const auto failing = own_tasks_that([](const test::OwnTask&, const tasks::TaskInput&,
                                         solver::Level&) { throw std::runtime_error("no idea"); });
  EXPECT_TRUE(
      holds(verify_log(run.log, {.own_tasks = failing}).fault, "task \"own\" threw: no idea"));
  record(run.folder / "other.mcap", kTruth);
  test::write_file(run.folder / "other.yaml",
                   "name: other\nbase: walk\nlevels: [equations_of_motion, no_contact_motion, "
                   "torque_limits, friction_cone, motion, {task: own}]\n");
  EXPECT_TRUE(holds(compare_stack(run.folder / "other.mcap", run.folder / "other.yaml", {}, failing)
                        .other_unanswered.why,
                    "task \"own\" threw: no idea"));
}

TEST(Verification, AsksThePlannerThatItIsGiven) {
  const OwnRun run;
  const Verification result = verify_log(
      run.log,
      {.own_tasks = test::own_tasks(), .make_planner = [&](const model::RobotDescription& robot) {
         EXPECT_EQ(robot.name, run.scenario.robot.name);
         return std::make_unique<OwnRun::Planner>(run.scenario);
       }});
  EXPECT_TRUE(result.is_same());
  EXPECT_TRUE(result.played_back.empty());
}

TEST(Verification, EndsWhereItIsStopped) {
  const test::TemporaryFolder folder;
  record(folder / "run.mcap", kTruth);
  int ticks = 0;
  EXPECT_TRUE(holds(test::message_of([&] {
                      (void)verify_log(folder / "run.mcap", {}, [&] { return ++ticks == 5; });
                    }),
                    "interrupted"));
  EXPECT_EQ(ticks, 5);
}

TEST(StackComparison, OfARunWithATaskOfTheUsersNeedsIt) {
  const OwnRun run;
  EXPECT_TRUE(holds(test::message_of([&] { (void)compare_stack(run.log, "walk"); }),
                    "the run's task own is the user's own and was not given"));
  EXPECT_EQ(compare_stack(run.log, "walk", {}, test::own_tasks()).not_reproduced.ticks, 0);
}

TEST(StackComparison, OfTheRunsOwnStackFindsNoDifference) {
  const test::TemporaryFolder folder;
  record(folder / "run.mcap", kTruth);
  const config::Scenario scenario = config::load_scenario(kTruth);
  const StackComparison result = compare_stack(folder / "run.mcap", scenario.controller.stack.name);
  for (const JointComparison& joint : result.joints) {
    EXPECT_EQ(joint.rms, 0.0);
    EXPECT_EQ(joint.largest, 0.0);
  }
  for (const LevelComparison& level : result.levels) {
    EXPECT_TRUE(level.in_log && level.in_other);
    EXPECT_EQ(level.logged_rms, level.other_rms) << level.name;
    EXPECT_EQ(level.logged_max, level.other_max) << level.name;
  }
  EXPECT_EQ(result.compared, result.ticks);
  EXPECT_EQ(result.other_not_optimal.ticks, result.logged_not_optimal.ticks);
  EXPECT_EQ(result.not_reproduced.ticks, 0);
}

TEST(StackComparison, NamesTheLevelsThatOnlyOneOfThemHas) {
  const test::TemporaryFolder folder;
  record(folder / "run.mcap", kTruth);
  const StackComparison result = compare_stack(folder / "run.mcap", "manipulability");
  const auto count = [&](bool in_log, bool in_other) {
    return std::ranges::count_if(result.levels, [&](const LevelComparison& level) {
      return level.in_log == in_log && level.in_other == in_other;
    });
  };
  EXPECT_GT(count(true, true), 3);
  EXPECT_GT(count(false, true) + count(true, false), 0);
  EXPECT_EQ(count(false, false), 0);
}

TEST(StackComparison, TellsItsObserverOfEachTick) {
  const test::TemporaryFolder folder;
  record(folder / "run.mcap", kTruth);
  long ticks = 0;
  double square = 0.0;
  const StackComparison result = compare_stack(
      folder / "run.mcap", "crouch_first",
      [&](const TickRecord& logged, const control::StackAnswer* other,
          const std::vector<OtherLevel>& levels) {
        ASSERT_NE(other, nullptr);
        EXPECT_EQ(static_cast<std::int32_t>(levels.size()), other->hierarchy.num_levels);
        square += std::pow(other->command.torque[4] - logged.command.torque[4], 2);
        ++ticks;
      });
  EXPECT_EQ(ticks, result.ticks);
  EXPECT_NEAR(result.joints[4].rms, std::sqrt(square / static_cast<double>(ticks)), 1e-12);
}

TEST(StackComparison, RefusesAStackThatIsNoneWithTheNamesThatExist) {
  const test::TemporaryFolder folder;
  record(folder / "run.mcap", kTruth);
  EXPECT_TRUE(holds(test::message_of([&] { (void)compare_stack(folder / "run.mcap", "wlak"); }),
                    "did you mean \"walk\"?"));
}

}  // namespace
}  // namespace surefoot::replay
