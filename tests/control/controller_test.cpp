// The controller with states that make sense, and what it tells of itself.
#include "surefoot/base/error.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/solver/solution.hpp"
#include "tests/control/statue.hpp"
#include "tests/support/event_kinds.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace surefoot::control {
namespace {

using test::holds;

TEST(Controller, CarriesAStandingRobotOnItsFeet) {
  test::Statue statue;
  statue.run(200);
  const TickRecord& record = statue.controller.record();
  EXPECT_EQ(record.command.mode, CommandMode::optimal);
  EXPECT_EQ(record.hierarchy.status, static_cast<int>(solver::SolveStatus::optimal));
  EXPECT_EQ(record.plan.num_contacts(), 4);
  Vec3 force = Vec3::Zero();
  for (const Vec3& f : record.model.force) force += f;
  const double weight = model::RobotModel(test::anymal_b()).mass() * kGravity;
  EXPECT_NEAR(force.z(), weight, 0.02 * weight);
  EXPECT_LT(force.head<2>().norm(), 0.05 * weight) << "it only draws the COM to the middle";
  EXPECT_EQ(record.command.time, statue.state.time);
  EXPECT_EQ(record.state.q, statue.state.q);
  for (const Leg leg : kLegs) {
    EXPECT_NEAR(record.model.p_WF[index(leg)].z(), 0.0, 1e-6);
    EXPECT_GT(record.state.foot_force[index(leg)].z(), 30.0) << "as estimated from the torques";
  }
}

TEST(Controller, AbsurdCommandsOfTheOperatorAreLimited) {
  const std::array<double, 6> absurd{kNaN, kInfinity, -kInfinity, 1e300, -1e9, 50.0};
  for (const double value : absurd) {
    test::Statue statue;
    statue.user = {.walk = true, .velocity = {value, -value}, .yaw_rate = value, .height = value};
    statue.run(400);
    const TickRecord& record = statue.controller.record();
    ASSERT_NO_FATAL_FAILURE(test::expect_legal(record.command));
    EXPECT_LE(record.user.velocity.cwiseAbs().maxCoeff(), UserCommand::kFastest);
    EXPECT_LE(std::abs(record.user.yaw_rate), UserCommand::kFastest);
    EXPECT_LE(std::abs(record.user.height), 0.3);
    EXPECT_TRUE(record.user.walk);
    EXPECT_EQ(record.user.gait == UserCommand::kKeepGait, !std::isfinite(value)) << value;
    EXPECT_TRUE(test::is_sound(record.plan)) << value;
  }
}

TEST(Controller, SensibleCommandsReachThePlanAsTheyAre) {
  test::Statue statue;
  statue.user = {.walk = true, .velocity = {0.2, -0.1}, .yaw_rate = 0.3, .height = -0.02};
  statue.run(1);
  const UserCommand& user = statue.controller.record().user;
  EXPECT_EQ(user.velocity, statue.user.velocity);
  EXPECT_EQ(user.yaw_rate, 0.3);
  EXPECT_EQ(user.height, -0.02);
}

TEST(Controller, TheSameInputsGiveTheSameBits) {
  test::Statue first, second;
  test::RandomMatrices random(2);
  const RobotState nominal = first.state;
  for (int tick = 0; tick < 600; ++tick) {
    RobotState believed = nominal;
    believed.time = 0.0025 * tick;
    believed.q += 0.01 * random.vector(kNumLegJoints);
    believed.qd = 0.1 * random.vector(kNumLegJoints);
    believed.v_WB = 0.05 * random.vector(3);
    believed.torque = 5.0 * random.vector(kNumLegJoints);
    believed.time = tick % 100 == 99 ? kNaN : believed.time;
    first.user = second.user = {.walk = tick > 10, .velocity = {0.1, 0.0}};
    const JointCommand& a = first.tick_with(believed);
    const JointCommand& b = second.tick_with(believed);
    ASSERT_EQ(a.torque, b.torque) << tick;
    ASSERT_EQ(a.mode, b.mode);
    const TickRecord &one = first.controller.record(), &other = second.controller.record();
    ASSERT_EQ(one.plan.com.p, other.plan.com.p);
    ASSERT_EQ(test::kinds_of(one.plan.events), test::kinds_of(other.plan.events));
    ASSERT_EQ(one.hierarchy.num_active, other.hierarchy.num_active);
  }
}

/// As before the estimate begins.
RobotState known_by_its_joints(const test::Statue& statue) {
  RobotState state;
  state.time = statue.state.time;
  state.q = statue.state.q;
  state.qd = statue.state.qd;
  return state;
}

TEST(Controller, BearsTheRobotUntilItsBaseIsKnown) {
  test::Statue statue;
  model::RobotModel model(test::anymal_b());
  const JointVector bearing = standing_torque(model, statue.state.q);
  ASSERT_GT(bearing.cwiseAbs().maxCoeff(), 10.0);
  JointCommand command;
  for (int tick = 0; tick < 20; ++tick) command = statue.tick_with(known_by_its_joints(statue));
  EXPECT_EQ(command.mode, CommandMode::hold);
  EXPECT_LT((command.torque - bearing).norm(), 1e-9);
  EXPECT_EQ(statue.tick().mode, CommandMode::optimal);
}

TEST(Controller, AllocatesNothingAfterTheFirstTickWhateverHappens) {
  test::Statue statue;
  statue.run(1);
  const RobotState unknown;
  RobotState absurd = statue.state;
  absurd.qd.setConstant(1e300);
  test::Statue held;
  const test::MallocCounter counter;
  (void)held.tick_with(known_by_its_joints(held));
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
  test::Statue statue;
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
  test::Statue statue;
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
  const test::Statue statue;
  EXPECT_FALSE(statue.controller.notes().empty()) << "the URDF's placeholder inertia";
}

std::string error_of(const ControllerOptions& options) {
  return test::message_of([&] {
    const Controller controller(test::anymal_b(), options,
                                std::make_unique<test::ScriptedEstimator>(RobotState()));
  });
}

TEST(Controller, OptionsThatMakeNoSenseAreErrors) {
  for (const double period : {0.0, -0.1, kNaN, kInfinity}) {
    ControllerOptions options = test::options_of();
    options.period = period;
    EXPECT_TRUE(holds(error_of(options), "period")) << period;
  }
  EXPECT_TRUE(holds(error_of(ControllerOptions{}), "levels")) << "no stack";
  EXPECT_THROW(Controller(test::anymal_b(), test::options_of(), nullptr), Error);
  model::RobotDescription robot = test::anymal_b();
  robot.base_link = "bse";
  const RobotState state;
  EXPECT_THROW(
      Controller(robot, test::options_of(), std::make_unique<test::ScriptedEstimator>(state)),
      Error);
}

}  // namespace
}  // namespace surefoot::control
