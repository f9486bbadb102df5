// The ladder where a sensor is at fault: bridged, then down slowly.
#include "surefoot/control/safety.hpp"
#include "surefoot/math/rotation.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/random_hierarchy.hpp"
#include "tests/support/sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::control {
namespace {

using test::anymal_b;
using test::RandomMatrices;

constexpr double kPeriod = 0.0025;
constexpr double kLimit = 40.0;  // of every joint of the robot [N·m]
constexpr double kMostChange = SafetyOptions{}.max_torque_change;
constexpr int kSits = static_cast<int>(SafetyOptions{}.sit_duration / kPeriod);  // [ticks]

JointVector lying() { return 2.5 * anymal_b().q_nominal; }

SensorHealth failing(GroupHealth SensorHealth::* group, double age) {
  SensorHealth health{.encoders = {.age = 0.0}, .joint_torques = {.age = 0.0}, .imu = {.age = 0.0}};
  health.*group = {.fault = SampleFault::silent, .age = age};
  return health;
}

/// A safety stage, tick by tick, with a robot that stands still, behind as many good ticks.
struct Stage {
  explicit Stage(int good_ticks = 0) {
    state.q_WB = Quat::Identity();
    state.q = anymal_b().q_nominal;
    state.qd.setZero();
    solution.status = solver::SolveStatus::optimal;
    solution.x = VecX::Zero(kNumUnknowns);
    solve(JointVector::Constant(kNumLegJoints, 10.0));
    for (int i = 0; i < good_ticks; ++i) (void)tick();
  }
  void solve(const JointVector& torque) { solution.x.tail<kNumLegJoints>() = torque; }
  const JointCommand& tick(const SensorHealth& health = {}) {
    state.time = kPeriod * ++ticks;
    return safety.command(state, &solution, health);
  }
  const JointCommand& refused_tick(const SensorHealth& health) {
    state.time = kPeriod * ++ticks;
    return safety.command(state, nullptr, health);
  }

  Safety safety{{}, anymal_b(), 4, lying(), kPeriod};
  RobotState state;
  solver::Solution solution;
  int ticks = 0;
};

TEST(SafetyOfSensors, AShortGapChangesNothingButHowFastTorquesChange) {
  Stage stage(1);
  stage.solve(JointVector::Constant(kNumLegJoints, 30.0));
  const JointCommand command = stage.tick(failing(&SensorHealth::imu, 0.02));
  EXPECT_EQ(command.mode, CommandMode::optimal);
  EXPECT_EQ(command.torque, JointVector::Constant(kNumLegJoints, 10.0 + kMostChange));
  for (int i = 2; i <= 5; ++i) {
    EXPECT_EQ(stage.tick().torque, JointVector::Constant(kNumLegJoints, 10.0 + i * kMostChange))
        << "catches up";
  }
  stage.solve(JointVector::Constant(kNumLegJoints, -10.0));
  EXPECT_EQ(stage.tick().torque, JointVector::Constant(kNumLegJoints, -10.0));
  EXPECT_EQ(stage.tick().cause, StopCause::none);
}

TEST(SafetyOfSensors, WithoutImuOrTorquesItSitsDownSlowlyAndThenDamps) {
  for (const auto& [group, cause] :
       {std::pair(&SensorHealth::imu, StopCause::imu),
        std::pair(&SensorHealth::joint_torques, StopCause::joint_torques)}) {
    Stage stage;
    JointVector before = stage.tick().torque;
    ASSERT_EQ(stage.tick(failing(group, 0.021)).mode, CommandMode::sit);
    for (int i = 0; i < kSits - 1; ++i) {
      const JointCommand& command = stage.tick();
      ASSERT_EQ(command.mode, CommandMode::sit) << "latched";
      ASSERT_EQ(command.cause, cause);
      ASSERT_LE((command.torque - before).cwiseAbs().maxCoeff(), 0.5);
      before = command.torque;
    }
    const JointVector away = lying() - stage.state.q;
    EXPECT_GT(before.dot(away), 0.0) << "towards the lying posture alone";
    EXPECT_LT((before - before.dot(away) / away.dot(away) * away).norm(), 0.01);
    EXPECT_LT(before.cwiseAbs().maxCoeff(), 8.0) << "softly";
    EXPECT_EQ(stage.tick().mode, CommandMode::damping);
    EXPECT_EQ(stage.tick().cause, cause);
  }
}

TEST(SafetyOfSensors, WithoutEncodersOfOneLegTheOtherJointsSitDown) {
  Stage stage;
  JointVector before = stage.tick().torque;
  stage.state.q[2] = stage.state.qd[2] = kNaN;
  SensorHealth health = failing(&SensorHealth::encoders, 0.03);
  health.encoders.joint = 2;
  for (int i = 0; i < kSits - 1; ++i) {
    const JointCommand& command = stage.tick(health);
    ASSERT_EQ(command.mode, CommandMode::sit);
    ASSERT_EQ(command.cause, StopCause::encoders);
    ASSERT_EQ(command.joint, 2);
    ASSERT_EQ(i < kSits / 2 ? command.torque[2] : 10.0, 10.0) << "what it bore";
    ASSERT_LE((command.torque - before).cwiseAbs().maxCoeff(), 0.5);
    before = command.torque;
  }
  EXPECT_NEAR(before[2], 0.0, 0.01) << "fades at last";
  EXPECT_GT(std::abs(before[1]), 1.0) << "its leg goes down with the others";
  (void)stage.tick(health);
  EXPECT_EQ(stage.tick(health).mode, CommandMode::damping);
}

TEST(SafetyOfSensors, SittingDownEndsWithoutAClockToo) {
  Stage stage, other;
  for (Stage* one : {&stage, &other}) {
    (void)one->tick();
    (void)one->tick(failing(&SensorHealth::imu, 0.03));
  }
  for (int i = 0; i < kSits - 1; ++i) {
    stage.state.time = kNaN;
    const JointCommand& command = stage.safety.command(stage.state, nullptr, {});
    ASSERT_EQ(command.mode, CommandMode::sit);
    ASSERT_LT((command.torque - other.tick().torque).norm(), 1e-6) << "as with one";
  }
  for (int i = 0; i < 2; ++i) (void)stage.safety.command(stage.state, nullptr, {});
  EXPECT_EQ(stage.safety.command(stage.state, nullptr, {}).mode, CommandMode::damping);
}

// What a sensor that lied led to is good for little, and the posture changes.
TEST(SafetyOfSensors, TheLastTorquesTurnIntoThoseThatBearTheRobotAndFadeAsItLies) {
  constexpr int kBears = 160;  // [ticks]
  const JointVector bearing = JointVector::LinSpaced(kNumLegJoints, 5.0, -6.0);
  Stage told(1), untold(1);
  double most_at_first = 0.0;
  JointVector borne = JointVector::Zero(kNumLegJoints), last = borne;
  for (int i = 0; i < kSits - 1; ++i) {
    told.safety.bear(bearing);
    const JointVector torque = told.tick(failing(&SensorHealth::imu, 0.03)).torque;
    const JointVector other = untold.tick(failing(&SensorHealth::imu, 0.03)).torque;
    const JointVector more = torque - other;  // both go the same way
    most_at_first = i < 5 ? std::max(most_at_first, more.norm()) : most_at_first;
    if (i == kBears) borne = more;
    last = more;
  }
  EXPECT_LT(most_at_first, 0.1);
  EXPECT_LT((borne - (bearing - JointVector::Constant(kNumLegJoints, 10.0))).norm(), 0.1);
  EXPECT_LT(last.norm(), 0.01);
}

// As of a lame leg's robot, of which nobody knows.
TEST(SafetyOfSensors, WhatBearsTheRobotIsTakenOverSlowlyHoweverLateItIsTold) {
  Stage told(1), untold(1);
  double most = 0.0;
  JointVector before = JointVector::Zero(kNumLegJoints), more = before;
  for (int i = 0; i < 260; ++i) {
    told.safety.bear(i < 80 ? JointVector::Constant(kNumLegJoints, kNaN)
                            : JointVector::Constant(kNumLegJoints, 5.0));
    more = told.tick(failing(&SensorHealth::imu, 0.03)).torque -
           untold.tick(failing(&SensorHealth::imu, 0.03)).torque;
    most = std::max(most, (more - before).cwiseAbs().maxCoeff());
    before = more;
  }
  EXPECT_LT(most, 0.12);
  EXPECT_GT(most, 0.01);
  EXPECT_LT((more + JointVector::Constant(kNumLegJoints, 5.0)).norm(), 0.1);
}

TEST(SafetyOfSensors, WhatBoreTheRobotBeforeItWalkedDoesNotCountAfterIt) {
  Stage told, untold;
  told.safety.bear(JointVector::Constant(kNumLegJoints, 5.0));
  for (Stage* stage : {&told, &untold}) (void)stage->tick();
  for (int i = 0; i < kSits; ++i) {
    const JointVector torque = told.tick(failing(&SensorHealth::imu, 0.03)).torque;
    ASSERT_EQ(torque, untold.tick(failing(&SensorHealth::imu, 0.03)).torque) << i;
  }
}

// Behind late drives a leg in the air would swing under a spring that bears a quarter of the robot.
TEST(SafetyOfSensors, ALegThatDoesNotStandIsHeldSoftly) {
  Stage all, one;
  for (const CommandMode mode : {CommandMode::hold, CommandMode::sit}) {
    for (Stage* stage : {&all, &one}) {
      stage->state.q = anymal_b().q_nominal;
      stage->state.qd.setZero();
      stage->safety.set_standing({true, stage == &all, true, true});
      (void)stage->tick();
      stage->safety.set_standing({true, true, true, true});  // planned meanwhile
      stage->state.q.array() += 0.02;
      stage->state.qd.setConstant(0.02);
    }
    const SensorHealth health =
        mode == CommandMode::hold ? SensorHealth{} : failing(&SensorHealth::imu, 0.03);
    const JointCommand &hard = all.refused_tick(health), &soft = one.refused_tick(health);
    ASSERT_EQ(hard.mode, mode);
    for (int i = 0; i < kNumLegJoints; ++i) {
      const double share = (10.0 - soft.torque[i]) / (10.0 - hard.torque[i]);
      if (i < 3 || i >= 6) {
        EXPECT_EQ(share, 1.0) << i;
      } else {
        EXPECT_LT(share, 0.5) << i;
        EXPECT_GT(share, 0.1) << i;
      }
    }
  }
}

TEST(SafetyOfSensors, AnEncoderThatIsFrozenCountsAsUnknownHoweverFiniteItsAngle) {
  Stage stage(1);
  SensorHealth health = failing(&SensorHealth::encoders, 0.03);
  health.encoders = {.fault = SampleFault::repeats, .age = 0.03, .joint = 4};
  ASSERT_EQ(stage.tick(health).mode, CommandMode::sit);
  for (int i = 0; i < 400; ++i) ASSERT_EQ(stage.tick().torque[4], 10.0);
}

TEST(SafetyOfSensors, ByAnglesThatOnlyComeLateItSitsDown) {
  Stage stage(1);
  SensorHealth health = failing(&SensorHealth::encoders, 0.03);
  health.encoders.fault = SampleFault::late;
  EXPECT_EQ(stage.tick(health).mode, CommandMode::sit);
  EXPECT_EQ(stage.tick(health).cause, StopCause::encoders);
}

TEST(SafetyOfSensors, EncodersOfSeveralLegsThatAreLostFadeTheTorques) {
  Stage stage(1);
  stage.state.q[2] = stage.state.qd[2] = kNaN;
  stage.state.q[5] = stage.state.qd[5] = kNaN;
  const JointCommand first = stage.tick(failing(&SensorHealth::encoders, 0.03));
  EXPECT_EQ(first.mode, CommandMode::damping);
  EXPECT_EQ(first.cause, StopCause::encoders);
  EXPECT_NEAR(first.torque[2], 10.0, 0.1);
  for (int i = 0; i < 100; ++i) (void)stage.tick();
  EXPECT_NEAR(stage.tick().torque[2], 5.0, 0.1);
  for (int i = 0; i < 200; ++i) (void)stage.tick();
  EXPECT_EQ(stage.tick().torque, JointVector::Zero(kNumLegJoints));
}

TEST(SafetyOfSensors, WhatWasWrongWhenItStoppedStaysTheReason) {
  Stage stage(1);
  EXPECT_EQ(stage.tick().fault, SampleFault::none);
  SensorHealth health = failing(&SensorHealth::encoders, 0.03);
  health.encoders.fault = SampleFault::jump;
  health.encoders.joint = 5;
  (void)stage.tick(health);
  health.encoders.fault = SampleFault::out_of_range;
  health.encoders.joint = -1;
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(stage.tick(i < 50 ? health : SensorHealth()).fault, SampleFault::jump);
    ASSERT_EQ(stage.tick(health).joint, 5);
  }
}

TEST(SafetyOfSensors, ASittingRobotThatTiltsOrLosesItsEncodersDamps) {
  Stage tilts, loses;
  for (Stage* stage : {&tilts, &loses}) {
    (void)stage->tick();
    ASSERT_EQ(stage->tick(failing(&SensorHealth::joint_torques, 0.1)).mode, CommandMode::sit);
  }
  tilts.state.q_WB = from_roll_pitch_yaw({1.2, 0.0, 0.0});
  EXPECT_EQ(tilts.tick().mode, CommandMode::damping);
  EXPECT_EQ(loses.tick(failing(&SensorHealth::encoders, 0.03)).mode, CommandMode::damping);
  EXPECT_EQ(loses.tick().cause, StopCause::joint_torques) << "what came first";
}

TEST(SafetyOfSensors, TorquesOfTheWayDownFadeWhereEncodersAreLostLater) {
  for (const double seconds : {0.1, 1.0}) {
    Stage stage(1);
    const auto until = static_cast<int>(seconds / kPeriod);
    for (int i = 0; i < until; ++i) (void)stage.tick(failing(&SensorHealth::imu, 0.1));
    const JointVector before = stage.tick(failing(&SensorHealth::imu, 0.1)).torque;
    ASSERT_GT(before.norm(), 10.0);
    const SensorHealth lost = failing(&SensorHealth::encoders, 0.03);
    for (int i = 0; i < 200; ++i) {
      const JointCommand& command = stage.tick(lost);
      ASSERT_EQ(command.mode, CommandMode::damping);
      EXPECT_LT((command.torque - (1.0 - i / 200.0) * before).norm(), 1e-9) << seconds << ", " << i;
    }
    EXPECT_LT(stage.tick(lost).torque.norm(), 1e-9);
  }
}

TEST(SafetyOfSensors, ARobotThatTiltsWhileItSitsForAnEncoderOnlyDamps) {
  Stage stage(1);
  SensorHealth one = failing(&SensorHealth::encoders, 0.03);
  one.encoders.joint = 2;
  one.encoders.fault = SampleFault::not_a_number;
  ASSERT_EQ(stage.tick(one).mode, CommandMode::sit);
  stage.state.q_WB = from_roll_pitch_yaw({1.2, 0.0, 0.0});
  for (int i = 0; i < 20; ++i) ASSERT_EQ(stage.tick(one).mode, CommandMode::damping);
  EXPECT_LT(stage.tick(one).torque.norm(), 1e-9) << "a robot at rest";
}

TEST(SafetyOfSensors, ARobotThatSitsDownForItsImuDoesNotBelieveThatItTilts) {
  Stage stage(1);
  for (int i = 0; i < kSits; ++i) {
    if (i > 0) stage.state.q_WB = from_roll_pitch_yaw({1.2, 0.0, 0.0});
    ASSERT_EQ(stage.tick(failing(&SensorHealth::imu, 0.1)).mode, CommandMode::sit) << i;
  }
  EXPECT_EQ(stage.tick().mode, CommandMode::damping);
}

TEST(SafetyOfSensors, ASensorThatTheRobotDoesNotHaveIsNotMissed) {
  Stage stage;
  const SensorHealth health{.encoders = {.age = 0.0}, .joint_torques = {}, .imu = {}};
  for (int i = 0; i < 100; ++i) EXPECT_EQ(stage.tick(health).mode, CommandMode::optimal);
}

TEST(SafetyOfSensors, OneThatNeverCameIsNamedAndSatDownFor) {
  for (const StopCause missing : {StopCause::imu, StopCause::joint_torques}) {
    Stage stage;
    if (missing == StopCause::imu) stage.state.q_WB.coeffs().setConstant(kNaN);
    if (missing == StopCause::joint_torques) stage.state.torque.setConstant(kNaN);
    SensorHealth health = failing(&SensorHealth::imu, kNaN);
    health.joint_torques = health.imu;
    JointVector held(kNumLegJoints);
    for (int i = 0; i < SafetyOptions{}.damp_after_failures; ++i) {
      stage.state.q = anymal_b().q_nominal + JointVector::Constant(kNumLegJoints, 2e-4 * i);
      const JointCommand& command = stage.refused_tick(health);
      ASSERT_EQ(command.mode, CommandMode::hold) << "it may come late";
      held = command.torque;
    }
    EXPECT_GT(held.norm(), 1.0) << "by what the encoders say";
    EXPECT_EQ(stage.refused_tick(health).mode, CommandMode::sit);
    const JointCommand& command = stage.refused_tick(health);
    EXPECT_EQ(command.cause, missing);
    EXPECT_EQ(command.fault, SampleFault::silent);
    EXPECT_LT((command.torque - held).norm(), 0.1) << "goes on from what was held";
  }
}

TEST(SafetyOfSensors, AnEncoderThatNeverCameIsNamedAndTheOtherJointsDamp) {
  Stage stage;
  stage.state.q[5] = kNaN;
  stage.state.qd.setConstant(1.0);
  SensorHealth health = failing(&SensorHealth::encoders, 0.0);
  health.encoders.joint = 5;
  while (stage.ticks <= SafetyOptions{}.damp_after_failures) (void)stage.refused_tick(health);
  const JointCommand& command = stage.refused_tick(health);
  EXPECT_EQ(command.mode, CommandMode::damping);
  EXPECT_EQ(command.cause, StopCause::encoders);
  EXPECT_EQ(command.joint, 5);
  EXPECT_LT(command.torque[0], 0.0);
}

TEST(SafetyOfSensors, WithoutAStateForAnotherReasonNoSensorIsNamed) {
  Stage stage;
  stage.state.q_WB.coeffs().setConstant(kNaN);
  for (int i = 0; i < 100; ++i) (void)stage.refused_tick({});
  EXPECT_EQ(stage.refused_tick({}).mode, CommandMode::hold) << "it may still come to stand";
  (void)stage.refused_tick(failing(&SensorHealth::imu, 0.005));
  EXPECT_EQ(stage.refused_tick({}).mode, CommandMode::hold)
      << "a sample that is doubted is bridged";
  for (int i = 100; i < 800; ++i) (void)stage.refused_tick({});
  EXPECT_EQ(stage.refused_tick({}).mode, CommandMode::damping);
  EXPECT_EQ(stage.refused_tick({}).cause, StopCause::failures);
}

TEST(SafetyOfSensors, WhateverFailsTorquesAreFiniteInTheirLimitsAndDoNotJump) {
  RandomMatrices random(4);
  constexpr std::array kGroups{&SensorHealth::encoders, &SensorHealth::joint_torques,
                               &SensorHealth::imu};
  for (int run = 0; run < 60; ++run) {
    Stage stage;
    JointVector before = stage.tick().torque;
    const auto group = kGroups[static_cast<std::size_t>(random.integer(0, 2))];
    const int length = random.integer(1, 40);
    for (int i = 1; i < kSits + 500; ++i) {
      stage.solve(60.0 * random.vector(kNumLegJoints));
      stage.safety.bear(20.0 * random.vector(kNumLegJoints));
      stage.safety.set_standing({random.chance(0.5), random.chance(0.5), true, true});
      stage.state.q = anymal_b().q_nominal + 0.3 * random.vector(kNumLegJoints);
      stage.state.qd = 3.0 * random.vector(kNumLegJoints);
      const double lost = run % 2 == 0 ? 0.02 : 0.0;
      if (random.chance(lost)) stage.state.q[random.integer(0, 11)] = kNaN;
      if (random.chance(lost)) stage.state.qd[random.integer(0, 11)] = kNaN;
      const bool fails = i <= length;
      const JointCommand& command = fails ? stage.tick(failing(group, i * kPeriod)) : stage.tick();
      ASSERT_TRUE(command.torque.allFinite());
      ASSERT_LE(command.torque.cwiseAbs().maxCoeff(), kLimit);
      const double most = fails || length > 8 ? kMostChange + 1e-9 : 2.0 * kLimit;
      ASSERT_LE((command.torque - before).cwiseAbs().maxCoeff(), most);
      before = command.torque;
    }
  }
}

}  // namespace
}  // namespace surefoot::control
