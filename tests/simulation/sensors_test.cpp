#include "surefoot/simulation/sensors.hpp"

#include "tests/simulation/plant_support.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace surefoot::simulation {
namespace {

constexpr double kPeriod = 0.0025;

/// Mean and standard deviation of a series.
struct Statistics {
  void add(double value) {
    ++count;
    sum += value;
    square += value * value;
  }
  [[nodiscard]] double mean() const { return sum / count; }
  [[nodiscard]] double deviation() const { return std::sqrt(square / count - mean() * mean()); }

  int count = 0;
  double sum = 0.0, square = 0.0;
};

GroundTruth some_truth() {
  GroundTruth truth;
  truth.q_SB = Quat(Eigen::AngleAxisd(0.3, Vec3(1.0, 2.0, 0.5).normalized()));
  truth.w_SB_B = Vec3(0.1, -0.2, 0.3);
  for (Eigen::Index i = 0; i < kNumLegJoints; ++i) {
    truth.q[i] = 0.1 * static_cast<double>(i) + 0.0123456;
    truth.torque[i] = static_cast<double>(i);
  }
  truth.feet[2].force = Vec3(3.0, 4.0, 70.0);
  return truth;
}

SensorReading first_reading(const SensorOptions& options, const GroundTruth& truth) {
  Sensors sensors(options, kPeriod, 1);
  SensorReading reading;
  sensors.read(truth, reading);
  return reading;
}

TEST(Sensors, AddNothingWhenTheyAreExactAndFeelGravityAtRest) {
  const GroundTruth truth = some_truth();
  const SensorReading reading = first_reading(test::exact_sensors(), truth);
  EXPECT_EQ(reading.q, truth.q);
  EXPECT_EQ(reading.torque, truth.torque);
  EXPECT_EQ(reading.gyro, truth.w_SB_B);
  const Vec3 up_B = truth.q_SB.conjugate() * Vec3::UnitZ();
  EXPECT_LT((reading.accelerometer - kGravity * up_B).norm(), 1e-12);
  for (const double force : first_reading({}, truth).foot_force) EXPECT_TRUE(std::isnan(force));
}

TEST(Sensors, TheAccelerometerGivesTheMeanSinceItsLastSample) {
  SensorOptions options = test::exact_sensors();
  options.imu.rate_hz = 200.0;  // every second tick
  Sensors sensors(options, kPeriod, 1);
  SensorReading reading;
  sensors.read({}, reading);
  for (const double force : {1.0, 2.0, 3.0, 6.0}) {
    sensors.accumulate(Vec3(force, 0.0, 0.0));
    if (force == 2.0) sensors.read({}, reading);
  }
  sensors.read({}, reading);
  EXPECT_DOUBLE_EQ(reading.accelerometer.x(), 3.0);
}

TEST(Sensors, EncodersGiveTheNearestWholeStep) {
  SensorOptions options = test::exact_sensors();
  options.encoders.resolution = 4.4e-4;
  const GroundTruth truth = some_truth();
  for (Eigen::Index i = 0; i < kNumLegJoints; ++i) {
    const double angle = first_reading(options, truth).q[i];
    EXPECT_NEAR(angle / 4.4e-4, std::round(angle / 4.4e-4), 1e-9);
    EXPECT_LE(std::abs(angle - truth.q[i]), 2.2e-4 + 1e-12);
  }
}

TEST(Sensors, NoiseHasTheChosenDeviations) {
  SensorOptions options;
  options.encoders = {.resolution = 0.0, .noise = 1e-3};
  options.foot_force.present = true;
  options.imu.gyro_bias = options.imu.accelerometer_bias = 0.0;
  Sensors sensors(options, kPeriod, 5);
  const GroundTruth truth = some_truth();
  const Vec3 up_B = truth.q_SB.conjugate() * Vec3::UnitZ();
  Statistics angle, torque, gyro, accelerometer, foot;
  for (int tick = 0; tick < 20000; ++tick) {
    SensorReading reading;
    sensors.read(truth, reading);
    angle.add(reading.q[4] - truth.q[4]);
    torque.add(reading.torque[7] - truth.torque[7]);
    gyro.add(reading.gyro.y() - truth.w_SB_B.y());
    accelerometer.add(reading.accelerometer.z() - kGravity * up_B.z());
    foot.add(reading.foot_force[2] - 70.0);
  }
  const auto expect_white = [](const Statistics& noise, double deviation) {
    EXPECT_NEAR(noise.deviation() / deviation, 1.0, 0.03);
    EXPECT_NEAR(noise.mean() / deviation, 0.0, 0.03);
  };
  expect_white(angle, options.encoders.noise);
  expect_white(torque, options.joint_torques.noise);
  expect_white(gyro, options.imu.gyro_noise);
  expect_white(accelerometer, options.imu.accelerometer_noise);
  expect_white(foot, options.foot_force.noise);
}

TEST(Sensors, BiasesStayConstantInARunAndVaryWithTheSeed) {
  SensorOptions options = test::exact_sensors();
  options.imu.gyro_bias = 1e-3;
  options.imu.accelerometer_bias = 0.08;
  Statistics gyro, accelerometer;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Sensors sensors(options, kPeriod, seed);
    SensorReading first, second;
    sensors.read({}, first);
    sensors.read({}, second);
    EXPECT_EQ(first.gyro, second.gyro);
    EXPECT_EQ(first.accelerometer, second.accelerometer);
    gyro.add(first.gyro.x());
    accelerometer.add(first.accelerometer.y());
  }
  EXPECT_NEAR(gyro.deviation(), 1e-3, 5e-5);
  EXPECT_NEAR(accelerometer.deviation(), 0.08, 4e-3);
  EXPECT_NEAR(gyro.mean(), 0.0, 1e-4);
}

TEST(Sensors, EncodersRoundWhatTheirNoiseMadeOfTheAngle) {
  SensorOptions options = test::exact_sensors();
  options.encoders = {.resolution = 1e-3, .noise = 2e-3};
  Sensors sensors(options, kPeriod, 1);
  GroundTruth truth;
  Statistics steps;
  for (int tick = 0; tick < 20000; ++tick) {
    SensorReading reading;
    sensors.read(truth, reading);
    const double step = reading.q[3] / 1e-3;
    EXPECT_NEAR(step, std::round(step), 1e-9);
    steps.add(step);
  }
  EXPECT_NEAR(steps.deviation(), std::sqrt(2.0 * 2.0 + 1.0 / 12.0), 0.05);
}

/// Truth in which every sensor sees the number of the tick.
GroundTruth counting(int tick) {
  GroundTruth truth;
  truth.q.setConstant(tick);
  truth.torque.setConstant(tick);
  truth.w_SB_B.setConstant(tick);
  for (TrueContact& foot : truth.feet) foot.force = tick * Vec3::UnitZ();
  return truth;
}

TEST(Sensors, EachHaveARateOfTheirOwn) {
  SensorOptions options = test::exact_sensors();
  options.foot_force.present = true;
  options.encoders.rate_hz = 200.0;
  options.joint_torques.rate_hz = 100.0;
  options.imu.rate_hz = 80.0;
  options.foot_force.rate_hz = 50.0;
  Sensors sensors(options, kPeriod, 1);
  SensorReading reading;
  for (int tick = 0; tick < 80; ++tick) {
    sensors.accumulate(Vec3::Constant(tick));
    sensors.read(counting(tick), reading);
    EXPECT_EQ(reading.q[11], tick - tick % 2);
    EXPECT_EQ(reading.torque[5], tick - tick % 4);
    EXPECT_EQ(reading.gyro.y(), tick - tick % 5);
    EXPECT_EQ(reading.accelerometer.z(), tick < 5 ? 0.0 : tick - tick % 5 - 2);  // mean of five
    EXPECT_EQ(reading.foot_force[3], tick - tick % 8);
  }
}

TEST(Sensors, TheNoiseOfOneIsTheSameWhateverTheOthersAre) {
  SensorOptions plain;
  plain.encoders.noise = 1e-3;
  plain.foot_force.present = true;
  const std::vector<std::function<void(SensorOptions&)>> changes{
      [](SensorOptions& o) { o.encoders = {.resolution = 0.1, .noise = 0.0, .rate_hz = 30.0}; },
      [](SensorOptions& o) { o.joint_torques = {.noise = 0.0, .rate_hz = 90.0}; },
      [](SensorOptions& o) {
        o.imu.gyro_noise = o.imu.accelerometer_noise = 0.0;
        o.imu.rate_hz = 70.0;
      },
      [](SensorOptions& o) { o.foot_force.present = false; }};
  for (std::size_t changed = 0; changed < changes.size(); ++changed) {
    SensorOptions options = plain;
    changes[changed](options);
    Sensors first(plain, kPeriod, 8);
    Sensors second(options, kPeriod, 8);
    for (int tick = 0; tick < 50; ++tick) {
      SensorReading a, b;
      first.read(some_truth(), a);
      second.read(some_truth(), b);
      const std::array<bool, 4> same{a.q == b.q, a.torque == b.torque,
                                     a.gyro == b.gyro && a.accelerometer == b.accelerometer,
                                     a.foot_force == b.foot_force};
      for (std::size_t sensor = 0; sensor < same.size(); ++sensor) {
        EXPECT_EQ(same[sensor], sensor != changed) << sensor << " where " << changed << " changed";
      }
    }
  }
}

TEST(Sensors, AtARateThatDoesNotDivideTheControlRateSamplesKeepTheirMeanRate) {
  SensorOptions options = test::exact_sensors();
  options.encoders.rate_hz = 150.0;
  Sensors sensors(options, kPeriod, 1);
  SensorReading reading;
  int samples = 0;
  for (int tick = 0; tick < 400; ++tick) {
    GroundTruth truth;
    truth.q.setConstant(tick);
    sensors.read(truth, reading);
    samples += reading.q[0] == tick ? 1 : 0;
  }
  EXPECT_EQ(samples, 150);
}

TEST(Sensors, OneOfAFallingPlantFeelsNoWeight) {
  Plant plant(test::anymal_b(), test::falling_options());
  for (int tick = 0; tick < 4; ++tick) plant.write({});
  // The base swings a little about the whole robot's centre of mass as the legs start to move: none
  // of that without torques.
  EXPECT_LT(plant.read().accelerometer.norm(), 1e-6);
}

TEST(Sensors, TheIntegralOfAPlantsAccelerometerIsItsChangeOfVelocity) {
  PlantOptions options = test::standing_options();
  options.initial.position.z() = 0.55;  // drops 5 cm and hits the ground
  options.initial.yaw = 0.7;
  options.disturbances.pushes = {{"", 0.05, 0.2, Vec3(80.0, 30.0, 0.0)}};
  test::HeldRobot robot(options);
  Vec3 v_SB = Vec3::Zero();
  double largest = 0.0;
  for (int tick = 0; tick < 120; ++tick) {
    const Quat q_before = robot.truth().q_SB;
    robot.tick();
    const Quat q_mean = q_before.slerp(0.5, robot.truth().q_SB);
    v_SB += kPeriod * (q_mean * robot.plant.read().accelerometer - Vec3(0.0, 0.0, kGravity));
    largest = std::max(largest, robot.plant.read().accelerometer.norm());
  }
  EXPECT_GT(largest, 30.0);
  EXPECT_LT((v_SB - robot.truth().v_SB).norm(), 2e-3);
}

TEST(Sensors, APlantsGyroGivesTheAngularVelocityInTheBaseFrame) {
  PlantOptions options = test::falling_options();
  options.disturbances.pushes = {{"LF_HIP", 0.0, 0.1, Vec3(0.0, 0.0, 50.0)}};
  Plant plant(test::anymal_b(), options);
  for (int tick = 0; tick < 80; ++tick) plant.write({});
  EXPECT_GT(plant.truth().w_SB_B.norm(), 0.5);
  EXPECT_EQ(plant.read().gyro, plant.truth().w_SB_B);
}

TEST(Sensors, APlantsFootForceSensorReadsItsNormalForce) {
  PlantOptions options = test::standing_options();
  options.sensors.foot_force.present = true;
  test::HeldRobot robot(options);
  robot.run(0.5);
  double sum = 0.0;
  for (const double force : robot.plant.read().foot_force) sum += force;
  EXPECT_NEAR(sum, test::kMass * kGravity, 0.01 * test::kMass * kGravity);
}

TEST(Sensors, EncodersHaveTheirZerosWhereTheyWereSet) {
  SensorOptions options = test::exact_sensors();
  options.encoders.offset.setLinSpaced(-0.005, 0.006);
  const GroundTruth truth = some_truth();
  EXPECT_LT((first_reading(options, truth).q - truth.q - options.encoders.offset).norm(), 1e-12);
}

TEST(Sensors, ATiltedImuMeasuresAlongItsOwnAxes) {
  SensorOptions options = test::exact_sensors();
  options.imu.tilt = Vec3(0.02, -0.03, 0.05);
  const GroundTruth truth = some_truth();
  const SensorReading reading = first_reading(options, truth);
  const Mat3 R_BI =
      (Eigen::AngleAxisd(0.05, Vec3::UnitZ()) * Eigen::AngleAxisd(-0.03, Vec3::UnitY()) *
       Eigen::AngleAxisd(0.02, Vec3::UnitX()))
          .toRotationMatrix();
  EXPECT_LT((R_BI * reading.gyro - truth.w_SB_B).norm(), 1e-12);
  const Vec3 force_B = kGravity * (truth.q_SB.conjugate() * Vec3::UnitZ());
  EXPECT_LT((R_BI * reading.accelerometer - force_B).norm(), 1e-12);
}

TEST(Sensors, BiasesWanderSlowlyFromZeroToTheirLongRunDeviation) {
  SensorOptions options = test::exact_sensors();
  options.imu.gyro_drift = 1e-3;
  options.imu.gyro_drift_time = 1.0;
  options.imu.accelerometer_drift = 0.05;
  options.imu.accelerometer_drift_time = 0.5;
  Sensors sensors(options, kPeriod, 3);
  const GroundTruth truth;
  SensorReading reading;
  sensors.read(truth, reading);
  EXPECT_LT((reading.gyro - truth.w_SB_B).norm(), 5e-4);
  Statistics gyro, change, accelerometer;
  for (int tick = 0; tick < 400'000; ++tick) {
    const double before = reading.gyro.x();
    sensors.read(truth, reading);
    gyro.add(reading.gyro.x());
    change.add(reading.gyro.x() - before);
    accelerometer.add(reading.accelerometer.y());
  }
  EXPECT_NEAR(gyro.deviation() / 1e-3, 1.0, 0.1);
  EXPECT_NEAR(accelerometer.deviation() / 0.05, 1.0, 0.1);
  // In a step it goes by σ √(2 h / T).
  EXPECT_NEAR(change.deviation() / (1e-3 * std::sqrt(2.0 * kPeriod)), 1.0, 0.02);
}

TEST(Sensors, SayWhenTheyTookTheirSamples) {
  SensorOptions options = test::exact_sensors();
  options.imu.rate_hz = 100.0;
  options.encoders.rate_hz = 200.0;
  Sensors sensors(options, kPeriod, 1);
  SensorReading reading;
  GroundTruth truth;
  for (int tick = 0; tick < 9; ++tick) {
    truth.time = tick * kPeriod;
    sensors.read(truth, reading);
    EXPECT_NEAR(reading.imu_time, tick / 4 * 4 * kPeriod, 1e-12) << tick;
    EXPECT_NEAR(reading.encoder_time, tick / 2 * 2 * kPeriod, 1e-12) << tick;
    EXPECT_EQ(reading.torque_time, truth.time) << tick;
  }
}

}  // namespace
}  // namespace surefoot::simulation
