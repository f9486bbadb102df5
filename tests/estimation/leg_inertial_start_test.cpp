// How the estimate begins, begins anew, and goes on off its feet.
#include "surefoot/estimation/leg_inertial_estimator.hpp"
#include "surefoot/math/numbers.hpp"
#include "surefoot/math/rotation.hpp"
#include "tests/estimation/standing_context.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/turning_robot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surefoot::estimation {
namespace {

using test::kMotion;
using test::kStill;
using test::standing;
using test::tilt_error;
using test::TurningRobot;

// Its drives begin late: it falls, hits the ground, and stands.
TEST(LegInertialEstimator, StartsWhenTheRobotStands) {
  for (const bool falls : {false, true}) {
    TurningRobot robot(KinematicErrors{}, kStill);
    LegInertialEstimator estimator(robot.description(), {}, TurningRobot::kPeriod);
    double started = kNaN;
    RobotState state;
    for (int tick = 0; tick < 200; ++tick) {
      robot.tick();
      SensorReading reading = robot.reading();
      const bool in_the_air = falls && tick < 40, on_the_way = falls && tick >= 40 && tick < 60;
      if (in_the_air) reading.accelerometer = Vec3(0.05, -0.02, 0.03);
      if (on_the_way) reading.accelerometer += Vec3(9.0, 0.0, tick % 2 == 0 ? 0.5 : 0.0);
      state = estimator.update(reading, standing());
      if (std::isnan(started) && state.q_WB.coeffs().allFinite()) started = tick;
    }
    EXPECT_EQ(started, falls ? 100 : 0) << "0.1 s on its feet";
    EXPECT_LT(tilt_error(state, robot), 0.002);
  }
}

// Caught in a fall or seen late, it sways over rolling feet: its acceleration is not tilt (0.08 rad
// of it), nor is its velocity nothing.
TEST(LegInertialEstimator, StartsInASway) {
  constexpr double kAcceleration = 0.8;  // [m/s²]
  for (const double first_force : {0.0, kNaN}) {
    TurningRobot robot(KinematicErrors{}, kStill);
    LegInertialEstimator estimator(robot.description(), {}, TurningRobot::kPeriod);
    RobotState state;
    Vec3 v_WB(0.02, 0.0, 0.0);
    for (int tick = 0; tick < 42; ++tick) {
      ASSERT_FALSE(state.q_WB.coeffs().allFinite());
      const JointVector q_before = robot.reading().q;
      v_WB.x() += kAcceleration * TurningRobot::kPeriod;
      robot.shift_base(v_WB * TurningRobot::kPeriod);
      robot.tick();
      SensorReading reading = robot.reading();
      reading.accelerometer.x() += kAcceleration;
      if (tick == 0) reading.accelerometer.setConstant(first_force);
      TickContext context = standing();
      context.joint_velocity = (reading.q - q_before) / TurningRobot::kPeriod;
      state = estimator.update(reading, context);
    }
    EXPECT_LT(tilt_error(state, robot), 0.001);
    EXPECT_LT((state.v_WB - v_WB).norm(), 0.003);
    EXPECT_GT(
        estimator.filter().covariance()(InvariantFilter::kVelocity, InvariantFilter::kVelocity),
        std::pow(2.0 * LegInertialOptions{}.filter.initial_velocity, 2));
  }
}

TEST(LegInertialEstimator, StartsInATurnThatIsNoBias) {
  TurningRobot robot(KinematicErrors{}, kMotion);
  LegInertialEstimator estimator(robot.description(), {}, TurningRobot::kPeriod);
  while (robot.time() < 2.0) robot.tick();
  RobotState state;
  for (int tick = 0; tick < 42; ++tick) {
    const JointVector q_before = robot.reading().q;
    robot.tick();
    SensorReading reading = robot.reading();
    if (tick == 0) reading.gyro.setConstant(kNaN);
    TickContext context = standing();
    context.joint_velocity = (reading.q - q_before) / TurningRobot::kPeriod;
    state = estimator.update(reading, context);
  }
  EXPECT_GT(robot.reading().gyro.norm(), 0.05);
  EXPECT_LT((state.w_WB_B - robot.reading().gyro).norm(), 0.005);
  EXPECT_LT(tilt_error(state, robot), 0.003);
}

TEST(LegInertialEstimator, BegunAnewItKeepsItsPlaceAndHeadingAndForgetsTheRest) {
  TurningRobot robot(KinematicErrors{}, kStill);
  LegInertialEstimator estimator(robot.description(), {}, TurningRobot::kPeriod);
  RobotState state;
  while (robot.time() < 3.0) {
    robot.tick();
    SensorReading reading = robot.reading();
    const bool mad = robot.time() > 0.5 && robot.time() < 2.0;
    if (mad) reading.accelerometer.y() += 3.0;
    if (mad) reading.gyro.z() += 0.5;
    state = estimator.update(reading, standing());
  }
  ASSERT_GT(tilt_error(state, robot), 0.02);
  const Vec3 p_WB = state.p_WB;
  const double heading = yaw(state.R_WB());
  ASSERT_GT(std::abs(heading), 1e-3);
  LegInertialEstimator another(robot.description(), {}, TurningRobot::kPeriod);
  robot.tick();
  TickContext context = standing();
  context.restarts = true;
  state = estimator.update(robot.reading(), context);
  EXPECT_LT((state.p_WB - p_WB).norm(), 1e-9);
  EXPECT_NEAR(yaw(state.R_WB()), heading, 1e-9);
  RobotState fresh = another.update(robot.reading(), standing());
  const Mat3 turn = rotation_about_z(heading - yaw(fresh.R_WB()));
  while (robot.time() < 5.0) {  // but for what the mean of its last readings remembers
    robot.tick();
    state = estimator.update(robot.reading(), standing());
    fresh = another.update(robot.reading(), standing());
    ASSERT_LT((state.R_WB() - turn * fresh.R_WB()).norm(), 1e-4) << robot.time();
    ASSERT_LT((state.v_WB - turn * fresh.v_WB).norm(), 1e-4) << robot.time();
  }
}

TEST(LegInertialEstimator, BeforeTheImuComesItTellsOfTheJointsAlone) {
  TurningRobot robot(KinematicErrors{}, kMotion);
  LegInertialEstimator estimator(robot.description(), {}, TurningRobot::kPeriod);
  SensorReading reading = robot.reading();
  reading.gyro.setConstant(kNaN);
  TickContext context = standing();
  context.joint_velocity.setConstant(0.2);
  const RobotState& state = estimator.update(reading, context);
  EXPECT_EQ(state.time, reading.time);
  EXPECT_EQ(state.q, reading.q);
  EXPECT_EQ(state.qd, context.joint_velocity);
  EXPECT_TRUE(state.p_WB.array().isNaN().all());
}

// Turned, tilted and shaken while carried, or from its first reading on.
TEST(LegInertialEstimator, OffItsFeetItRestsWhereItWasAndTurns) {
  for (const bool has_stood : {true, false}) {
    SCOPED_TRACE(has_stood);
    TurningRobot robot(KinematicErrors{}, {.duration = 6.0, .settle = 100.0});
    LegInertialEstimator estimator(robot.description(), {}, TurningRobot::kPeriod);
    RobotState state;
    for (int i = 0; has_stood && i < 400; ++i) {
      state = estimator.update(robot.reading(), standing());
      robot.tick();
    }
    const Mat3 roll = exp_rotation(Vec3(0.2, 0.0, 0.0)).toRotationMatrix();
    TickContext context = standing();
    context.off_its_feet = true;
    const test::MallocCounter counter;
    for (int i = 0; i < 1000; ++i) {
      SensorReading reading = robot.reading();
      const double shaken = std::sin(0.3 * i);
      reading.accelerometer = roll.transpose() * Vec3(shaken, 0.0, kGravity + shaken);
      reading.gyro = roll.transpose() * Vec3(0.0, 0.0, 0.4);
      const RobotState now = estimator.update(reading, context);
      if (i == 0 && !has_stood) state = now;
      ASSERT_EQ(now.v_WB.norm(), 0.0);
      ASSERT_LT((now.p_WB - state.p_WB).head<2>().norm(), 1e-9);
      if (i == 999) state = now;
      robot.tick();
    }
    EXPECT_EQ(counter.count(), 0U);
    EXPECT_NEAR(yaw(state.R_WB()), 1.0, 0.01);
    EXPECT_LT(state.R_WB().row(2).cross(roll.row(2)).norm(), 0.03);
    context.off_its_feet = false;
    context.restarts = true;
    const RobotState restarted = estimator.update(robot.reading(), context);
    EXPECT_LT((restarted.p_WB - state.p_WB).norm(), 1e-9);
  }
}

// A torso that sways on its soft legs after it was set down: neither bias nor tilt.
TEST(LegInertialEstimator, SetDownItKeepsWhatItKnowsOfTheGyroscopeAndOfTheTilt) {
  const Vec3 bias(0.02, -0.01, 0.005);
  TurningRobot robot(KinematicErrors{}, {.duration = 6.0, .settle = 100.0});
  LegInertialEstimator estimator(robot.description(), {}, TurningRobot::kPeriod);
  TickContext context = standing();
  RobotState state;
  SensorReading reading;
  for (int i = 0; i < 1200; ++i) {
    context.off_its_feet = i >= 400;
    const double phase = 25.0 * std::max(0, i - 1120) * TurningRobot::kPeriod;  // two seconds later
    reading = robot.reading();
    reading.gyro += bias + 0.3 * std::sin(phase) * Vec3::UnitX();
    reading.accelerometer.y() += std::sin(phase);
    state = estimator.update(reading, context);
    robot.tick();
  }
  const Mat3 R_WB = state.R_WB();
  context.off_its_feet = false;
  context.restarts = true;
  state = estimator.update(reading, context);
  EXPECT_LT((reading.gyro - state.w_WB_B - bias).norm(), 0.002);
  EXPECT_LT(state.R_WB().row(2).cross(R_WB.row(2)).norm(), 1e-9);
}

// 4 m/s² for a tenth of a second, as hands set it down.
TEST(LegInertialEstimator, OffItsFeetAJoltIsNoTilt) {
  TurningRobot robot(KinematicErrors{}, {.duration = 6.0, .settle = 100.0});
  LegInertialEstimator estimator(robot.description(), {}, TurningRobot::kPeriod);
  TickContext context = standing();
  context.off_its_feet = true;
  RobotState state;
  for (int i = 0; i < 440; ++i) {
    SensorReading reading = robot.reading();
    if (i >= 400) reading.accelerometer.x() += 4.0;
    state = estimator.update(reading, context);
    robot.tick();
  }
  EXPECT_LT(std::acos(state.R_WB()(2, 2)), 0.06);
}

}  // namespace
}  // namespace surefoot::estimation
