// The controller with states that make none: legal commands, and no trace left.
#include "surefoot/signals/plan_event.hpp"
#include "surefoot/solver/solution.hpp"
#include "tests/control/statue.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <cmath>
#include <functional>
#include <vector>

namespace surefoot::control {
namespace {

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
  for (Eigen::Index i = 0; i < kNumLegJoints; ++i) {
    numbers.emplace_back([i](RobotState& s) -> double& { return s.q[i]; });
    numbers.emplace_back([i](RobotState& s) -> double& { return s.qd[i]; });
    numbers.emplace_back([i](RobotState& s) -> double& { return s.torque[i]; });
  }
  return numbers;
}

TEST(Controller, AReadingOfAnotherRobotIsToldAndGivesALegalCommand) {
  test::Statue statue;
  statue.run(20);
  SensorReading reading = statue.reading;
  for (int i = 1; i < 400; ++i) {
    reading.time += statue.period;
    reading.q = reading.torque = JointVector::Zero(18);
    test::expect_legal(statue.controller.step(reading, statue.user));
  }
  EXPECT_EQ(statue.controller.fault(), "the reading does not have the robot's number of joints");
  EXPECT_NE(statue.controller.record().command.mode, CommandMode::optimal);
}

TEST(Controller, FootSensorsOfAnotherRobotAreTold) {
  test::Statue statue;
  statue.run(20);
  SensorReading reading = statue.reading;
  for (const double force : {kNaN, 50.0}) {
    reading.time += statue.period;
    reading.foot_force = per_leg(force, 6);
    test::expect_legal(statue.controller.step(reading, statue.user));
    EXPECT_EQ(statue.controller.record().reading.foot_force.size(), 4u);
    EXPECT_EQ(statue.controller.fault(),
              std::isnan(force)
                  ? ""
                  : "the reading's foot_force does not have the robot's number of legs");
  }
}

TEST(Controller, EveryReadingThatIsNotANumberGivesALegalCommandAndIsForgottenAtOnce) {
  test::Statue statue;
  statue.user = {.walk = true, .velocity = {0.05, 0.0}};
  statue.run(20);
  for (const auto& number : numbers_of_a_state()) {
    for (const double bad : {kNaN, kInfinity, -kInfinity}) {
      RobotState believed = statue.state;
      number(believed) = bad;
      const JointCommand& command = statue.tick_with(believed);
      ASSERT_NO_FATAL_FAILURE(test::expect_legal(command));
      ASSERT_EQ(command.mode, CommandMode::hold);
      ASSERT_EQ(statue.tick().mode, CommandMode::optimal);
      ASSERT_TRUE(test::is_sound(statue.controller.record().plan));
    }
  }
}

TEST(Controller, EveryAbsurdReadingGivesALegalCommandAndIsForgottenSoon) {
  for (const double absurd : {1e300, -1e300, 1e12, -1e5}) {
    for (const auto& number : numbers_of_a_state()) {
      test::Statue statue;
      statue.run(3);
      RobotState believed = statue.state;
      number(believed) = absurd;
      ASSERT_NO_FATAL_FAILURE(test::expect_legal(statue.tick_with(believed)));
      for (int i = 0; i < 40; ++i) ASSERT_NO_FATAL_FAILURE(test::expect_legal(statue.tick()));
      const TickRecord& record = statue.controller.record();
      ASSERT_EQ(record.command.mode, CommandMode::optimal);
      ASSERT_TRUE(test::is_sound(record.plan));
      for (const Vec3& force : record.state.foot_force) ASSERT_LT(force.norm(), 1e3);
    }
  }
}

TEST(Controller, HoldsThroughTicksWithoutAStateAndGoesOn) {
  test::Statue statue;
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
  test::Statue statue;
  statue.user = {.walk = true, .velocity = {0.05, 0.0}};
  const TickRecord& record = statue.controller.record();
  for (int i = 0; i < 2000 && record.plan.events.empty(); ++i) (void)statue.tick();
  ASSERT_FALSE(record.plan.events.empty()) << "nothing ever happens";
  ASSERT_EQ(record.hierarchy.status, static_cast<int>(solver::SolveStatus::optimal));
  const int num_levels = record.hierarchy.num_levels;
  (void)statue.tick_with(RobotState{});
  EXPECT_TRUE(record.plan.events.empty());
  EXPECT_EQ(record.hierarchy.status, static_cast<int>(solver::SolveStatus::invalid_input));
  EXPECT_EQ(record.hierarchy.num_levels, num_levels);
  EXPECT_EQ(record.hierarchy.num_active, 0);
  for (const LevelReport& level : record.hierarchy.levels) {
    EXPECT_TRUE(std::isnan(level.residual));
    EXPECT_EQ(level.num_rows, 0);
  }
  EXPECT_TRUE(record.model.p_WCom.array().isNaN().all());
  for (const Vec3& force : record.model.force) EXPECT_TRUE(force.array().isNaN().all());
  (void)statue.tick();
  EXPECT_EQ(record.hierarchy.status, static_cast<int>(solver::SolveStatus::optimal));
}

TEST(Controller, TheSameReadingOverAndOverIsNoNews) {
  test::Statue statue;
  statue.run(20);
  EXPECT_EQ(statue.controller.step(statue.reading, statue.user).mode, CommandMode::hold);
  EXPECT_EQ(statue.tick().mode, CommandMode::optimal);
  JointVector before = statue.controller.record().command.torque;
  for (int i = 1; i <= 9; ++i) {
    const JointCommand& command = statue.controller.step(statue.reading, statue.user);
    ASSERT_EQ(command.mode, i <= 8 ? CommandMode::hold : CommandMode::damping) << i;
    ASSERT_LT((command.torque - before).norm(), 1.0) << "its torques fade";
    before = command.torque;
  }
  const JointCommand& command = statue.controller.record().command;
  EXPECT_EQ(command.cause, StopCause::encoders);
  EXPECT_EQ(command.fault, SampleFault::silent);
  EXPECT_EQ(statue.tick().mode, CommandMode::damping) << "latched";
}

TEST(Controller, AnEmptyReadingLeavesNoTrace) {
  test::Statue statue, other;
  statue.run(60);  // longer than the first readings can be contradicted
  other.run(61);
  JointVector before = statue.controller.record().command.torque;
  SensorReading empty;
  empty.time = empty.encoder_time = empty.torque_time = empty.imu_time = 0.0;
  empty.q.setZero();
  empty.torque.setZero();
  empty.gyro.setZero();
  empty.accelerometer.setZero();
  const double most = SafetyOptions{}.max_torque_change + 1e-9;
  EXPECT_EQ(statue.controller.step(empty, {}).torque, before) << "nothing was measured";
  statue.state.time += statue.period;
  for (int i = 0; i < 40; ++i) {
    before = statue.controller.record().command.torque;
    (void)statue.tick();
    (void)other.tick();
    const TickRecord& record = statue.controller.record();
    ASSERT_EQ(record.command.mode, CommandMode::optimal);
    ASSERT_LE((record.command.torque - before).cwiseAbs().maxCoeff(), most);
    for (std::size_t k = 0; k < kNumLegs; ++k) {
      const Vec3& usual = other.controller.record().state.foot_force[k];
      ASSERT_LT((record.state.foot_force[k] - usual).norm(), 20.0) << i;
    }
  }
}

TEST(Controller, AfterAPauseAJointIsAsFastAsItWas) {
  test::Statue statue;
  const auto move = [&](double time) {
    statue.state.q[2] += 0.5 * time;
    statue.state.qd[2] = 0.5;
    statue.state.time += time - statue.period;
    (void)statue.tick();
  };
  for (int i = 0; i < 100; ++i) move(statue.period);
  move(0.05);
  for (int i = 0; i < 40; ++i) {
    move(statue.period);
    (void)statue.controller.step(
        [&] {
          SensorReading r = statue.reading;
          r.time = kNaN;
          return r;
        }(),
        {});
    EXPECT_LT(std::abs(statue.controller.record().state.qd[2] - 0.5), 0.6) << i;
  }
}

TEST(Controller, WithoutAClockItSitsDownByTheAnglesThatComeAndThenDamps) {
  test::Statue statue;
  const auto swing = [&](double velocity, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      statue.state.q[2] += velocity * statue.period;
      statue.state.qd[2] = velocity;
      statue.reading.q = statue.state.q;
      if (velocity > 0.0) {
        (void)statue.tick();
      } else {
        statue.reading.time = kNaN;
        ASSERT_NO_FATAL_FAILURE(test::expect_legal(statue.controller.step(statue.reading, {})));
      }
    }
  };
  ASSERT_NO_FATAL_FAILURE(swing(0.5, 40));
  ASSERT_NO_FATAL_FAILURE(swing(-0.5, 40));
  const TickRecord& record = statue.controller.record();
  EXPECT_EQ(record.command.mode, CommandMode::sit);
  EXPECT_EQ(record.command.cause, StopCause::encoders);
  EXPECT_EQ(record.command.fault, SampleFault::late);
  ASSERT_NO_FATAL_FAILURE(swing(-0.5, 1220));
  EXPECT_EQ(record.command.mode, CommandMode::damping);
  EXPECT_NEAR(record.state.qd[2], -0.5, 0.1);
  EXPECT_GT(record.command.torque[2], 0.0);
}

TEST(Controller, StartsSafelyWithoutAState) {
  test::Statue statue;
  for (int i = 0; i < 5; ++i) {
    ASSERT_NO_FATAL_FAILURE(test::expect_legal(statue.tick_with(RobotState{})));
  }
  EXPECT_EQ(statue.tick().mode, CommandMode::optimal);
}

TEST(Controller, WithoutAClockFromTheStartARobotWithAnArmGetsLegalCommands) {
  const model::RobotDescription robot = test::anymal_b_with_arm();
  ControllerOptions options = test::options_of();
  options.stack = with_arms(options.stack, robot);
  RobotState state;
  Controller controller(robot, options, std::make_unique<test::ScriptedEstimator>(state));
  SensorReading reading;
  for (int tick = 0; tick < 400; ++tick) {
    if (tick == 1) reading.q = reading.torque = JointVector::Zero(robot.num_joints());
    const JointCommand& command = controller.step(reading, {});
    ASSERT_EQ(command.torque.size(), robot.num_joints()) << tick;
    ASSERT_TRUE(command.torque.allFinite()) << tick;
    ASSERT_TRUE((command.torque.cwiseAbs().array() <= robot.torque_limit.array()).all()) << tick;
    ASSERT_TRUE(std::isfinite(command.time)) << tick;
    ASSERT_NE(command.mode, CommandMode::optimal) << tick;
  }
}

TEST(Controller, AnyGarbageGivesALegalCommand) {
  const std::array<double, 10> odd{kNaN, kInfinity, -kInfinity, 1e308, -1e308,
                                   1e30, -1e9,      1e-308,     0.0,   7.0};
  test::RandomMatrices random(1);
  const auto odd_one = [&] { return odd[static_cast<std::size_t>(random.integer(0, 9))]; };
  const auto numbers = numbers_of_a_state();
  ControllerOptions options = test::options_of();
  options.safety = {.damp_after_failures = 1000000, .max_tilt = 4.0};  // never stop trying
  test::Statue statue(options);
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
    ASSERT_NO_FATAL_FAILURE(test::expect_legal(statue.tick_with(believed))) << tick;
    ASSERT_NO_FATAL_FAILURE(test::expect_legal(statue.tick())) << tick;
  }
}

}  // namespace
}  // namespace surefoot::control
