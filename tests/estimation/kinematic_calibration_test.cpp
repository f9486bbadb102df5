#include "surefoot/estimation/kinematic_calibration.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/model/robot_model.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/turning_robot.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace surefoot::estimation {
namespace {

using test::error_between_feet;
using test::Random;
using test::TurningRobot;

constexpr gaits::CalibrationOptions kMotion{.duration = 6.0};
constexpr double kAll = 10.0;  // with all that comes after the motion [s]

KinematicErrors some_errors(unsigned seed, double length, double zero) {
  Random random(seed);
  KinematicErrors errors;
  for (const Leg leg : kLegs) {
    errors.thigh[index(leg)] = random.uniform(-length, length);
    errors.shank[index(leg)] = random.uniform(-length, length);
  }
  for (double& value : errors.zero) value = random.uniform(-zero, zero);
  return errors;
}

/// A robot and its calibration.
struct Bench {
  explicit Bench(const KinematicErrors& errors, const gaits::CalibrationOptions& motion = kMotion)
      : robot(errors, motion), model(robot.description()) {
    state.p_WB.setZero();
    state.v_WB.setZero();
    state.q = robot.reading().q;
  }

  void tick() {
    robot.tick();
    const SensorReading reading = read();
    state.time = reading.time;
    state.q_WB = tilt * Quat(robot.R_WB());
    gyros.push_back(exp_rotation(imu).conjugate() * reading.gyro);
    const std::size_t late = std::min(gyro_delay, gyros.size() - 1);
    const Vec3 gyro = exp_rotation(calibration.errors().imu) * gyros[gyros.size() - 1 - late];
    state.w_WB_B = gyro;
    const JointVector q = reading.q - calibration.errors().zero;
    state.qd = (q - state.q) / TurningRobot::kPeriod;
    state.q = q;
    model.set_leg_lengths(calibration.errors());
    const bool listens = robot.stage() == CalibrationStage::turning;
    if (reading.time <= deaf_until) return;
    calibration.update(reading.time, model.update(state, Vec3::UnitZ()), gyro + bias, Vec3::UnitZ(),
                       listens);
  }
  void run(double until) {
    while (robot.time() < until) tick();
  }
  [[nodiscard]] SensorReading read() const {
    SensorReading reading = robot.reading();
    for (double& angle : reading.q) angle = resolution * std::round(angle / resolution);
    return reading;
  }

  TurningRobot robot;
  model::RobotModel model;
  KinematicCalibration calibration{robot.description(), TurningRobot::kPeriod};
  RobotState state;
  Quat tilt = Quat::Identity();  // by which the orientation is believed askew
  Vec3 bias = Vec3::Zero();      // of the gyroscope
  Vec3 imu = Vec3::Zero();       // by which it is mounted askew
  std::size_t gyro_delay = 0;    // [ticks]
  std::vector<Vec3> gyros;
  double resolution = 4.4e-4;  // of the encoders [rad]
  double deaf_until = 0.0;     // ticks that are missed [s]
};

TEST(KinematicCalibration, FindsLengthsOfThighAndShank) {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    const KinematicErrors truth = some_errors(seed, 0.01, 0.0);
    Bench bench(truth);
    const double before = error_between_feet(bench.robot, KinematicErrors{});
    bench.run(kAll);
    EXPECT_LT(error_between_feet(bench.robot, bench.calibration.errors()), 0.25 * before) << seed;
    for (const Leg leg : kLegs) {
      const KinematicErrors& found = bench.calibration.errors();
      EXPECT_NEAR(found.thigh[index(leg)], truth.thigh[index(leg)], 0.0025) << seed;
      EXPECT_NEAR(found.shank[index(leg)], truth.shank[index(leg)], 0.0025) << seed;
    }
  }
}

TEST(KinematicCalibration, ZerosOfEncodersToo) {
  for (const unsigned seed : {11U, 12U, 13U, 14U}) {
    Bench bench(some_errors(seed, 0.01, 0.0087));
    const double before = error_between_feet(bench.robot, KinematicErrors{});
    bench.run(kAll);
    EXPECT_LT(error_between_feet(bench.robot, bench.calibration.errors()), 0.35 * before) << seed;
  }
}

TEST(KinematicCalibration, NeedsNoVerticalAndNoGyroscopeWithoutBias) {
  Bench bench(some_errors(5, 0.01, 0.0));
  bench.tilt = Quat(Eigen::AngleAxisd(0.02, Vec3(1.0, 1.0, 0.0).normalized()));
  bench.bias = Vec3(2e-3, -1e-3, 1e-3);
  const double before = error_between_feet(bench.robot, KinematicErrors{});
  bench.run(kAll);
  EXPECT_LT(error_between_feet(bench.robot, bench.calibration.errors()), 0.25 * before);
}

TEST(KinematicCalibration, FindsHowTheImuIsMounted) {
  const Vec3 imu = 0.0087 * Vec3(1.0, -0.8, 0.6);
  constexpr unsigned kNumRobots = 8;
  double square = 0.0, nees = 0.0;
  for (unsigned seed = 21; seed < 21 + kNumRobots; ++seed) {
    Bench bench(some_errors(seed, 0.01, 0.0087));
    bench.imu = imu;
    const double before = error_between_feet(bench.robot, KinematicErrors{});
    bench.run(kAll);
    const KinematicErrors& found = bench.calibration.errors();
    const Vec3 left = imu - found.imu;
    square += left.squaredNorm() / kNumRobots;
    nees += left.dot(found.imu_covariance.inverse() * left) / (3.0 * kNumRobots);
    EXPECT_LT(error_between_feet(bench.robot, found), 0.35 * before) << seed;
  }
  EXPECT_LT(std::sqrt(square), 0.35 * imu.norm());
  EXPECT_GT(nees, 0.3);
  EXPECT_LT(nees, 2.0) << "what is left is as large as believed";
}

TEST(KinematicCalibration, BearsAGyroscopeThatIsLate) {
  for (const std::size_t delay : {1U, 3U}) {
    const KinematicErrors legs = some_errors(25, 0.01, 0.0087);
    Bench punctual(legs), late(legs);
    late.gyro_delay = delay;
    punctual.run(kAll);
    late.run(kAll);
    const double best = error_between_feet(punctual.robot, punctual.calibration.errors());
    EXPECT_LT(error_between_feet(late.robot, late.calibration.errors()), 1.3 * best) << delay;
  }
}

TEST(KinematicCalibration, OfARobotThatIsAsDescribedFindsNothing) {
  Bench bench(KinematicErrors{});
  bench.run(kAll);
  const KinematicErrors& found = bench.calibration.errors();
  EXPECT_LT(found.zero.cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT(found.imu.norm(), 1e-3);
  for (const Leg leg : kLegs) {
    EXPECT_NEAR(found.thigh[index(leg)], 0.0, 5e-4);
    EXPECT_NEAR(found.shank[index(leg)], 0.0, 5e-4);
  }
}

TEST(KinematicCalibration, ARobotThatStandsStillLearnsNothing) {
  gaits::CalibrationOptions still = kMotion;
  still.roll = still.pitch = still.yaw = 0.0;
  Bench bench(some_errors(6, 0.01, 0.0087), still);
  bench.resolution = 1e-9;
  bench.run(kAll);
  const KinematicErrors& found = bench.calibration.errors();
  EXPECT_LT(found.zero.cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_GT(found.imu_covariance.trace(), 3.0 * 0.0045 * 0.0045);
  for (const Leg leg : kLegs) EXPECT_NEAR(found.thigh[index(leg)], 0.0, 1e-4);
}

TEST(KinematicCalibration, WhatItFindsComesIntoUseLittleByLittle) {
  Bench bench(some_errors(7, 0.01, 0.0087));
  KinematicErrors before = bench.calibration.errors();
  double largest = 0.0;
  while (bench.robot.time() < kAll) {
    bench.tick();
    const KinematicErrors& now = bench.calibration.errors();
    EXPECT_TRUE(now == KinematicErrors{} || bench.robot.stage() != CalibrationStage::turning);
    largest = std::max(largest, (now.zero - before.zero).cwiseAbs().maxCoeff());
    before = now;
  }
  EXPECT_GT(before.zero.cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT(largest, 2.0 * before.zero.cwiseAbs().maxCoeff() * TurningRobot::kPeriod / 0.5);
}

TEST(KinematicCalibration, ForgetsAMotionInWhichAFootDidNotStay) {
  Bench bench(some_errors(10, 0.01, 0.0));
  bench.run(5.5);
  bench.calibration.forget();  // what is left of the turning is too little
  bench.run(kAll);
  EXPECT_EQ(bench.calibration.errors(), KinematicErrors{});
  EXPECT_FALSE(bench.calibration.knows_legs());
  const KinematicErrors truth = some_errors(10, 0.01, 0.0);
  Bench early(truth);
  early.run(1.5);
  early.calibration.forget();
  const double before = error_between_feet(early.robot, KinematicErrors{});
  early.run(kAll);
  EXPECT_LT(error_between_feet(early.robot, early.calibration.errors()), 0.3 * before);
}

TEST(KinematicCalibration, NumbersThatAreNoneAreLeftOut) {
  Bench good(some_errors(8, 0.01, 0.0)), bad(some_errors(8, 0.01, 0.0));
  good.run(kAll);
  bad.run(3.0 + TurningRobot::kPeriod);
  for (int i = 0; i < 40; ++i) {  // of two updates a tick, those that samples are taken of
    bad.tick();
    model::Dynamics broken = bad.model.dynamics();
    broken.foot[1].p.x() = kNaN;
    for (model::RotationKinematics& shank : broken.shank)
      shank.w.setZero();  // which rolls no further
    bad.calibration.update(bad.state.time, broken, Vec3::Constant(kNaN), Vec3::UnitZ(), true);
  }
  bad.run(kAll);
  for (const Leg leg : kLegs) {
    EXPECT_NEAR(bad.calibration.errors().thigh[index(leg)],
                good.calibration.errors().thigh[index(leg)], 5e-4);
  }
}

TEST(KinematicCalibration, TicksThatWereMissedAreTurnedThroughToo) {
  const KinematicErrors truth = some_errors(8, 0.01, 0.0);
  Bench whole(truth);
  whole.run(kAll);
  for (const double begin : {2.5, 3.0}) {
    Bench bench(truth);
    bench.run(begin);
    bench.deaf_until = begin + 3.5 * TurningRobot::kPeriod;
    bench.run(kAll);
    const KinematicErrors& found = bench.calibration.errors();
    for (const Leg leg : kLegs) {
      const std::size_t k = index(leg);
      EXPECT_NEAR(found.thigh[k], whole.calibration.errors().thigh[k], 4e-4) << begin;
      EXPECT_NEAR(found.shank[k], whole.calibration.errors().shank[k], 4e-4) << begin;
    }
  }
}

TEST(KinematicCalibration, AfterALongerGapItListensAnew) {
  Bench bench(some_errors(10, 0.01, 0.0));
  bench.run(5.5);
  bench.deaf_until = 5.5 + 10.0 * TurningRobot::kPeriod;
  bench.run(kAll);
  EXPECT_EQ(bench.calibration.errors(), KinematicErrors{}) << "what is left is too little";
}

TEST(KinematicCalibration, WhatPassesWhileItDoesNotListenIsNoPartOfTheTurn) {
  const KinematicErrors truth = some_errors(10, 0.01, 0.0);
  Bench forgetful(truth), disturbed(truth);
  for (Bench* bench : {&forgetful, &disturbed}) {
    bench->run(1.5);
    bench->calibration.forget();
  }
  disturbed.deaf_until = 2.5 + 0.5 * TurningRobot::kPeriod;
  while (forgetful.robot.time() < 2.5 - 0.5 * TurningRobot::kPeriod) {
    forgetful.tick();
    forgetful.calibration.forget();
  }
  forgetful.run(kAll);
  disturbed.run(kAll);
  EXPECT_TRUE(disturbed.calibration.knows_legs());
  const KinematicErrors& found = disturbed.calibration.errors();
  for (const Leg leg : kLegs) {
    EXPECT_NEAR(found.thigh[index(leg)], forgetful.calibration.errors().thigh[index(leg)], 1e-5);
    EXPECT_NEAR(found.shank[index(leg)], forgetful.calibration.errors().shank[index(leg)], 1e-5);
  }
}

}  // namespace
}  // namespace surefoot::estimation
