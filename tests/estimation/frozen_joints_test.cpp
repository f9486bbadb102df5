#include "surefoot/estimation/frozen_joints.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/model/robot_model.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surefoot::estimation {
namespace {

using test::Random;

constexpr double kPeriod = 0.0025;
constexpr double kQuantum = 4.4e-4;  // of the encoders [rad]

double rounded(double angle) { return kQuantum * std::round(angle / kQuantum); }

/// A robot whose base moves as given over feet that stand, read with coarse encoders.
struct Standing {
  Standing() {
    state.q_WB = Quat::Identity();
    state.p_WB.setZero();
    state.w_WB_B.setZero();
    state.v_WB.setZero();
    state.qd.setZero();
    state.q = test::anymal_b().q_nominal;
    state.torque.setZero();
    v_WF.fill(Vec3::Zero());
    tick();
  }
  /// As joints of feet that stand move.
  [[nodiscard]] JointVector joint_velocity(const model::Dynamics& dynamics) const {
    JointVector result = JointVector::Zero(kNumLegJoints);
    for (const Leg leg : kLegs) {
      const model::PointKinematics& foot = dynamics.contact[index(leg)];
      const Mat3 J = foot.J.block<3, 3>(0, 6 + first_joint(leg));
      result.segment<3>(first_joint(leg)) =
          J.inverse() * -(foot.J.leftCols<6>() * state.u().head<6>());
    }
    return result;
  }
  void tick() {
    state.time = reading.time = reading.encoder_time = reading.torque_time = kPeriod * ++ticks;
    const model::Dynamics& dynamics = model.update(state, Vec3::UnitZ());
    state.qd = joint_velocity(dynamics);
    state.q += kPeriod * state.qd;
    for (int i = 0; i < kNumLegJoints; ++i) {
      if (i != frozen_encoder) reading.q[i] = rounded(state.q[i]);
      if (i != frozen_torque) reading.torque[i] = command[i] + random.uniform(-0.2, 0.2);
    }
    watch.update(reading, model.update(state, Vec3::UnitZ()), stands, v_WF, command);
  }
  void run(double duration) {
    for (int i = 0; i < std::lround(duration / kPeriod); ++i) tick();
  }

  model::RobotModel model{test::anymal_b()};
  FrozenJoints watch{FrozenJointOptions{}, kPeriod};
  Random random{5};
  RobotState state;
  SensorReading reading;
  PerLeg<bool> stands{true, true, true, true};
  PerLeg<Vec3> v_WF{};  // of feet in the air, as planned
  JointVector command = JointVector::Constant(kNumLegJoints, 10.0);
  int frozen_encoder = -1, frozen_torque = -1, ticks = 0;
};

TEST(FrozenJoints, AtRestAnEncoderMayGiveTheSameNumberForLong) {
  Standing robot;
  robot.run(5.0);
  EXPECT_EQ(robot.watch.encoders().count, 0);
  EXPECT_EQ(robot.watch.torques().count, 0);
}

TEST(FrozenJoints, AtRestABaseVelocityThatIsBelievedWronglyFreezesNothing) {
  Standing robot;
  SensorReading still = robot.reading;
  robot.state.v_WB = {0.001, 0.001, 0.0};
  robot.state.w_WB_B = {0.0, 0.0, 0.002};
  FrozenJoints watch{FrozenJointOptions{}, kPeriod};
  for (int i = 0; i < 60.0 / kPeriod; ++i) {
    still.time = still.encoder_time = still.torque_time = kPeriod * (i + 1);
    watch.update(still, robot.model.update(robot.state, Vec3::UnitZ()), robot.stands, robot.v_WF,
                 robot.command);
    ASSERT_EQ(watch.encoders().count, 0) << i;
  }
}

TEST(FrozenJoints, OfSeveralThatAreFrozenNoneIsTheOnlyOne) {
  Standing robot;
  const JointVector stuck = robot.reading.q;
  robot.state.v_WB = {0.1, 0.1, 0.0};
  int most = 0;
  for (int i = 0; i < 400; ++i) {
    robot.tick();
    robot.reading.q = stuck;
  }
  FrozenJoints watch{FrozenJointOptions{}, kPeriod};
  for (int i = 0; i < 400 && most == 0; ++i) {
    robot.reading.time = robot.reading.encoder_time = kPeriod * (i + 1);
    watch.update(robot.reading, robot.model.dynamics(), robot.stands, robot.v_WF, robot.command);
    most = std::max(most, watch.encoders().count);
  }
  EXPECT_GT(most, 1);
  EXPECT_EQ(watch.encoders().joint, -1);
}

TEST(FrozenJoints, AJointAtItsStopIsNotFrozen) {
  for (const bool is_at_stop : {false, true}) {
    Standing robot;
    robot.state.v_WB = {0.1, 0.1, 0.0};
    robot.run(0.1);
    robot.frozen_encoder = 5;
    JointStops stops;
    if (is_at_stop) stops.max[5] = robot.reading.q[5] + 0.005;
    robot.watch = FrozenJoints(FrozenJointOptions{}, kPeriod, stops);
    robot.run(2.0);
    EXPECT_EQ(robot.watch.encoders().joint, is_at_stop ? -1 : 5);
  }
}

TEST(FrozenJoints, AnEncoderThatMovesIsNotFrozenHoweverSlowly) {
  Standing robot;
  robot.state.v_WB = {0.002, 0.001, -0.001};
  for (int i = 0; i < 1000; ++i) {
    robot.tick();
    ASSERT_EQ(robot.watch.encoders().count, 0) << i;
  }
}

TEST(FrozenJoints, AnEncoderOfAStandingLegThatStaysWhileTheBaseMovesIsFound) {
  for (int joint = 0; joint < kNumLegJoints; ++joint) {
    Standing robot;
    robot.state.v_WB = {0.1, 0.1, 0.0};
    robot.run(0.1);
    robot.frozen_encoder = joint;
    robot.run(1.0);
    EXPECT_EQ(robot.watch.encoders().joint, joint);
    EXPECT_NEAR(robot.watch.encoders().age, 1.05, 0.06);
  }
}

TEST(FrozenJoints, AnEncoderOfALegInTheAirThatStaysWhileItShouldSwingIsFound) {
  Standing robot;
  const Leg leg = Leg::RF;
  robot.stands[index(leg)] = false;
  robot.v_WF[index(leg)] = {1.0, 0.0, 0.5};
  robot.run(0.2);
  EXPECT_GT(robot.watch.encoders().count, 0) << "its joints are read as those of a leg that stands";
}

TEST(FrozenJoints, ASlowEncoderIsNotFrozenBetweenItsSamples) {
  Standing robot;
  robot.state.v_WB = {0.5, 0.3, 0.0};
  SensorReading held = robot.reading;
  FrozenJoints watch{FrozenJointOptions{}, kPeriod};
  for (int i = 0; i < 400; ++i) {
    robot.tick();
    if (i % 40 == 0) held = robot.reading;
    watch.update(held, robot.model.dynamics(), robot.stands, robot.v_WF, robot.command);
    ASSERT_EQ(watch.encoders().count, 0) << i;
  }
}

TEST(FrozenJoints, ATorqueThatStaysWhileItsCommandChangesIsFound) {
  for (int joint = 0; joint < kNumLegJoints; ++joint) {
    Standing robot;
    robot.run(0.1);
    robot.frozen_torque = joint;
    robot.run(1.0);
    EXPECT_EQ(robot.watch.torques().count, 0) << "nothing else was asked for";
    robot.command.setConstant(18.0);
    robot.run(0.1);
    EXPECT_EQ(robot.watch.torques().joint, joint);
    robot.frozen_torque = -1;
    robot.tick();
    EXPECT_EQ(robot.watch.torques().count, 0);
  }
}

TEST(FrozenJoints, NumbersThatAreNoneFreezeNothing) {
  Standing robot;
  FrozenJoints watch({}, kPeriod);
  robot.state.v_WB = {0.1, 0.1, 0.0};
  for (int i = 0; i < 400; ++i) {
    robot.tick();
    SensorReading reading = robot.reading;
    reading.q.setConstant(kNaN);
    reading.torque.setConstant(kNaN);
    watch.update(reading, robot.model.dynamics(), robot.stands, robot.v_WF,
                 JointVector::Constant(kNumLegJoints, i));
    ASSERT_EQ(watch.encoders().count, 0);
    ASSERT_EQ(watch.torques().count, 0);
  }
}

}  // namespace
}  // namespace surefoot::estimation
