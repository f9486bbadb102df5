#include "surefoot/estimation/leg_inertial_estimator.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/numbers.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/math/smoothstep.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/turning_robot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

namespace surefoot::estimation {
namespace {

using test::TurningRobot;

/// Slow enough for a start: a robot that turns by 0.2 rad/s does not stand.
constexpr gaits::CalibrationOptions kMotion{
    .duration = 6.0, .settle = 0.5, .roll = 0.12, .pitch = 0.10, .yaw = 0.15};

constexpr gaits::CalibrationOptions kStill{
    .duration = 6.0, .settle = 0.5, .roll = 0.0, .pitch = 0.0, .yaw = 0.0};

TickContext standing() {
  TickContext context;
  for (FootContact& contact : context.contacts) contact.normal_force = 75.0;
  return context;
}

double tilt_error(const RobotState& state, const TurningRobot& robot) {
  return state.R_WB().row(2).cross(robot.R_WB().row(2)).norm();
}

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
