#include "surefoot/estimation/imu_check.hpp"

#include "surefoot/math/rotation.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace surefoot::estimation {
namespace {

using test::Random;

constexpr double kPeriod = 0.0025;
constexpr double kRadius = 0.03;
const Vec3 kUp = Vec3::UnitZ();

/// A base that sways over four feet, whose spheres roll as the shanks turn with it; read without
/// noise.
struct Swaying {
  explicit Swaying(double duration = 0.0, unsigned seed = 1) {
    Random random(seed);
    way = random.vector(0.05);
    turn = random.vector(0.1);
    for (const Leg leg : kLegs) {
      foot[index(leg)] = {is_front(leg) ? 0.33 : -0.33, is_left(leg) ? 0.22 : -0.22, kRadius};
      state.foot_force[index(leg)] = 75.0 * kUp;
    }
    dynamics.mass = kNumLegs * 75.0 / kGravity;
    tick();
    run(duration);
  }

  [[nodiscard]] Vec3 position(double t) const {
    return 0.46 * kUp + 0.2 * t * Vec3::UnitX() + way * std::sin(9.0 * t);
  }
  [[nodiscard]] Mat3 orientation(double t) const {
    return exp_rotation(turn * std::sin(7.0 * t)).toRotationMatrix();
  }

  void tick() {
    const double t = kPeriod * ++ticks, before = t - kPeriod;
    const Mat3 R = orientation(t), R_mean = orientation(t - 0.5 * kPeriod);
    state.time = reading.time = reading.encoder_time = reading.imu_time = t;
    state.q_WB = Quat(R);
    dynamics.base.p = position(t);
    for (const Leg leg : kLegs) {
      const std::size_t k = index(leg);
      const Vec3 angle = log_rotation(Quat(Mat3(R * orientation(before).transpose())));
      foot[k] += angle.cross(kRadius * kUp) + kPeriod * slip[k];
      dynamics.foot[k].p = foot[k];
      dynamics.contact[k].p = foot[k] - kRadius * kUp;
      dynamics.shank[k].R = R;
    }
    const Mat3 turned = R_mean.transpose() * orientation(t + 0.5 * kPeriod);
    const Vec3 rate = log_rotation(Quat(turned)) / kPeriod;
    const Vec3 v = (position(t + kPeriod) - position(t)) / kPeriod;
    const Vec3 v_before = (position(t) - position(before)) / kPeriod;
    reading.gyro = rate + gyro_error;
    reading.accelerometer =
        R_mean.transpose() * ((v - v_before) / kPeriod + kGravity * kUp) + accelerometer_error;
    check.update(reading, state, dynamics, stands, kUp);
  }
  void run(double duration) {
    for (int i = 0; i < std::lround(duration / kPeriod); ++i) tick();
  }
  /// Until the IMU is found to be wrong, at most a second.
  double time_until_found() {
    const double begin = state.time;
    while (check.wrong_for() == 0.0 && state.time < begin + 1.0) tick();
    return state.time - begin;
  }
  [[nodiscard]] double worst() const { return *std::ranges::max_element(check.shares()); }

  ImuCheck check{ImuCheckOptions{}, kPeriod};
  model::Dynamics dynamics;
  RobotState state;
  SensorReading reading;
  PerLeg<bool> stands{true, true, true, true};
  PerLeg<Vec3> foot{}, slip{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  Vec3 way = Vec3::Zero(), turn = Vec3::Zero();
  Vec3 gyro_error = Vec3::Zero(), accelerometer_error = Vec3::Zero();
  int ticks = 0;
};

TEST(ImuCheck, HoweverTheBaseMovesAnImuThatIsRightAgreesWithTheFeet) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Swaying robot(0.0, seed);
    for (int i = 0; i < 400; ++i) {
      robot.tick();
      ASSERT_LT(robot.worst(), 0.15) << seed;
    }
  }
}

TEST(ImuCheck, AnAccelerometerThatIsOffIsFoundTheSoonerTheMoreItIs) {
  for (const Vec3& axis : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, -1.0, 0.0), Vec3(0.0, 0.0, 1.0)}) {
    double sooner = 0.25;
    for (const double error : {1.0, 3.0, 10.0, 30.0, 100.0}) {
      Swaying robot(0.5);
      robot.accelerometer_error = error * axis;
      const double time = robot.time_until_found();
      EXPECT_LE(time, sooner) << error;
      sooner = time;
    }
    EXPECT_LE(sooner, 0.02) << "100 m/s²";
  }
}

TEST(ImuCheck, WhatAnAccelerometerIsOffByIsADisplacementOfAQuarterOfTheSpanSquared) {
  const ImuCheckOptions options{.doubt = 0.0};
  Swaying robot;
  robot.check = ImuCheck(options, kPeriod);
  robot.run(0.5);
  robot.accelerometer_error = {0.0, 2.0, 0.0};
  robot.run(0.5);
  const std::array<double, ImuCheck::kNumSpans> spans{0.02, 0.05, 0.1, 0.2};
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const double allowed = options.position_margin + options.velocity_margin * spans[i];
    const double expected = 2.0 * std::pow(0.5 * spans[i], 2);
    EXPECT_NEAR(robot.check.shares()[i] * allowed, expected, 0.03 * expected + 2e-4) << i;
  }
}

TEST(ImuCheck, AGyroscopeThatIsOffAboutAnyAxisIsFound) {
  for (const Vec3& axis : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, -1.0)}) {
    for (const double error : {0.1, 0.3, 1.0}) {
      Swaying robot(0.5);
      robot.gyro_error = error * axis;
      EXPECT_LE(robot.time_until_found(), 0.25) << error;
    }
    Swaying robot;
    robot.gyro_error = 0.05 * axis;
    robot.run(0.5);
    const ImuCheckOptions options;
    const double turned = 0.05 * options.window;
    const double allowed = options.turn_margin + options.rate_margin * options.window;
    EXPECT_NEAR(robot.check.shares()[3] * allowed, turned, 0.05 * turned + 2e-4);
  }
}

TEST(ImuCheck, AFootThatSlidesIsNoFaultOfTheImu) {
  for (const Leg leg : kLegs) {
    Swaying robot(0.5);
    robot.slip[index(leg)] = {0.05, -0.08, 0.0};
    EXPECT_GT(robot.time_until_found(), 0.99);
  }
}

TEST(ImuCheck, AFootOfThreeThatDropsOffAnEdgeIsNoFaultOfTheImu) {
  for (const Leg leg : {Leg::LF, Leg::RF, Leg::LH}) {
    Swaying robot;
    robot.stands[index(Leg::RH)] = false;
    robot.run(0.5);
    for (const double speed : {-0.1, -0.3, -0.6}) {
      robot.slip[index(leg)] = speed * kUp;
      for (int i = 0; i < 30; ++i) {
        robot.tick();
        ASSERT_EQ(robot.check.wrong_for(), 0.0)
            << kLegNames[index(leg)] << " " << speed << " " << i;
      }
    }
  }
}

TEST(ImuCheck, ABlowThatASampleCatchesOnlyAPartOfIsNoFaultOfTheImu) {
  for (const double missed : {-60.0, -20.0, 20.0, 60.0}) {  // m/s²
    Swaying robot(0.5);
    robot.accelerometer_error = missed * kUp;
    robot.tick();
    robot.accelerometer_error.setZero();
    EXPECT_GT(robot.time_until_found(), 0.99) << missed;
  }
}

TEST(ImuCheck, FeetThatDoNotStandOrHardlyCarrySayNothing) {
  Swaying robot(0.5);
  robot.stands[0] = false;
  robot.state.foot_force[1] = 10.0 * kUp;
  robot.gyro_error = {1.0, 1.0, 1.0};
  EXPECT_GT(robot.time_until_found(), 0.99);
  robot.state.foot_force[1] = 75.0 * kUp;
  EXPECT_LE(robot.time_until_found(), 0.1) << "from now on three stand";
}

// Feet then lift off before their forces show it.
TEST(ImuCheck, WhileTheRobotIsThrownNothingIsSaid) {
  for (const double share : {0.2, 2.0}) {
    Swaying robot(0.5);
    for (Vec3& force : robot.state.foot_force) force *= share;
    robot.accelerometer_error = {0.0, 3.0, 0.0};
    EXPECT_GT(robot.time_until_found(), 0.99) << share;
    for (Vec3& force : robot.state.foot_force) force /= share;
    EXPECT_LE(robot.time_until_found(), 0.3) << "it stands again";
  }
  Swaying tumbling(0.5);
  tumbling.gyro_error = {1.5, 0.0, 0.0};
  tumbling.accelerometer_error = {0.0, 0.0, 8.0};
  EXPECT_GT(tumbling.time_until_found(), 0.99) << "as both instruments feel";
}

TEST(ImuCheck, AGapOrAReadingWithoutNumbersBeginsAnew) {
  for (const bool is_gap : {true, false}) {
    Swaying robot(0.5);
    if (is_gap) {
      robot.ticks += 40;
    } else {
      robot.gyro_error.setConstant(kNaN);
      robot.tick();
      robot.gyro_error.setZero();
    }
    for (int i = 0; i < 200; ++i) {
      robot.tick();
      ASSERT_EQ(robot.check.wrong_for(), 0.0) << i;
    }
    robot.gyro_error = {0.0, 0.0, 0.3};
    EXPECT_LE(robot.time_until_found(), 0.25);
  }
}

}  // namespace
}  // namespace surefoot::estimation
