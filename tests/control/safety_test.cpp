// Which rung of the ladder is taken.
#include "surefoot/math/numbers.hpp"
#include "tests/control/safety_robot.hpp"

namespace surefoot::control {
namespace {

using test::anymal_b;
using test::expect_legal;
using test::kFirstFreeLevel;
using test::kPeriod;
using test::make_safety;
using test::solved;
using test::standing;
using test::tilted;
using test::torques;

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

}  // namespace
}  // namespace surefoot::control
