#include "surefoot/estimation/sensor_consistency.hpp"

#include "surefoot/model/leg_jacobian.hpp"
#include "surefoot/model/robot_model.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::estimation {
namespace {

using test::Random;

constexpr double kPeriod = 0.0025;

/// A robot that stands on four feet, whose sensors a test makes wrong.
struct Standing {
  explicit Standing(double duration = 0.0, const SensorConsistencyOptions& options = {})
      : consistency(options, kPeriod) {
    state.p_WB = {0.0, 0.0, 0.46};
    state.q_WB = Quat::Identity();
    state.v_WB.setZero();
    state.w_WB_B.setZero();
    state.q = test::anymal_b().q_nominal;
    state.qd.setZero();
    state.foot_force.fill({0.0, 0.0, 0.25 * model.mass() * kGravity});
    v_WF.fill(Vec3::Zero());
    run(duration);
  }
  void tick() {
    state.time = reading.time = kPeriod * ++ticks;
    reading.encoder_time = reading.torque_time = reading.imu_time = reading.time;
    reading.q = state.q;
    if (!torques_stay) {
      for (double& torque : reading.torque) torque = 10.0 + random.uniform(-0.2, 0.2);
      reading.torque += torque_error;
    }
    reading.gyro = random.vector(1e-3);
    reading.accelerometer = kGravity * Vec3::UnitZ() + random.vector(0.02) + accelerometer_error;
    state.torque = reading.torque;
    const model::Dynamics& dynamics = model.update(state, Vec3::UnitZ());
    health = {.encoders = {.age = 0.0}, .joint_torques = {.age = 0.0}, .imu = {.age = 0.0}};
    if (is_imu_late) health.imu = {.fault = SampleFault::late, .age = 0.01};
    if (are_encoders_late) health.encoders = {.fault = SampleFault::late, .age = 0.01};
    if (torques_are_none) health.joint_torques = {.fault = SampleFault::not_a_number, .age = 0.01};
    consistency.update(reading, reading,
                       {.state = state,
                        .dynamics = dynamics,
                        .stands = stands,
                        .v_WF = v_WF,
                        .normal_W = Vec3::UnitZ(),
                        .command = JointVector::Constant(kNumLegJoints, command)},
                       health);
  }
  void run(double duration) {
    for (int i = 0; i < std::lround(duration / kPeriod); ++i) tick();
  }
  [[nodiscard]] bool is_well() const {
    return health.encoders.fault == SampleFault::none &&
           health.joint_torques.fault == SampleFault::none && health.imu.fault == SampleFault::none;
  }

  model::RobotModel model{test::anymal_b()};
  SensorConsistency consistency;
  Random random{3};
  RobotState state;
  SensorReading reading;
  SensorHealth health;
  PerLeg<bool> stands{true, true, true, true};
  PerLeg<Vec3> v_WF{};
  Vec3 accelerometer_error = Vec3::Zero();
  JointVector torque_error = JointVector::Zero(kNumLegJoints);
  double command = 10.0;  // [N·m]
  bool is_imu_late = false, are_encoders_late = false, torques_are_none = false;
  bool torques_stay = false;
  int ticks = 0;
};

TEST(SensorConsistency, SensorsThatFitEachOtherAreWell) {
  Standing robot;
  for (int i = 0; i < 2000; ++i) {
    robot.tick();
    ASSERT_TRUE(robot.is_well()) << i;
  }
}

TEST(SensorConsistency, AnAccelerometerThatDoesNotFitTheFeetIsALostImu) {
  Standing robot(0.5);
  robot.accelerometer_error = {0.0, 3.0, 0.0};
  robot.run(0.2);
  EXPECT_EQ(robot.health.imu.fault, SampleFault::contradicts);
  EXPECT_GT(robot.health.imu.age, 0.02) << "beyond what is bridged";
  EXPECT_EQ(robot.health.imu.joint, -1);
}

TEST(SensorConsistency, TorquesThatWereNotCommandedAreFoundAndTheOnlyJointIsNamed) {
  for (int joint = 0; joint < kNumLegJoints; ++joint) {
    Standing robot(0.5);
    robot.torque_error[joint] = joint % 2 == 0 ? 20.0 : -20.0;
    robot.run(0.3);
    EXPECT_EQ(robot.health.joint_torques.fault, SampleFault::contradicts);
    EXPECT_EQ(robot.health.joint_torques.joint, joint);
    EXPECT_GT(robot.health.joint_torques.age, 0.02);
  }
  Standing robot;
  robot.torque_error.setConstant(20.0);
  robot.run(0.3);
  EXPECT_EQ(robot.health.joint_torques.joint, -1) << "several";
}

TEST(SensorConsistency, FeetThatCarryMoreThanAnythingCanLoadAreAFaultOfTheTorques) {
  Standing robot(0.1);
  const Vec3 force(0.0, 0.0, 200.0);
  for (const Leg leg : kLegs) {
    const Mat3 J = model::leg_jacobian(robot.model.dynamics().contact[index(leg)], leg);
    robot.state.foot_force[index(leg)] += force;
    robot.torque_error.segment<kJointsPerLeg>(first_joint(leg)) -= J.transpose() * force;
  }
  robot.run(0.2);
  EXPECT_EQ(robot.health.joint_torques.fault, SampleFault::contradicts);
  EXPECT_EQ(robot.health.joint_torques.joint, -1);
  EXPECT_GT(robot.health.joint_torques.age, 0.02) << "beyond what is bridged";
}

TEST(SensorConsistency, WhatTheGuardFoundStays) {
  Standing robot(0.5);
  robot.accelerometer_error = {0.0, 3.0, 0.0};
  robot.is_imu_late = true;
  robot.run(0.2);
  EXPECT_EQ(robot.health.imu.fault, SampleFault::late);
  EXPECT_EQ(robot.health.imu.age, 0.01);
}

TEST(SensorConsistency, WhatTheGuardFindsBehindItStandsAlone) {
  Standing robot(0.5);
  robot.accelerometer_error = {0.0, 3.0, 0.0};
  robot.run(0.3);
  ASSERT_EQ(robot.health.imu.fault, SampleFault::contradicts);
  robot.is_imu_late = true;
  robot.tick();
  EXPECT_EQ(robot.health.imu.fault, SampleFault::late);
  EXPECT_EQ(robot.health.imu.age, 0.01);
  robot.torque_error[2] = 20.0;
  robot.run(0.5);
  EXPECT_EQ(robot.health.joint_torques.fault, SampleFault::none) << "no IMU says what moves it";
  robot.is_imu_late = false;
  robot.accelerometer_error.setZero();
  robot.run(0.5);
  EXPECT_EQ(robot.health.joint_torques.fault, SampleFault::contradicts) << "judged again";
}

// The guard goes on with the last torques that were numbers.
TEST(SensorConsistency, TorquesThatAreFilledInAreNotFrozen) {
  for (const bool are_none : {false, true}) {
    Standing robot(0.5);
    robot.torques_stay = true;
    robot.torques_are_none = are_none;
    robot.command = 16.5;
    robot.run(0.3);
    EXPECT_EQ(robot.health.joint_torques.fault,
              are_none ? SampleFault::not_a_number : SampleFault::repeats);
  }
}

TEST(SensorConsistency, EncodersThatComeLateAreNotFrozenBesides) {
  Standing robot(0.5);
  robot.state.v_WB.x() = 0.2;  // over feet that stand, with the same angles
  robot.run(0.2);
  ASSERT_EQ(robot.health.encoders.fault, SampleFault::repeats);
  robot.are_encoders_late = true;
  robot.tick();
  EXPECT_EQ(robot.health.encoders.fault, SampleFault::late);
  EXPECT_EQ(robot.health.encoders.age, 0.01);
}

TEST(SensorConsistency, SwitchedOffItSaysNothing) {
  SensorConsistencyOptions options;
  options.enabled = false;
  Standing robot(0.0, options);
  robot.run(0.5);
  robot.accelerometer_error = {0.0, 30.0, 0.0};
  robot.torque_error.setConstant(20.0);
  robot.run(0.5);
  EXPECT_TRUE(robot.is_well());
}

}  // namespace
}  // namespace surefoot::estimation
