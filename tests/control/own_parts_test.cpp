// Parts of the user's own in the controller: they work, and what they do wrong ends safely.
#include "tests/control/own_task.hpp"
#include "tests/control/statue.hpp"
#include "tests/support/malloc_counter.hpp"

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::control {
namespace {

using test::OwnTask;

/// The paper's stack with a level "mine" of the user's task after those that keep the physics.
ControllerOptions options_with(const tasks::OwnTasks& own) {
  ControllerOptions options = test::options_of();
  options.stack.own_tasks = own;
  const TaskSpec mine{.task = "own", .numbers = {}, .choices = {}};
  options.stack.levels.insert(options.stack.levels.begin() + 4,
                              LevelSpec{.name = "mine", .tasks = {mine}});
  return options;
}

ControllerOptions options_with(OwnTask::Write write) {
  tasks::OwnTasks own;
  own.add(test::own_task(std::move(write)));
  return options_with(own);
}

void write_row(const OwnTask& task, solver::Level& level, double lower, double upper, int id = 0) {
  solver::Rows rows = level.add(1, task.first_id() + id);
  rows.A(0, 2) = 1.0;
  rows.lower[0] = lower;
  rows.upper[0] = upper;
}

/// Ticks until the stop; never fewer commands that are not legal.
int ticks_until_stop(test::Statue& statue) {
  for (int tick = 1; tick < 400; ++tick) {
    test::expect_legal(statue.tick());
    if (statue.controller.record().command.cause != StopCause::none) return tick;
  }
  return -1;
}

TEST(OwnTask, MovesTheRobotAsItsRowsSay) {
  ControllerOptions options = options_with(test::own_tasks());
  options.stack.levels[4].tasks.front().numbers["acceleration"] = 0.4;
  test::Statue statue(options);
  statue.run(3);
  const TickRecord& record = statue.controller.record();
  EXPECT_EQ(record.command.mode, CommandMode::optimal);
  EXPECT_NEAR(record.hierarchy.levels[4].residual, 0.0, 1e-6);
  EXPECT_EQ(statue.controller.level_names()[4], "mine");
  EXPECT_EQ(statue.controller.level_units()[4], "m/s²");
  EXPECT_EQ(statue.controller.row_name(4, 0), "base upward");
  EXPECT_EQ(statue.controller.fault(), "");
}

TEST(OwnTask, ThatFailsEndsInTheSafetyLadderUnderItsName) {
  struct Wrong {
    OwnTask::Write write;
    const char* text;
  };
  const std::vector<Wrong> wrongs{
      {[](const auto&, const auto&, auto&) { throw std::runtime_error("no such frame"); },
       R"(task "own" threw: no such frame)"},
      {[](const auto&, const auto&, auto&) { throw 7; },
       R"(task "own" threw something that is no std::exception)"},
      {[](const OwnTask& task, const auto&, auto& level) { write_row(task, level, kNaN, kNaN); },
       R"(task "own" wrote row 0 (base upward) with the bounds nan and nan; two numbers, the lower )"
       "first, would be valid"},
      {[](const OwnTask& task, const auto&, auto& level) { write_row(task, level, 1.0, 0.0); },
       R"(task "own" wrote row 0 (base upward) with the bounds 1 and 0; two numbers, the lower )"
       "first, would be valid"},
      {[](const OwnTask& task, const auto&, auto& level) {
         (void)task;
         level.add(1, task.first_id()).A(0, 3) = kNaN;
       },
       R"(task "own" wrote row 0 (base upward) with NaN or infinity in A)"},
      {[](const OwnTask& task, const auto&, auto& level) { write_row(task, level, 1e200, 1e200); },
       R"(task "own" wrote row 0 (base upward) with a number above 1e100, with which no solver )"
       "can calculate"},
      {[](const OwnTask& task, const auto&, auto& level) {
         for (int i = 0; i < 2; ++i) write_row(task, level, 0.0, 0.0);
       },
       R"(task "own" wrote more rows than its max_rows())"},
      {[](const OwnTask& task, const auto&, auto& level) { write_row(task, level, 0.0, 0.0, 1); },
       R"(task "own" wrote row 0 with an id that is not from first_id() to first_id() + num_ids() )"
       "- 1"},
  };
  for (const Wrong& wrong : wrongs) {
    bool fails = false;
    test::Statue statue(
        options_with([&](const OwnTask& task, const tasks::TaskInput& input, solver::Level& level) {
          if (fails) wrong.write(task, input, level);
        }));
    statue.run(20);
    ASSERT_EQ(statue.controller.record().command.mode, CommandMode::optimal);
    fails = true;
    EXPECT_EQ(statue.tick().mode, CommandMode::hold) << wrong.text;
    EXPECT_EQ(statue.controller.fault(), wrong.text);
    EXPECT_EQ(ticks_until_stop(statue), SafetyOptions{}.damp_after_failures);
    EXPECT_EQ(statue.controller.record().command.mode, CommandMode::sit);
    EXPECT_EQ(statue.controller.record().command.cause, StopCause::own_part);
    EXPECT_EQ(statue.controller.fault(), wrong.text);
  }
}

TEST(OwnTask, ThatFailsForSomeTicksIsForgiven) {
  int left = 0;
  test::Statue statue(options_with([&](const auto&, const auto&, auto&) {
    if (left > 0) throw std::runtime_error("not yet");
  }));
  statue.run(20);
  for (left = 40; left > 0; --left) ASSERT_EQ(statue.tick().mode, CommandMode::hold);
  EXPECT_EQ(statue.tick().mode, CommandMode::optimal);
  EXPECT_EQ(statue.controller.record().command.cause, StopCause::none);
}

TEST(OwnTask, OfTheStackThatFadesOutIsBlamedForItsFaults) {
  bool fails = false;
  tasks::OwnTasks own;
  own.add(test::own_task([&](const auto&, const auto&, auto&) {
    if (fails) throw std::runtime_error("it is old");
  }));
  ControllerOptions options = test::options_of();
  options.stack.own_tasks = own;
  options.stack.levels.push_back({.name = "mine", .tasks = {{.task = "own"}}});
  test::Statue statue(options);
  statue.run(20);
  StackOptions next = test::options_of().stack;
  next.levels.push_back({.name = "mine", .tasks = {{.task = "torque_minimisation"}}});
  ASSERT_TRUE(statue.controller.set_stack(next, 2.0));
  fails = true;
  statue.run(SafetyOptions{}.damp_after_failures + 1);
  EXPECT_EQ(statue.controller.fault(), "task \"own\" threw: it is old");
  EXPECT_EQ(statue.controller.record().command.mode, CommandMode::sit);
  EXPECT_EQ(statue.controller.record().command.cause, StopCause::own_part);
}

TEST(OwnTask, CostsNoAllocationInATick) {
  test::Statue statue(options_with(test::own_tasks()));
  statue.run(20);
  const test::MallocCounter mallocs;
  statue.run(20);
  EXPECT_EQ(mallocs.count(), 0u);
}

/// Another planner's plan, changed.
class ChangedPlanner final : public gaits::MotionPlanner {
 public:
  using Change = std::function<void(MotionPlan&)>;
  ChangedPlanner(const ControllerOptions& options, Change change)
      : base_(gaits::make_planner(options.planner, options.period)), change_(std::move(change)) {}

  const MotionPlan& update(const UserCommand& user, const RobotState& state,
                           const model::Dynamics& dynamics, const HierarchyOutcome& last) override {
    plan_ = base_->update(user, state, dynamics, last);
    change_(plan_);
    return plan_;
  }
  void restart() override { base_->restart(); }

 private:
  std::unique_ptr<gaits::MotionPlanner> base_;
  Change change_;
  MotionPlan plan_;
};

/// A statue with a planner of the user's own.
struct PlannedStatue {
  explicit PlannedStatue(ChangedPlanner::Change change)
      : state(test::standing(options.planner.stance)),
        controller(test::anymal_b(), options, std::make_unique<test::ScriptedEstimator>(state),
                   std::make_unique<ChangedPlanner>(options, std::move(change))) {}

  const JointCommand& tick() {
    state.time += options.period;
    SensorReading reading;
    reading.time = state.time;
    reading.q = state.q;
    reading.torque = state.torque;
    const JointCommand& command = controller.step(reading, {});
    state.torque = command.torque;
    return command;
  }

  ControllerOptions options = test::options_of();
  RobotState state;
  Controller controller;
};

TEST(OwnPlanner, GivesTheTasksWhatTheyFollow) {
  PlannedStatue raised([](MotionPlan& plan) { plan.torso.height += 0.001; });
  PlannedStatue same([](MotionPlan&) {});
  test::Statue plain;
  for (int i = 0; i < 20; ++i) {
    (void)raised.tick();
    ASSERT_EQ(same.tick().torque, plain.tick().torque) << "the library's planner within";
  }
  EXPECT_NEAR(raised.controller.record().plan.torso.height,
              same.controller.record().plan.torso.height + 0.001, 1e-12);
  EXPECT_NE(raised.controller.record().command.torque, same.controller.record().command.torque);
}

TEST(OwnPlanner, ThatFailsEndsInTheSafetyLadderUnderItsName) {
  const std::vector<std::pair<ChangedPlanner::Change, const char*>> wrongs{
      {[](MotionPlan&) { throw std::runtime_error("lost"); }, "the planner threw: lost"},
      {[](MotionPlan& plan) { plan.feet.resize(6); },
       "the planner's plan does not have the robot's number of feet"},
      {[](MotionPlan& plan) { plan.feet[1].p_WF.x() = kNaN; },
       "the planner's plan has NaN or infinity in foot RF"},
      {[](MotionPlan& plan) { plan.feet[2].friction = -1.0; },
       "the planner's plan has friction -1 below 0 in foot LH"},
      {[](MotionPlan& plan) { plan.feet[3].force_min = 2.0 + plan.feet[3].force_max; },
       "the planner's plan has force_min 402 N above force_max 400 N in foot RH"},
      {[](MotionPlan& plan) { plan.torso.height = kNaN; },
       "the planner's plan has NaN or infinity in the torso"},
      {[](MotionPlan& plan) { plan.com.a.x() = kNaN; },
       "the planner's plan has NaN or infinity in the centre of mass"},
      {[](MotionPlan& plan) { plan.R_WC.setZero(); }, "the planner's R_WC is no rotation"},
      {[](MotionPlan& plan) { plan.frames.add({}); },
       "the planner's plan has a frame without a number"},
      {[](MotionPlan& plan) {
         plan.frames.add({.frame = 3});
         plan.frames.add({.frame = 3});
       },
       "the planner's plan has frame 3 twice"},
  };
  for (const auto& [wrong, text] : wrongs) {
    bool fails = false;
    PlannedStatue statue([&](MotionPlan& plan) {
      if (fails) wrong(plan);
    });
    for (int i = 0; i < 20; ++i) (void)statue.tick();
    ASSERT_EQ(statue.controller.record().command.mode, CommandMode::optimal);
    fails = true;
    for (int i = 0; i <= SafetyOptions{}.damp_after_failures; ++i)
      ASSERT_NO_FATAL_FAILURE(test::expect_legal(statue.tick()));
    EXPECT_EQ(statue.controller.record().command.mode, CommandMode::sit);
    EXPECT_EQ(statue.controller.record().command.cause, StopCause::own_part);
    EXPECT_EQ(statue.controller.fault(), text);
  }
}

/// Stands still, or fails.
class FailingEstimator final : public estimation::StateEstimator {
 public:
  FailingEstimator(const RobotState& state, const bool& throws) : state_(state), throws_(throws) {}
  const RobotState& update(const SensorReading&, const TickContext&) override {
    if (throws_) throw std::runtime_error("no camera");
    return state_;
  }
  void restart() override {}

 private:
  const RobotState& state_;
  const bool& throws_;
};

TEST(OwnEstimator, ThatFailsEndsInTheSafetyLadderUnderItsName) {
  for (const bool has_size : {true, false}) {
    const ControllerOptions options = test::options_of();
    RobotState state = test::standing(options.planner.stance);
    bool throws = false;
    Controller controller(test::anymal_b(), options,
                          std::make_unique<FailingEstimator>(state, throws));
    const RobotState good = state;
    SensorReading reading;
    reading.q = good.q;
    for (int i = 1; i <= 101; ++i) {
      reading.time = state.time = i * options.period;
      if (i > 20 && has_size) throws = true;
      if (i > 20 && !has_size) state.q.setZero(7);
      ASSERT_NO_FATAL_FAILURE(test::expect_legal(controller.step(reading, {})));
      reading.torque = state.torque = controller.record().command.torque;
    }
    EXPECT_EQ(controller.record().command.mode, CommandMode::sit);
    EXPECT_EQ(controller.record().command.cause, StopCause::own_part);
    EXPECT_EQ(controller.fault(),
              has_size ? "the state estimator threw: no camera"
                       : "the state estimator gave q, qd or torque that don't have the robot's "
                         "joints");
  }
}

TEST(OwnEstimator, ThatGivesNanIsNamedWithWhatIsNan) {
  const std::vector<std::pair<const char*, std::function<void(RobotState&)>>> cases = {
      {"time", [](RobotState& state) { state.time = kNaN; }},
      {"p_WB", [](RobotState& state) { state.p_WB.y() = kNaN; }},
      {"q_WB", [](RobotState& state) { state.q_WB.coeffs().setZero(); }},
      {"v_WB", [](RobotState& state) { state.v_WB.setConstant(kInfinity); }},
      {"w_WB_B", [](RobotState& state) { state.w_WB_B.setConstant(kNaN); }},
      {"q", [](RobotState& state) { state.q.setConstant(kNaN); }},
      {"qd", [](RobotState& state) { state.qd[11] = 1e9; }},
      {"torque", [](RobotState& state) { state.torque.setConstant(kNaN); }}};
  for (const auto& [name, spoil] : cases) {
    SCOPED_TRACE(name);
    const ControllerOptions options = test::options_of();
    RobotState state = test::standing(options.planner.stance);
    const RobotState good = state;
    const bool throws = false;
    Controller controller(test::anymal_b(), options,
                          std::make_unique<FailingEstimator>(state, throws));
    SensorReading reading;
    for (int i = 1; i <= 101; ++i) {
      state = good;
      const double noise = 1e-4 * (i % 2);  // otherwise sensors seem frozen
      reading.time = state.time = i * options.period;
      reading.q = good.q.array() + noise;
      reading.gyro.setConstant(noise);
      reading.accelerometer = Vec3(0.0, 0.0, kGravity + noise);
      reading.torque = state.torque = controller.record().command.torque;
      if (i > 20) spoil(state);
      ASSERT_NO_FATAL_FAILURE(test::expect_legal(controller.step(reading, {})));
    }
    EXPECT_EQ(controller.record().command.mode, CommandMode::sit);
    EXPECT_EQ(controller.record().command.cause, StopCause::own_part);
    EXPECT_EQ(
        controller.fault(),
        std::string("the state estimator gave NaN, infinity or an impossible value in ") + name);
  }
}

TEST(OwnEstimator, MayNotKnowTheBaseYet) {
  const ControllerOptions options = test::options_of();
  RobotState state = test::standing(options.planner.stance);
  const JointVector q = state.q;
  const bool throws = false;
  Controller controller(test::anymal_b(), options,
                        std::make_unique<FailingEstimator>(state, throws));
  SensorReading reading;
  for (int i = 1; i <= 101; ++i) {
    const double noise = 1e-4 * (i % 2);  // otherwise sensors seem frozen
    reading.time = state.time = i * options.period;
    reading.q = q.array() + noise;
    reading.gyro.setConstant(noise);
    reading.accelerometer = Vec3(0.0, 0.0, kGravity + noise);
    reading.torque = state.torque = controller.record().command.torque;
    state.p_WB = state.v_WB = state.w_WB_B = Vec3::Constant(kNaN);
    state.q_WB.coeffs().setConstant(kNaN);
    ASSERT_NO_FATAL_FAILURE(test::expect_legal(controller.step(reading, {})));
  }
  EXPECT_NE(controller.record().command.cause, StopCause::own_part);
  EXPECT_EQ(controller.fault(), "");
}

}  // namespace
}  // namespace surefoot::control
