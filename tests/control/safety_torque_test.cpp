// The torques of each rung: springs, dampers, and their limits.
#include "surefoot/math/numbers.hpp"
#include "tests/control/safety_robot.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <algorithm>
#include <tuple>

namespace surefoot::control {
namespace {

using test::anymal_b;
using test::expect_legal;
using test::kFirstFreeLevel;
using test::kLimit;
using test::kPeriod;
using test::lying;
using test::make_safety;
using test::RandomMatrices;
using test::solved;
using test::standing;
using test::tilted;
using test::torques;

// Late drives would shake a light torso.
TEST(Safety, ANarrowTorsoIsHeldSoftlyAndAWideOneAsEver) {
  const double kp = anymal_b().hold_kp[0], kd = anymal_b().hold_kd[0];
  for (const auto& [inertia, spring, damping] :
       {std::tuple(0.35, kp, kd), std::tuple(0.04, 25.0, 0.6)}) {
    Safety safety = make_safety();
    safety.soften_roll(inertia);
    const solver::Solution solution = solved(JointVector::Zero(kNumLegJoints));
    RobotState state = standing();
    (void)safety.command(state, &solution);
    state.q.array() += 0.001;
    state.qd.array() += 0.1;
    const JointVector torque = safety.command(state, nullptr).torque;
    for (const Leg leg : kLegs) {
      EXPECT_NEAR(torque[first_joint(leg)], -0.001 * spring - 0.1 * damping, 1e-9);
      EXPECT_NEAR(torque[first_joint(leg) + 2], -0.001 * kp - 0.1 * kd, 1e-9);
    }
  }
}

TEST(Safety, HoldIsASpringAndDamperAboutTheLastGoodPosture) {
  const model::RobotDescription robot = anymal_b();
  Safety safety = make_safety();
  const solver::Solution good = solved(torques());
  (void)safety.command(standing(), &good);
  RobotState moved = standing();
  moved.q += JointVector::LinSpaced(kNumLegJoints, -0.05, 0.05);
  moved.qd = JointVector::LinSpaced(kNumLegJoints, 0.5, -0.5);
  const JointVector expected =
      torques() + robot.hold_kp[0] * (robot.q_nominal - moved.q) - robot.hold_kd[0] * moved.qd;
  EXPECT_LT((safety.command(moved, nullptr).torque - expected).norm(), 1e-12);
}

TEST(Safety, HoldsTheFirstPostureIfThereNeverWasAGoodTick) {
  const model::RobotDescription robot = anymal_b();
  RobotState absurd = standing();
  absurd.q[3] = 1e12;
  Safety safety = make_safety();
  EXPECT_EQ(safety.command(RobotState{}, nullptr).torque, JointVector::Zero(kNumLegJoints));
  EXPECT_EQ(safety.command(absurd, nullptr).torque, JointVector::Zero(kNumLegJoints))
      << "no posture";
  EXPECT_EQ(safety.command(standing(), nullptr).torque, JointVector::Zero(kNumLegJoints))
      << "the posture";
  RobotState moved = standing();
  moved.q += JointVector::LinSpaced(kNumLegJoints, -0.05, 0.05);
  moved.qd = JointVector::LinSpaced(kNumLegJoints, 0.5, -0.5);
  const JointVector expected =
      robot.hold_kp[0] * (robot.q_nominal - moved.q) - robot.hold_kd[0] * moved.qd;
  const JointCommand command = safety.command(moved, nullptr);
  EXPECT_EQ(command.mode, CommandMode::hold);
  EXPECT_LT((command.torque - expected).norm(), 1e-12);
}

TEST(Safety, UntilAGoodTickItHoldsTheFirstPostureOnTopOfWhatBearsTheRobot) {
  Safety safety = make_safety();
  EXPECT_FALSE(safety.has_begun());
  JointCommand command;
  for (int tick = 0; tick < 20; ++tick) {
    safety.bear(tick < 10 ? torques(10.0) : JointVector::Constant(kNumLegJoints, kNaN));
    command = safety.command(standing(tick * kPeriod), nullptr);
  }
  EXPECT_EQ(command.mode, CommandMode::hold);
  EXPECT_LT((command.torque - torques(10.0)).norm(), 1e-12);
  const solver::Solution good = solved(torques());
  for (int tick = 0; tick < 100; ++tick) command = safety.command(standing(), &good);
  EXPECT_EQ(command.torque, torques());
  EXPECT_TRUE(safety.has_begun());
  safety.bear(torques(10.0));
  command = safety.command(standing(), nullptr);
  EXPECT_EQ(command.torque, torques()) << "the last good torques";
}

// What is believed of a robot that begins late is uncertain for a while: torques come slowly.
TEST(Safety, TorquesOfARobotThatBeginsLateChangeSlowlyForHalfASecond) {
  constexpr int kHeld = 10, kSlow = 200;  // [ticks]
  const solver::Solution one = solved(torques(10.0)), other = solved(torques(-10.0));
  for (const int steady : {1, 20, kSlow - 1, kSlow, 2 * kSlow}) {
    Safety safety = make_safety();
    JointVector before = JointVector::Zero(kNumLegJoints);
    double largest = 0.0;
    for (int tick = 0; tick <= kHeld + steady; ++tick) {
      const solver::Solution* solution = tick < kHeld            ? nullptr
                                         : tick < kHeld + steady ? &one
                                                                 : &other;
      const JointVector torque = safety.command(standing(kPeriod * tick), solution).torque;
      largest = std::max(largest, (torque - before).cwiseAbs().maxCoeff());
      before = torque;
    }
    EXPECT_EQ(largest < SafetyOptions{}.max_torque_change + 1e-9, steady < kSlow) << steady;
  }
}

TEST(Safety, HoldDampsWhereThePositionIsNotKnownAndSpringsWhereTheVelocityIsNot) {
  const model::RobotDescription robot = anymal_b();
  Safety safety = make_safety();
  const solver::Solution good = solved(torques());
  (void)safety.command(standing(), &good);
  RobotState no_position = standing();
  no_position.q.setConstant(kNaN);
  no_position.qd.setConstant(0.5);
  const JointVector damped =
      torques() - JointVector::Constant(kNumLegJoints, 0.5 * robot.hold_kd[0]);
  EXPECT_LT((safety.command(no_position, nullptr).torque - damped).norm(), 1e-12);
  RobotState no_velocity = standing();
  no_velocity.q.array() += 0.05;
  no_velocity.qd.setConstant(kNaN);
  const JointVector sprung =
      torques() - JointVector::Constant(kNumLegJoints, 0.05 * robot.hold_kp[0]);
  EXPECT_LT((safety.command(no_velocity, nullptr).torque - sprung).norm(), 1e-12);
}

TEST(Safety, WhereItIsToBeCarefulTorquesChangeSlowlyUntilTheyHaveCaughtUp) {
  const solver::Solution one = solved(torques(10.0)), other = solved(torques(-10.0));
  Safety safety = make_safety();
  JointVector before = safety.command(standing(), &one).torque;
  safety.limit_next_change();
  int ticks = 0;
  for (; before != torques(-10.0) && ticks < 100; ++ticks) {
    const JointVector torque = safety.command(standing(), &other).torque;
    ASSERT_LE((torque - before).cwiseAbs().maxCoeff(), SafetyOptions{}.max_torque_change + 1e-9);
    before = torque;
  }
  EXPECT_EQ(ticks, 11) << "42 N·m at most by 4";
  EXPECT_EQ(safety.command(standing(), &one).torque, torques(10.0)) << "no longer";
}

// Behind a late drive all of the damping lets a leg that bears nothing swing back and forth.
TEST(Safety, DampingBrakesEveryJointAtLastAsSoftlyAsALegNeedsThatBearsNothing) {
  Safety safety = make_safety();
  RobotState state = tilted(2.0);
  state.qd = JointVector::LinSpaced(kNumLegJoints, -3.0, 3.0);
  const solver::Solution good = solved(torques());
  (void)safety.command(standing(), &good);
  JointVector torque(kNumLegJoints);
  for (int tick = 0; tick <= 1000; ++tick) {
    torque = safety.command(state, &good).torque;
    if (tick < 20) continue;  // torques change by so much a tick
    const double kd = 6.0 + (0.7 - 6.0) * std::min(1.0, tick * kPeriod);
    ASSERT_LT((torque + kd * state.qd).norm(), 1e-9) << tick;
  }
}

// Velocities believed wrong change their sign from tick to tick.
TEST(Safety, NoDampingLetsTorquesJump) {
  Safety safety = make_safety();
  const solver::Solution good = solved(torques(30.0));
  JointVector before = safety.command(standing(), &good).torque;
  for (int tick = 0; tick < 40; ++tick) {
    RobotState state = tilted(2.0);
    state.qd.setConstant(tick % 4 < 2 ? 50.0 : -50.0);
    const JointCommand& command = safety.command(state, &good);
    EXPECT_EQ(command.mode, CommandMode::damping);
    EXPECT_LE((command.torque - before).cwiseAbs().maxCoeff(),
              SafetyOptions{}.max_torque_change + 1e-9);
    before = command.torque;
  }
}

TEST(Safety, ClipsEveryRungToTheTorqueLimits) {
  const solver::Solution strong = solved(torques(1e3));
  Safety safety = make_safety();
  EXPECT_EQ(safety.command(standing(), &strong).torque,
            JointVector::Constant(kNumLegJoints, kLimit));
  RobotState away = standing();
  away.q.array() += 3.0;
  EXPECT_EQ(safety.command(away, nullptr).torque, JointVector::Constant(kNumLegJoints, -kLimit));
  RobotState fast = tilted(2.0);
  fast.qd.setConstant(-1e6);
  for (int tick = 0; tick < 30; ++tick) (void)safety.command(fast, &strong);
  EXPECT_EQ(safety.command(fast, &strong).torque, JointVector::Constant(kNumLegJoints, kLimit));
}

TEST(Safety, ClipsEveryJointToItsOwnLimit) {
  model::RobotDescription robot = anymal_b();
  robot.torque_limit = JointVector::LinSpaced(kNumLegJoints, 1.0, 12.0);
  Safety safety({}, robot, kFirstFreeLevel, lying(), kPeriod);
  const solver::Solution strong = solved(JointVector::Constant(kNumLegJoints, -1e3));
  EXPECT_EQ(safety.command(standing(), &strong).torque, -robot.torque_limit);
}

TEST(Safety, AStateOfNaNGivesAFiniteCommandOneTickLater) {
  Safety safety = make_safety();
  const solver::Solution good = solved(torques());
  (void)safety.command(standing(3.5), &good);
  const JointCommand command = safety.command(RobotState{}, nullptr);
  expect_legal(command);
  EXPECT_EQ(command.mode, CommandMode::hold);
  EXPECT_EQ(command.time, 3.5 + kPeriod);
  EXPECT_EQ(command.torque, torques()) << "what is not measured adds nothing";
}

TEST(Safety, WhateverComesTheCommandIsFiniteAndInsideTheLimits) {
  const std::array<double, 8> odd{kNaN, kInfinity, -kInfinity, 1e308, -1e308, 1e-308, 0.0, 1e30};
  RandomMatrices random(1);
  const auto garbage = [&](double usual) {
    return random.chance(0.2) ? odd[static_cast<std::size_t>(random.integer(0, 7))] : usual;
  };
  Safety safety = make_safety();
  for (int tick = 0; tick < 3000; ++tick) {
    if (tick % 100 == 0) safety = make_safety();  // damping is latched
    RobotState state = standing(garbage(0.1 * tick));
    for (double& value : state.q) value = garbage(value);
    for (double& value : state.qd) value = garbage(0.1);
    for (double& value : state.q_WB.coeffs()) value = tick % 3 == 0 ? garbage(value) : value;
    solver::Solution solution =
        solved(100.0 * random.vector(kNumLegJoints),
               static_cast<solver::SolveStatus>(random.integer(0, 2)), random.integer(-1, 8));
    for (double& value : solution.x) value = tick % 2 == 0 ? garbage(value) : value;
    ASSERT_NO_FATAL_FAILURE(
        expect_legal(safety.command(state, random.chance(0.8) ? &solution : nullptr)))
        << tick;
  }
}

}  // namespace
}  // namespace surefoot::control
