#include "surefoot/estimation/torque_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kPeriod = 0.0025;
constexpr double kMass = 30.0;
constexpr double kLever = 0.05;  // so short that no torque is off by what drives are not [m]
const Vec3 kUp = Vec3::UnitZ();
const TorqueCheckOptions kOptions;

/// A lump of the robot's mass at rest on four feet; tests make its torques wrong.
struct Lump {
  Lump() {
    dynamics.mass = kMass;
    state.foot_force.fill(0.25 * kMass * kGravity * Vec3::UnitZ());
    for (const Leg leg : kLegs) {
      model::PointKinematics& contact = dynamics.contact[index(leg)];
      contact.p = {is_front(leg) ? 0.3 : -0.3, is_left(leg) ? 0.2 : -0.2, 0.0};
      contact.J.middleCols<kJointsPerLeg>(6 + first_joint(leg)) = kLever * Mat3::Identity();
    }
    run(0.5);
  }
  void tick() {
    state.time = kPeriod * ++ticks;
    state.torque = command + error;
    const bool moves_exactly = ticks % encoder_ticks == 0;
    check.update(state, dynamics, {true, true, true, true}, command, moves_exactly);
  }
  void run(double duration) {
    for (int i = 0; i < std::lround(duration / kPeriod); ++i) tick();
  }
  /// A force on a foot, real or only claimed by torques that were not commanded.
  void push(Leg leg, const Vec3& force, bool is_real) {
    state.foot_force[index(leg)] += force;
    if (!is_real) error.segment<kJointsPerLeg>(first_joint(leg)) -= kLever * force;
  }

  TorqueCheck check{kOptions, kPeriod};
  model::Dynamics dynamics;
  RobotState state;
  JointVector command = JointVector::LinSpaced(kNumLegJoints, -30.0, 30.0),
              error = JointVector::Zero(kNumLegJoints);
  int encoder_ticks = 1;  // between two samples
  int ticks = 0;
};

TEST(TorqueCheck, AJointThatIsOffForLongIsFoundAndNamed) {
  for (int joint = 0; joint < kNumLegJoints; ++joint) {
    Lump robot;
    robot.error[joint] = joint % 2 == 0 ? 20.0 : -20.0;
    robot.run(kOptions.duration);
    EXPECT_EQ(robot.check.wrong_for(), 0.0) << "not yet";
    EXPECT_EQ(robot.check.joint(), -1);
    robot.run(0.05);
    EXPECT_GT(robot.check.wrong_for(), kOptions.duration);
    EXPECT_EQ(robot.check.joint(), joint);
    robot.error.setZero();
    robot.run(0.1);
    EXPECT_EQ(robot.check.wrong_for(), 0.0) << "it is over";
  }
}

TEST(TorqueCheck, JointsMayBeOffByWhatDrivesAreOffBy) {
  for (const double share : {-0.99, 0.99, -1.01, 1.01}) {
    Lump robot;
    robot.error.setConstant(share * kOptions.max_error);
    robot.run(2.0);
    EXPECT_EQ(robot.check.wrong_for() > 0.0, std::abs(share) > 1.0) << share;
    EXPECT_EQ(robot.check.joint(), -1) << "none, or several";
  }
}

TEST(TorqueCheck, JointsMayBeOffForAsLongAsADriveIsAtItsLimit) {
  Lump robot;
  for (int i = 0; i < 10; ++i) {
    robot.error.setConstant(30.0);
    robot.run(0.6 * kOptions.duration);
    ASSERT_EQ(robot.check.wrong_for(), 0.0) << i;
    robot.error.setZero();
    robot.run(0.6 * kOptions.duration);
  }
}

/// An error that is beyond the limit at every tick.
TEST(TorqueCheck, WhatIsOffToEitherSideInTurnIsNotOffToOneSide) {
  Lump robot;
  for (int i = 0; i < 10; ++i) {
    robot.error.setConstant(i % 2 == 0 ? 300.0 : -300.0);
    robot.run(0.6 * kOptions.duration);
    ASSERT_EQ(robot.check.wrong_for(), 0.0) << i;
  }
}

TEST(TorqueCheck, ForcesAndMomentsThatNothingLoadsARobotWithAreFoundWhereTorquesWereNotCommanded) {
  for (const double share : {0.9, 1.1}) {
    Lump pushed, turned;
    for (const Leg leg : kLegs) {
      pushed.push(leg, share * kOptions.max_force / kNumLegs * Vec3(0.6, 0.0, 0.8), false);
      const double each = share * kOptions.max_moment / (kNumLegs * 0.3);
      turned.push(leg, (is_front(leg) ? each : -each) * kUp, false);
    }
    for (Lump* robot : {&pushed, &turned}) {
      robot->run(1.0);
      EXPECT_EQ(robot->check.wrong_for() > 0.0, share > 1.0) << share;
      EXPECT_EQ(robot->check.joint(), -1);
      const double before = robot->check.wrong_for();
      robot->run(0.2);
      EXPECT_NEAR(robot->check.wrong_for(), share > 1.0 ? before + 0.2 : 0.0, 1e-9) << "goes on";
    }
  }
}

// A robot that falls, or lies on its belly.
TEST(TorqueCheck, WhatTheCommandedTorquesClaimAsWellIsNoFault) {
  for (const double share : {1.1, 5.0}) {
    Lump pushed, turned;
    for (const Leg leg : kLegs) {
      pushed.push(leg, 0.25 * share * kOptions.max_force * kUp, true);
      const double each = share * kOptions.max_moment / (kNumLegs * 0.3);
      turned.push(leg, (is_front(leg) ? each : -each) * kUp, true);
    }
    pushed.run(1.0);
    turned.run(1.0);
    EXPECT_EQ(pushed.check.wrong_for(), 0.0) << share;
    EXPECT_EQ(turned.check.wrong_for(), 0.0) << share;
  }
}

TEST(TorqueCheck, EncodersThatAreCoarserThanTheLoopSayNothingOfForces) {
  Lump robot;
  robot.encoder_ticks = 2;
  for (const Leg leg : kLegs) robot.push(leg, 0.28 * kOptions.max_force * kUp, false);
  robot.run(2.0);
  EXPECT_EQ(robot.check.wrong_for(), 0.0);
  robot.encoder_ticks = 1;
  robot.run(0.2);
  EXPECT_GT(robot.check.wrong_for(), 0.0);
}

TEST(TorqueCheck, WhatIsForgottenBeginsAnew) {
  Lump robot;
  robot.error[3] = 20.0;
  robot.run(0.9 * kOptions.duration);
  robot.check.forget();
  robot.run(0.9 * kOptions.duration);
  EXPECT_EQ(robot.check.wrong_for(), 0.0);
  robot.run(0.2 * kOptions.duration);
  EXPECT_GT(robot.check.wrong_for(), 0.0);
  robot.check.forget();
  EXPECT_EQ(robot.check.wrong_for(), 0.0);
  EXPECT_EQ(robot.check.joint(), -1);
}

TEST(TorqueCheck, NumbersThatAreNoneAreNoFaultAndDoNotStay) {
  Lump robot;
  const Vec3 force = robot.state.foot_force[0];
  robot.error[5] = kNaN;
  robot.state.foot_force[0].setConstant(kNaN);
  robot.run(1.0);
  EXPECT_EQ(robot.check.wrong_for(), 0.0);
  robot.error.setZero();
  robot.state.foot_force[0] = force;
  robot.run(1.0);
  EXPECT_EQ(robot.check.wrong_for(), 0.0);
  robot.error[5] = 20.0;
  robot.run(0.3);
  EXPECT_EQ(robot.check.joint(), 5);
}

}  // namespace
}  // namespace surefoot::estimation
