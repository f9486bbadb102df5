#include "surefoot/control/controller.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/initial_posture.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/signals/plan_event.hpp"
#include "surefoot/solver/solution.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace surefoot {
namespace {

using test::anymal_b;
using test::RandomMatrices;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLimit = 40.0;  // of every joint of the robot [N·m]

/// Believes what the test says.
class ScriptedEstimator final : public StateEstimator {
 public:
  explicit ScriptedEstimator(const RobotState& state) : state_(state) {}
  const RobotState& update(const SensorReading&) noexcept override { return state_; }

 private:
  const RobotState& state_;
};

ControllerOptions options_of(const std::string& stack = "terrain_adaptation") {
  ControllerOptions options;
  options.stack = load_stack(stack);
  return options;
}

RobotState standing(const StanceOptions& stance) {
  RobotState state;
  state.time = 0.0;
  state.p_WB = Vec3(0.0, 0.0, stance.height);
  state.q_WB = Quat::Identity();
  state.v_WB.setZero();
  state.w_WB_B.setZero();
  state.q = stance_posture(RobotModel(anymal_b()), stance);
  state.qd.setZero();
  state.torque.setZero();
  return state;
}

/// A robot that stands like a statue, and its controller. Its measured torques are the commanded
/// ones.
struct Statue {
  explicit Statue(const ControllerOptions& options = options_of())
      : period(options.period),
        state(standing(options.planner.stance)),
        controller(anymal_b(), options, std::make_unique<ScriptedEstimator>(state)) {}

  const JointCommand& tick() {
    state.time += period;
    reading.time = state.time;
    reading.q = state.q;
    reading.torque = state.torque;
    const JointCommand& command = controller.step(reading, user);
    state.torque = command.torque;
    return command;
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) (void)tick();
  }
  /// One tick at which the estimator believes something else, under a legal command.
  const JointCommand& tick_with(const RobotState& believed) {
    const RobotState before = state;
    state = believed;
    const JointCommand& command = controller.step(reading, user);
    state = before;
    state.time += period;
    return command;
  }

  double period;
  RobotState state;
  SensorReading reading;
  UserCommand user;
  Controller controller;
};

void expect_legal(const JointCommand& command) {
  ASSERT_TRUE(command.torque.allFinite());
  ASSERT_LE(command.torque.cwiseAbs().maxCoeff(), kLimit);
}

bool is_sound(const MotionPlan& plan) {
  bool sound = plan.com.p.norm() < 1.0 && plan.com.v.norm() < 1.0 && plan.com.a.norm() < 10.0 &&
               std::abs(plan.torso.height) < 2.0 && plan.torso.q_WB.coeffs().allFinite();
  for (const FootPlan& foot : plan.feet) sound = sound && foot.p_WF.norm() < 2.0;
  return sound;
}

/// Every number of a state, one after the other.
std::vector<std::function<double&(RobotState&)>> numbers_of_a_state() {
  std::vector<std::function<double&(RobotState&)>> numbers;
  numbers.emplace_back([](RobotState& s) -> double& { return s.time; });
  for (Eigen::Index i = 0; i < 3; ++i) {
    numbers.emplace_back([i](RobotState& s) -> double& { return s.p_WB[i]; });
    numbers.emplace_back([i](RobotState& s) -> double& { return s.v_WB[i]; });
    numbers.emplace_back([i](RobotState& s) -> double& { return s.w_WB_B[i]; });
  }
  for (Eigen::Index i = 0; i < 4; ++i) {
    numbers.emplace_back([i](RobotState& s) -> double& { return s.q_WB.coeffs()[i]; });
  }
  for (Eigen::Index i = 0; i < kNumJoints; ++i) {
    numbers.emplace_back([i](RobotState& s) -> double& { return s.q[i]; });
    numbers.emplace_back([i](RobotState& s) -> double& { return s.qd[i]; });
    numbers.emplace_back([i](RobotState& s) -> double& { return s.torque[i]; });
  }
  return numbers;
}

TEST(Controller, CarriesAStandingRobotOnItsFeet) {
  Statue statue;
  statue.run(200);
  const TickRecord& record = statue.controller.record();
  EXPECT_EQ(record.command.mode, CommandMode::optimal);
  EXPECT_EQ(record.hierarchy.status, static_cast<int>(SolveStatus::optimal));
  EXPECT_EQ(record.plan.num_contacts(), 4);
  Vec3 force = Vec3::Zero();
  for (const Vec3& f : record.model.force) force += f;
  const double weight = RobotModel(anymal_b()).mass() * kGravity;
  EXPECT_NEAR(force.z(), weight, 0.02 * weight);
  EXPECT_LT(force.head<2>().norm(), 0.05 * weight) << "it only draws the COM to the middle";
  EXPECT_EQ(record.command.time, statue.state.time);
  EXPECT_EQ(record.state.q, statue.state.q);
  for (const Leg leg : kLegs) {
    EXPECT_NEAR(record.model.p_WF[index(leg)].z(), 0.0, 1e-6);
    EXPECT_GT(record.state.foot_force[index(leg)].z(), 30.0) << "as estimated from the torques";
  }
}

TEST(Controller, EveryReadingThatIsNotANumberGivesALegalCommandAndIsForgottenAtOnce) {
  Statue statue;
  statue.user = {.walk = true, .velocity = {0.05, 0.0}};
  statue.run(20);
  for (const auto& number : numbers_of_a_state()) {
    for (const double bad : {kNaN, kInfinity, -kInfinity}) {
      RobotState believed = statue.state;
      number(believed) = bad;
      const JointCommand& command = statue.tick_with(believed);
      ASSERT_NO_FATAL_FAILURE(expect_legal(command));
      ASSERT_EQ(command.mode, CommandMode::hold);
      ASSERT_EQ(statue.tick().mode, CommandMode::optimal);
      ASSERT_TRUE(is_sound(statue.controller.record().plan));
    }
  }
}

TEST(Controller, EveryAbsurdReadingGivesALegalCommandAndIsForgottenSoon) {
  for (const double absurd : {1e300, -1e300, 1e12, -1e5}) {
    for (const auto& number : numbers_of_a_state()) {
      Statue statue;
      statue.run(3);
      RobotState believed = statue.state;
      number(believed) = absurd;
      ASSERT_NO_FATAL_FAILURE(expect_legal(statue.tick_with(believed)));
      for (int i = 0; i < 40; ++i) ASSERT_NO_FATAL_FAILURE(expect_legal(statue.tick()));
      const TickRecord& record = statue.controller.record();
      ASSERT_EQ(record.command.mode, CommandMode::optimal);
      ASSERT_TRUE(is_sound(record.plan));
      for (const Vec3& force : record.state.foot_force) ASSERT_LT(force.norm(), 1e3);
    }
  }
}

TEST(Controller, AClockThatJumpsForATickIsNotBelieved) {
  for (const double jump : {1e6, -1e6, 5.0}) {
    Statue statue;
    statue.user = {.walk = true, .velocity = {0.05, 0.0}};
    statue.run(20);
    RobotState believed = statue.state;
    believed.time += jump;
    EXPECT_EQ(statue.tick_with(believed).mode, CommandMode::hold);
    EXPECT_EQ(statue.tick().mode, CommandMode::optimal);
    EXPECT_EQ(statue.controller.record().plan.time, statue.state.time);
  }
}

TEST(Controller, HoldsThroughTicksWithoutAStateAndGoesOn) {
  Statue statue;
  statue.run(20);
  const JointVector before = statue.controller.record().command.torque;
  for (int i = 0; i < 40; ++i) {
    const JointCommand& command = statue.tick_with(RobotState{});
    ASSERT_EQ(command.mode, CommandMode::hold);
    ASSERT_EQ(command.torque, before);
  }
  EXPECT_EQ(statue.tick().mode, CommandMode::optimal);
  EXPECT_LT((statue.controller.record().command.torque - before).norm(), 1.0);
}

TEST(Controller, ATickWithoutAStateRepeatsNeitherEventsNorResiduals) {
  Statue statue;
  statue.user = {.walk = true, .velocity = {0.05, 0.0}};
  const TickRecord& record = statue.controller.record();
  for (int i = 0; i < 2000 && record.plan.event == 0; ++i) (void)statue.tick();
  ASSERT_NE(record.plan.event, static_cast<int>(PlanEvent::none)) << "nothing ever happens";
  ASSERT_EQ(record.hierarchy.status, static_cast<int>(SolveStatus::optimal));
  const int num_levels = record.hierarchy.num_levels;
  (void)statue.tick_with(RobotState{});
  EXPECT_EQ(record.plan.event, static_cast<int>(PlanEvent::none));
  EXPECT_EQ(record.hierarchy.status, static_cast<int>(SolveStatus::invalid_input));
  EXPECT_EQ(record.hierarchy.num_levels, num_levels);
  EXPECT_EQ(record.hierarchy.num_active, 0);
  for (const LevelReport& level : record.hierarchy.levels) {
    EXPECT_EQ(level.residual, 0.0);
    EXPECT_EQ(level.num_rows, 0);
  }
  (void)statue.tick();
  EXPECT_EQ(record.hierarchy.status, static_cast<int>(SolveStatus::optimal));
}

TEST(Controller, WithoutAStateForLongDampsAndStaysSo) {
  Statue statue;
  statue.run(5);
  for (int i = 0; i <= SafetyOptions{}.damp_after_failures; ++i) statue.tick_with(RobotState{});
  EXPECT_EQ(statue.tick().mode, CommandMode::damping);
}

TEST(Controller, StartsSafelyWithoutAState) {
  Statue statue;
  for (int i = 0; i < 5; ++i) {
    ASSERT_NO_FATAL_FAILURE(expect_legal(statue.tick_with(RobotState{})));
  }
  EXPECT_EQ(statue.tick().mode, CommandMode::optimal);
}

TEST(Controller, AnyGarbageGivesALegalCommand) {
  const std::array<double, 10> odd{kNaN, kInfinity, -kInfinity, 1e308, -1e308,
                                   1e30, -1e9,      1e-308,     0.0,   7.0};
  RandomMatrices random(1);
  const auto odd_one = [&] { return odd[static_cast<std::size_t>(random.integer(0, 9))]; };
  const auto numbers = numbers_of_a_state();
  ControllerOptions options = options_of();
  options.safety = {.damp_after_failures = 1000000, .max_tilt = 4.0};  // never stop trying
  Statue statue(options);
  for (int tick = 0; tick < 1000; ++tick) {
    RobotState believed = statue.state;
    for (const auto& number : numbers) {
      double& value = number(believed);
      if (random.chance(0.05)) value = odd_one();
      if (random.chance(0.1)) value += random.normal();
    }
    believed.q_WB.coeffs() += random.chance(0.5) ? 0.3 * random.vector(4) : VecX::Zero(4).eval();
    statue.user.walk = random.chance(0.7);
    statue.user.velocity = {odd_one(), random.normal()};
    statue.user.yaw_rate = random.chance(0.1) ? odd_one() : random.normal();
    statue.user.height = random.chance(0.1) ? odd_one() : 0.1 * random.normal();
    ASSERT_NO_FATAL_FAILURE(expect_legal(statue.tick_with(believed))) << tick;
    ASSERT_NO_FATAL_FAILURE(expect_legal(statue.tick())) << tick;
  }
}

TEST(Controller, AbsurdCommandsOfTheOperatorAreLimited) {
  const std::array<double, 6> absurd{kNaN, kInfinity, -kInfinity, 1e300, -1e9, 50.0};
  for (const double value : absurd) {
    Statue statue;
    statue.user = {.walk = true, .velocity = {value, -value}, .yaw_rate = value, .height = value};
    statue.run(400);
    const TickRecord& record = statue.controller.record();
    ASSERT_NO_FATAL_FAILURE(expect_legal(record.command));
    EXPECT_LE(record.user.velocity.cwiseAbs().maxCoeff(), 1.0);
    EXPECT_LE(std::abs(record.user.yaw_rate), 1.0);
    EXPECT_LE(std::abs(record.user.height), 1.0);
    EXPECT_TRUE(record.user.walk);
    EXPECT_TRUE(is_sound(record.plan)) << value;
  }
}

TEST(Controller, SensibleCommandsReachThePlanAsTheyAre) {
  Statue statue;
  statue.user = {.walk = true, .velocity = {0.2, -0.1}, .yaw_rate = 0.3, .height = -0.02};
  statue.run(1);
  const UserCommand& user = statue.controller.record().user;
  EXPECT_EQ(user.velocity, statue.user.velocity);
  EXPECT_EQ(user.yaw_rate, 0.3);
  EXPECT_EQ(user.height, -0.02);
}

TEST(Controller, TheSameInputsGiveTheSameBits) {
  Statue first, second;
  RandomMatrices random(2);
  const RobotState nominal = first.state;
  for (int tick = 0; tick < 600; ++tick) {
    RobotState believed = nominal;
    believed.time = 0.0025 * tick;
    believed.q += 0.01 * random.vector(kNumJoints);
    believed.qd = 0.1 * random.vector(kNumJoints);
    believed.v_WB = 0.05 * random.vector(3);
    believed.torque = 5.0 * random.vector(kNumJoints);
    believed.time = tick % 100 == 99 ? kNaN : believed.time;
    first.user = second.user = {.walk = tick > 10, .velocity = {0.1, 0.0}};
    const JointCommand& a = first.tick_with(believed);
    const JointCommand& b = second.tick_with(believed);
    ASSERT_EQ(a.torque, b.torque) << tick;
    ASSERT_EQ(a.mode, b.mode);
    const TickRecord &one = first.controller.record(), &other = second.controller.record();
    ASSERT_EQ(one.plan.com.p, other.plan.com.p);
    ASSERT_EQ(one.plan.event, other.plan.event);
    ASSERT_EQ(one.hierarchy.num_active, other.hierarchy.num_active);
  }
}

TEST(Controller, AllocatesNothingAfterTheFirstTickWhateverHappens) {
  Statue statue;
  statue.run(1);
  const RobotState unknown;
  RobotState absurd = statue.state;
  absurd.qd.setConstant(1e300);
  const test::MallocCounter counter;
  statue.run(50);
  (void)statue.tick_with(unknown);
  (void)statue.tick_with(absurd);
  statue.user = {.walk = true, .velocity = {kNaN, 0.1}};
  statue.run(600);
  EXPECT_EQ(counter.count(), 0u);
}

class Stages final : public StageObserver {
 public:
  void tick_begins() noexcept override { seen.clear(); }
  void stage_ends(Stage stage) noexcept override { seen.push_back(stage); }
  std::vector<Stage> seen;
};

TEST(Controller, TellsItsObserverWhenEachStageEnds) {
  Stages stages;
  Statue statue;
  statue.controller.set_stage_observer(&stages);
  statue.run(1);
  EXPECT_EQ(stages.seen, (std::vector<Stage>{Stage::estimate, Stage::model, Stage::plan,
                                             Stage::stack, Stage::solve, Stage::command}));
  (void)statue.tick_with(RobotState{});
  EXPECT_EQ(stages.seen, (std::vector<Stage>{Stage::estimate, Stage::command}))
      << "without a state there is nothing to plan";
  statue.controller.set_stage_observer(nullptr);
  stages.seen.clear();
  statue.run(1);
  EXPECT_TRUE(stages.seen.empty());
}

TEST(Controller, NamesItsLevelsAndTheirRows) {
  Statue statue;
  const std::vector<std::string> names = statue.controller.level_names();
  ASSERT_EQ(names.size(), 11u) << "Table I";
  statue.run(10);
  const HierarchyReport& report = statue.controller.record().hierarchy;
  ASSERT_EQ(report.num_levels, 11);
  for (int i = 0; i < report.num_active; ++i) {
    const ActiveRow& row = report.active[static_cast<std::size_t>(i)];
    EXPECT_NE(statue.controller.row_name(row.level, row.id), "?");
  }
  EXPECT_EQ(statue.controller.row_name(0, -1), "?");
}

TEST(Controller, TellsWhatItsModelLeftOut) {
  const Statue statue;
  EXPECT_FALSE(statue.controller.notes().empty()) << "the URDF's placeholder inertia";
}

std::string error_of(const ControllerOptions& options) {
  const RobotState state;
  try {
    const Controller controller(anymal_b(), options, std::make_unique<ScriptedEstimator>(state));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(Controller, OptionsThatMakeNoSenseAreErrors) {
  for (const double period : {0.0, -0.1, kNaN, kInfinity}) {
    ControllerOptions options = options_of();
    options.period = period;
    EXPECT_NE(error_of(options).find("period"), std::string::npos) << period;
  }
  EXPECT_NE(error_of(ControllerOptions{}).find("levels"), std::string::npos) << "no stack";
  EXPECT_THROW(Controller(anymal_b(), options_of(), nullptr), Error);
  RobotDescription robot = anymal_b();
  robot.base_link = "bse";
  const RobotState state;
  EXPECT_THROW(Controller(robot, options_of(), std::make_unique<ScriptedEstimator>(state)), Error);
}

}  // namespace
}  // namespace surefoot
