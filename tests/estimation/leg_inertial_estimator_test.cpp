#include "surefoot/estimation/leg_inertial_estimator.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/numbers.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/math/smoothstep.hpp"
#include "tests/estimation/standing_context.hpp"
#include "tests/support/turning_robot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

namespace surefoot::estimation {
namespace {

using test::kMotion;
using test::kStill;
using test::standing;
using test::tilt_error;
using test::TurningRobot;

/// By the turn that ships and by a smaller one.
TEST(LegInertialEstimator, FollowsATorsoThatTurnsOverRollingFeet) {
  const gaits::CalibrationOptions ships{.duration = 6.0};
  for (const auto& [motion, most] : {std::pair(ships, 3.5e-3), std::pair(kMotion, 3e-3)}) {
    SCOPED_TRACE(motion.roll);
    TurningRobot robot(KinematicErrors{}, motion);
    LegInertialEstimator estimator(robot.description(), {}, TurningRobot::kPeriod);
    RobotState state = estimator.update(robot.reading(), standing());
    const Vec3 p = state.p_WB;
    double tilt = 0.0, way = 0.0, speed = 0.0;
    while (robot.time() < motion.duration + motion.settle) {
      robot.tick();
      state = estimator.update(robot.reading(), standing());
      tilt = std::max(tilt, tilt_error(state, robot));
      way = std::max(way, (state.p_WB - p).norm());
      speed = std::max(speed, state.v_WB.norm());
    }
    EXPECT_LT(tilt, most);
    EXPECT_LT(way, 3e-3) << "the base stays where it is";
    EXPECT_LT(speed, 3e-3);
  }
}

/// Largest estimated base speed of a standing robot while a foot slides 2 cm between touchdown and
/// full load [m/s].
double speed_at_touchdown(const LegInertialOptions& options) {
  constexpr double kLifted = 0.3, kDown = 0.4, kLoaded = 0.5, kWay = 0.04;  // [s], of the hip [rad]
  TurningRobot robot(KinematicErrors{}, {.duration = 6.0, .settle = 10.0});
  LegInertialEstimator estimator(robot.description(), options, TurningRobot::kPeriod);
  double fastest = 0.0;
  while (robot.time() < 1.0) {
    SensorReading reading = robot.reading();
    const double share = std::clamp((robot.time() - kDown) / (kLoaded - kDown), 0.0, 1.0);
    reading.q[first_joint(Leg::LF)] += kWay * smoothstep(std::min(1.0, 2.0 * share));
    TickContext context = standing();
    FootContact& contact = context.contacts[index(Leg::LF)];
    contact.carries = robot.time() < kLifted || robot.time() >= kDown;
    if (robot.time() >= kLifted) contact.normal_force *= share;
    fastest = std::max(fastest, estimator.update(reading, context).v_WB.norm());
    robot.tick();
  }
  return fastest;
}

TEST(LegInertialEstimator, AFootThatHasOnlyJustComeDownIsTrustedLittle) {
  LegInertialOptions at_once;
  at_once.trust_time = 1e-9;
  at_once.trust_force = 1e-9;
  EXPECT_LT(speed_at_touchdown({}), 0.01);
  EXPECT_GT(speed_at_touchdown(at_once), 3.0 * speed_at_touchdown({}));
}

/// Largest error of joints [rad], of the tilt [rad], of a robot whose readings come `late` ticks
/// late.
std::pair<double, double> error_by_delay(int late, bool predict) {
  TurningRobot robot(KinematicErrors{}, kMotion);
  LegInertialOptions options;
  options.predict = predict;
  LegInertialEstimator estimator(robot.description(), options, TurningRobot::kPeriod);
  std::deque<SensorReading> on_the_way;
  double joints = 0.0, tilt = 0.0;
  JointVector q_before = robot.reading().q;
  while (robot.time() < 6.5) {
    robot.tick();
    on_the_way.push_back(robot.reading());
    if (static_cast<int>(on_the_way.size()) <= late) continue;
    SensorReading reading = on_the_way.front();
    on_the_way.pop_front();
    reading.time = robot.time();
    TickContext context = standing();
    context.joint_lag = context.imu_lag = late * TurningRobot::kPeriod;
    context.joint_velocity = (reading.q - q_before) / TurningRobot::kPeriod;
    q_before = reading.q;
    const RobotState state = estimator.update(reading, context);
    if (robot.time() < 1.0) continue;
    joints = std::max(joints, (state.q - robot.reading().q).cwiseAbs().maxCoeff());
    tilt = std::max(tilt, tilt_error(state, robot));
  }
  return {joints, tilt};
}

TEST(LegInertialEstimator, ThatPredictsIsOfNowWhenReadingsComeLate) {
  const auto [joints, tilt] = error_by_delay(4, true);
  const auto [late_joints, late_tilt] = error_by_delay(4, false);
  EXPECT_LT(joints, 0.2 * late_joints);
  EXPECT_LT(tilt, 0.7 * late_tilt);
  EXPECT_EQ(error_by_delay(0, true), error_by_delay(0, false));
}

TEST(LegInertialEstimator, FindsTheAccelerometersBiasByTurning) {
  TurningRobot robot(KinematicErrors{}, kMotion);
  LegInertialEstimator estimator(robot.description(), {}, TurningRobot::kPeriod);
  const Vec3 bias(0.08, -0.05, 0.0);
  RobotState state;
  double before = 0.0;
  while (robot.time() < 6.5) {
    robot.tick();
    SensorReading reading = robot.reading();
    reading.accelerometer += bias;
    state = estimator.update(reading, standing());
    if (robot.time() < 0.4) before = tilt_error(state, robot);
  }
  EXPECT_GT(before, 0.007);
  EXPECT_LT(tilt_error(state, robot), 0.3 * before);
}

/// A corrected leg length does not move the robot.
TEST(LegInertialEstimator, TakesOverWhatIsFoundOfTheLegsWithoutMoving) {
  KinematicErrors found;
  found.thigh = {0.01, -0.008, 0.0, 0.006};
  found.shank = {-0.004, 0.01, 0.009, -0.01};
  found.zero.setConstant(0.006);
  TurningRobot robot(found, kStill);
  LegInertialEstimator estimator(robot.description(), {}, TurningRobot::kPeriod);
  RobotState state = estimator.update(robot.reading(), standing());
  while (robot.time() < 2.0) {
    robot.tick();
    state = estimator.update(robot.reading(), standing());
  }
  const RobotState before = state;
  while (robot.time() < 3.0) {
    robot.tick();
    const double share = smoothstep(std::min(1.0, robot.time() - 2.0));
    TickContext context = standing();
    for (const Leg leg : kLegs) {
      context.kinematics.thigh[index(leg)] = share * found.thigh[index(leg)];
      context.kinematics.shank[index(leg)] = share * found.shank[index(leg)];
    }
    context.kinematics.zero = share * found.zero;
    SensorReading reading = robot.reading();
    reading.q -= context.kinematics.zero;
    state = estimator.update(reading, context);
  }
  EXPECT_LT((state.p_WB - before.p_WB).norm(), 5e-4);
  EXPECT_LT(box_minus(state.q_WB, before.q_WB).norm(), 5e-4);
}

/// A corrected IMU mounting turns the estimated robot, but does not move it.
TEST(LegInertialEstimator, TakesOverHowTheImuIsMounted) {
  const Vec3 imu = 0.0087 * Vec3(1.0, -0.8, 0.6);
  TurningRobot robot(KinematicErrors{}, kMotion);
  LegInertialEstimator estimator(robot.description(), {}, TurningRobot::kPeriod);
  RobotState state;
  const auto tick = [&](double share) {
    robot.tick();
    TickContext context = standing();
    context.kinematics.imu = share * imu;
    SensorReading reading = robot.reading();
    const Quat found = exp_rotation(context.kinematics.imu) * exp_rotation(imu).conjugate();
    reading.gyro = found * reading.gyro;
    reading.accelerometer = found * reading.accelerometer;
    state = estimator.update(reading, context);
  };
  while (robot.time() < 7.0) tick(0.0);
  const double askew = imu.head<2>().norm();
  EXPECT_NEAR(tilt_error(state, robot), askew, 0.15 * askew);
  const Vec3 p_WB = state.p_WB;
  const double heading = yaw(state.R_WB());
  while (robot.time() < 8.0) tick(smoothstep(std::min(1.0, robot.time() - 7.0)));
  EXPECT_LT(tilt_error(state, robot), 0.15 * askew);
  EXPECT_LT((state.p_WB - p_WB).norm(), 5e-4);
  EXPECT_LT(state.v_WB.norm(), 1e-3);
  EXPECT_NEAR(yaw(state.R_WB()), heading, 0.05 * std::abs(imu.z()))
      << "what is counted from the start does not depend on the mounting";
}

TEST(LegInertialEstimator, KnowsNoTiltBetterThanTheMounting) {
  TurningRobot robot(KinematicErrors{}, kMotion);
  LegInertialEstimator sure(robot.description(), {}, TurningRobot::kPeriod);
  LegInertialEstimator unsure(robot.description(), {}, TurningRobot::kPeriod);
  const Mat3 mounting = Vec3(4e-6, 1e-6, 9e-6).asDiagonal();
  while (robot.time() < 6.0) {
    robot.tick();
    TickContext context = standing();
    const RobotState mounted = sure.update(robot.reading(), context);
    context.kinematics.imu_covariance = mounting;
    const RobotState state = unsure.update(robot.reading(), context);
    const Mat3 added = state.orientation_covariance - mounted.orientation_covariance;
    const Mat3 R = state.R_WB();
    EXPECT_LT((added - R * mounting * R.transpose()).norm(), 1e-12);
    EXPECT_EQ(state.q_WB.coeffs(), mounted.q_WB.coeffs());
  }
}

/// Estimated heading after the base moved forward by 0.1 m in a second, over legs that are longer
/// than modelled on the left and shorter on the right [rad].
double heading_after_a_way(const LegInertialOptions& options) {
  KinematicErrors wrong;
  wrong.thigh = wrong.shank = {0.008, -0.008, 0.008, -0.008};
  TurningRobot robot(wrong, kStill);
  LegInertialEstimator estimator(robot.description(), options, TurningRobot::kPeriod);
  RobotState state;
  Motion<double> way{0.0, 0.0, 0.0};
  while (robot.time() < 7.0) {
    const Motion<double> before = way;
    const double t = std::clamp(robot.time() + TurningRobot::kPeriod - 6.0, 0.0, 1.0);
    way.p = 0.1 * smoothstep(t);
    way.v = (way.p - before.p) / TurningRobot::kPeriod;
    way.a = (way.v - before.v) / TurningRobot::kPeriod;
    robot.shift_base({way.p - before.p, 0.0, 0.0});
    robot.tick();
    SensorReading reading = robot.reading();
    reading.accelerometer.x() += way.a;
    state = estimator.update(reading, standing());
  }
  EXPECT_NEAR(state.p_WB.x(), 0.1, 0.005);
  return yaw(state.R_WB());
}

TEST(LegInertialEstimator, OfTheHeadingOnAWayTheGyroscopeKnowsMoreThanTheLegs) {
  const double of_the_legs = std::abs(heading_after_a_way({.filter = {}, .stance_turn = 0.0}));
  EXPECT_GT(of_the_legs, 4e-4);
  EXPECT_LT(std::abs(heading_after_a_way({})), 0.1 * of_the_legs);
}

TEST(LegInertialEstimator, OfReadingsThatAreWorthNothingNoTraceIsLeft) {
  TurningRobot robot(KinematicErrors{}, kMotion);
  LegInertialEstimator spoilt(robot.description(), {}, TurningRobot::kPeriod);
  LegInertialEstimator other(robot.description(), {}, TurningRobot::kPeriod);
  TickContext wrong = standing();
  wrong.kinematics.thigh[1] = 0.01;
  for (int tick = 0; tick < 8; ++tick) {
    robot.tick();
    SensorReading reading = robot.reading();
    reading.q.array() += 0.1 * tick;
    reading.accelerometer = reading.accelerometer.reverse().eval();
    EXPECT_TRUE(spoilt.update(reading, wrong).p_WB.allFinite());
  }
  for (LegInertialEstimator* estimator : {&spoilt, &other}) estimator->restart();
  while (robot.time() < 1.0) {
    robot.tick();
    const RobotState& state = spoilt.update(robot.reading(), standing());
    const RobotState& expected = other.update(robot.reading(), standing());
    ASSERT_EQ(state.p_WB.allFinite(), expected.p_WB.allFinite()) << robot.time();
    if (!expected.p_WB.allFinite()) continue;
    ASSERT_EQ(state.p_WB, expected.p_WB) << robot.time();
    ASSERT_EQ(state.v_WB, expected.v_WB) << robot.time();
    ASSERT_EQ(state.q_WB.coeffs(), expected.q_WB.coeffs()) << robot.time();
  }
  EXPECT_TRUE(other.update(robot.reading(), standing()).p_WB.allFinite()) << "it has begun";
}

/// After a tick whose state was refused there is no force of that tick.
TEST(LegInertialEstimator, ForcesThatAreNotKnownSpoilNothing) {
  TurningRobot robot(KinematicErrors{}, kMotion);
  LegInertialEstimator estimator(robot.description(), {}, TurningRobot::kPeriod);
  RobotState state;
  while (robot.time() < 3.0) {
    robot.tick();
    TickContext context = standing();
    const bool unknown = robot.time() > 1.0 && robot.time() < 1.1;
    for (FootContact& contact : context.contacts) contact.normal_force = unknown ? kNaN : 75.0;
    state = estimator.update(robot.reading(), context);
    ASSERT_TRUE(state.u().head<6>().allFinite() && state.p_WB.allFinite()) << robot.time();
  }
  EXPECT_LT(tilt_error(state, robot), 0.005);
}

TEST(LegInertialEstimator, OfAnotherRobotsReadingSaysNothing) {
  TurningRobot robot(KinematicErrors{}, kStill);
  for (const double period : {0.0, -1.0, kNaN})
    EXPECT_THROW(LegInertialEstimator(robot.description(), {}, period), Error);
  LegInertialEstimator estimator(robot.description(), {}, TurningRobot::kPeriod);
  SensorReading reading = robot.reading();
  reading.q = reading.torque = JointVector::Zero(18);
  const RobotState state = estimator.update(reading, standing());
  EXPECT_EQ(state.q.size(), 12);
  EXPECT_TRUE(state.q.array().isNaN().all());
}

}  // namespace
}  // namespace surefoot::estimation
