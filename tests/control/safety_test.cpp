#include "surefoot/control/safety.hpp"

#include "surefoot/math/numbers.hpp"
#include "surefoot/math/rotation.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/random_hierarchy.hpp"
#include "tests/support/sizes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace surefoot::control {
namespace {

using test::anymal_b;
using test::RandomMatrices;

constexpr int kFirstFreeLevel = 4;
constexpr double kPeriod = 0.0025;  // [s]
constexpr double kLimit = 40.0;     // of every joint of the robot [N·m]

RobotState standing(double time = 1.0) {
  RobotState state;
  state.time = time;
  state.p_WB = Vec3(0.0, 0.0, 0.46);
  state.q_WB = Quat::Identity();
  state.v_WB.setZero();
  state.w_WB_B.setZero();
  state.q = anymal_b().q_nominal;
  state.qd.setZero();
  state.torque.setZero();
  return state;
}

RobotState tilted(double roll) {
  RobotState state = standing();
  state.q_WB = from_roll_pitch_yaw({roll, 0.0, 0.3});
  return state;
}

JointVector torques(double first = 1.0) {
  return first * JointVector::LinSpaced(kNumLegJoints, 1.0, 2.1);
}

solver::Solution solved(const JointVector& torque,
                        solver::SolveStatus status = solver::SolveStatus::optimal,
                        int failed_level = -1) {
  solver::Solution solution;
  solution.status = status;
  solution.failed_level = failed_level;
  solution.x = VecX::Constant(kNumUnknowns, 99.0);
  solution.x.tail<kNumLegJoints>() = torque;
  return solution;
}

/// Where it sits down to: folded.
JointVector lying() { return 2.5 * anymal_b().q_nominal; }

Safety make_safety(const SafetyOptions& options = {}) {
  return Safety(options, anymal_b(), kFirstFreeLevel, lying(), kPeriod);
}

void expect_legal(const JointCommand& command) {
  ASSERT_TRUE(command.torque.allFinite());
  ASSERT_LE(command.torque.cwiseAbs().maxCoeff(), kLimit);
  ASSERT_TRUE(std::isfinite(command.time));
}

// Off its feet nothing is solved: that is no failure, however long it lasts.
TEST(Safety, TakesThePostureOfARobotThatIsNotOnItsFeet) {
  Safety safety = make_safety();
  const solver::Solution solution = solved(torques());
  (void)safety.command(standing(), &solution);
  const LegPosture posture{.q = anymal_b().q_nominal + JointVector::Constant(kNumLegJoints, 0.1),
                           .qd = JointVector::Zero(kNumLegJoints),
                           .softness = 0.0,
                           .stands = {},
                           .bears = 0.5};
  JointVector before = torques();
  for (int i = 0; i < 1000; ++i) {
    safety.bear(torques());
    safety.pose(posture, CommandMode::lifted);
    const JointCommand command = safety.command(tilted(1.5), nullptr);
    expect_legal(command);
    EXPECT_LE((command.torque - before).cwiseAbs().maxCoeff(), 4.0 + 1e-9);
    ASSERT_EQ(command.mode, CommandMode::lifted);
    before = command.torque;
  }
  const double soft = 0.4 * anymal_b().hold_kp[0] * 0.1;
  EXPECT_LT((before - 0.5 * torques() - JointVector::Constant(kNumLegJoints, soft)).norm(), 1e-9);
  EXPECT_EQ(safety.command(standing(), &solution).mode, CommandMode::optimal);
}

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

TEST(Safety, OneThatRisesAskewIsStopped) {
  Safety safety = make_safety();
  for (int i = 0; i < 100; ++i) {
    safety.pose({}, CommandMode::rise);
    (void)safety.command(tilted(1.5), nullptr);
  }
  EXPECT_TRUE(safety.has_stopped());
}

TEST(Safety, OneThatCanNotStandIsDampedAndSaysSo) {
  Safety safety = make_safety();
  safety.pose({}, CommandMode::rise);
  safety.give_up(StopCause::cannot_stand);
  const JointCommand command = safety.command(standing(), nullptr);
  EXPECT_EQ(command.mode, CommandMode::damping);
  EXPECT_EQ(command.cause, StopCause::cannot_stand);
}

// Its joints do what encoders can't follow; what matters is that it falls.
TEST(Safety, EncodersThatFailAsItTipsOverAreNotTheCause) {
  for (const double rate : {3.0, 0.0, -3.0}) {
    SCOPED_TRACE(rate);
    Safety safety = make_safety();
    const solver::Solution solution = solved(torques());
    (void)safety.command(standing(), &solution);
    RobotState state = tilted(0.6);
    state.w_WB_B = Vec3(rate, 0.0, 0.0);
    SensorHealth health;
    health.encoders = {.fault = SampleFault::jump, .age = 0.1, .joint = 2};
    const JointCommand command = safety.command(state, nullptr, health);
    const bool tips = rate > 0.0;
    EXPECT_EQ(command.cause, tips ? StopCause::tilt : StopCause::encoders);
    EXPECT_EQ(command.mode, tips ? CommandMode::damping : CommandMode::sit);
  }
}

TEST(Safety, PassesTheOptimumOn) {
  Safety safety = make_safety();
  const solver::Solution solution = solved(torques());
  const JointCommand command = safety.command(standing(2.5), &solution);
  EXPECT_EQ(command.mode, CommandMode::optimal);
  EXPECT_EQ(command.torque, torques());
  EXPECT_EQ(command.time, 2.5);
}

TEST(Safety, UsesASolveThatEndedAfterTheLevelsThatKeepThePhysics) {
  Safety safety = make_safety();
  for (const int level : {kFirstFreeLevel, kFirstFreeLevel + 3}) {
    const solver::Solution solution = solved(torques(), solver::SolveStatus::iteration_cap, level);
    const JointCommand command = safety.command(standing(), &solution);
    EXPECT_EQ(command.mode, CommandMode::degraded);
    EXPECT_EQ(command.torque, torques());
  }
}

TEST(Safety, HoldsTheJointsWhereTheSolveIsOfNoUse) {
  const JointVector not_a_number = JointVector::Constant(kNumLegJoints, kNaN);
  solver::Solution too_short = solved(torques());
  too_short.x.conservativeResize(12);
  for (const solver::Solution& useless :
       {solved(torques(), solver::SolveStatus::iteration_cap, kFirstFreeLevel - 1),
        solved(torques(), solver::SolveStatus::invalid_input), too_short, solved(not_a_number),
        solved(torques(kInfinity))}) {
    Safety safety = make_safety();
    const solver::Solution good = solved(torques(2.0));
    (void)safety.command(standing(), &good);
    const JointCommand command = safety.command(standing(), &useless);
    EXPECT_EQ(command.mode, CommandMode::hold);
    EXPECT_EQ(command.torque, torques(2.0)) << "the last good torques, at the last good posture";
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

TEST(Safety, ComesBackFromAFewBadTicks) {
  Safety safety = make_safety({.damp_after_failures = 10});
  const solver::Solution good = solved(torques());
  for (int round = 0; round < 5; ++round) {
    EXPECT_EQ(safety.command(standing(), &good).mode, CommandMode::optimal);
    for (int i = 0; i < 10; ++i) {
      EXPECT_EQ(safety.command(standing(), nullptr).mode, CommandMode::hold);
    }
  }
}

TEST(Safety, DampsForGoodAfterTooManyBadTicks) {
  Safety safety = make_safety({.damp_after_failures = 10});
  const solver::Solution good = solved(torques());
  (void)safety.command(standing(), &good);
  for (int i = 0; i < 10; ++i) (void)safety.command(standing(), nullptr);
  EXPECT_EQ(safety.command(standing(), nullptr).mode, CommandMode::damping);
  EXPECT_EQ(safety.command(standing(), &good).mode, CommandMode::damping) << "it is latched";
}

TEST(Safety, DampsForGoodWhenTheTorsoIsTiltedTooFar) {
  const SafetyOptions options{.max_tilt = 1.0};
  const solver::Solution good = solved(torques());
  Safety safety = make_safety(options);
  EXPECT_EQ(safety.command(tilted(0.99), &good).mode, CommandMode::optimal);
  EXPECT_EQ(safety.command(tilted(-1.01), &good).mode, CommandMode::damping);
  EXPECT_EQ(safety.command(standing(), &good).mode, CommandMode::damping) << "it is latched";
}

// Its first reading may be wrong.
TEST(Safety, OfARobotThatHasNotBegunATiltIsBelievedAfter30Ms) {
  const solver::Solution good = solved(torques());
  Safety upside_down = make_safety(), righted = make_safety();
  for (int tick = 0; tick < 12; ++tick) {
    EXPECT_EQ(upside_down.command(tilted(kPi), &good).mode, CommandMode::hold);
    EXPECT_EQ(righted.command(tilted(kPi), &good).mode, CommandMode::hold);
  }
  EXPECT_EQ(upside_down.command(tilted(kPi), &good).mode, CommandMode::damping);
  EXPECT_EQ(righted.command(standing(), &good).mode, CommandMode::optimal);
}

TEST(Safety, ThatBeginsAnewForgetsItsPostureButNotItsTorques) {
  const solver::Solution good = solved(torques(10.0));
  Safety safety = make_safety();
  RobotState elsewhere = standing();
  elsewhere.q.setConstant(0.3);
  JointVector before = safety.command(elsewhere, &good).torque;
  safety.restart();
  EXPECT_FALSE(safety.has_begun());
  for (int tick = 0; tick < 30; ++tick) {
    safety.bear(torques(5.0));
    const JointCommand& command = safety.command(standing(tick * kPeriod), nullptr);
    EXPECT_EQ(command.mode, CommandMode::hold);
    EXPECT_LE((command.torque - before).cwiseAbs().maxCoeff(),
              SafetyOptions{}.max_torque_change + 1e-9);
    before = command.torque;
  }
  EXPECT_LT((before - torques(5.0)).norm(), 1e-12) << "held where it is now";
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

TEST(Safety, ThatBeginsAnewAgainAndAgainDampsInTheEnd) {
  Safety safety = make_safety();
  int tick = 0;
  for (; !safety.has_stopped() && tick < 2000; ++tick) {
    if (tick % 20 == 0) safety.restart();
    (void)safety.command(standing(tick * kPeriod), nullptr);
  }
  EXPECT_NEAR(tick * kPeriod, 2.0, 0.01);
}

TEST(Safety, DoesNotTakeABrokenOrientationForATilt) {
  const solver::Solution good = solved(torques());
  for (const double scale : {0.0, -3.0, 1e5, 1e300, kInfinity}) {
    Safety safety = make_safety();
    RobotState state = tilted(0.5);
    state.q_WB.coeffs() *= scale;
    EXPECT_EQ(safety.command(state, nullptr).mode, CommandMode::hold) << scale;
    EXPECT_EQ(safety.command(standing(), &good).mode, CommandMode::optimal) << scale;
  }
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
