#include "surefoot/estimation/first_readings.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

constexpr double kPeriod = 0.0025;  // [s]
constexpr int kTicks = 40;          // for which the first readings can be contradicted

/// Of a robot that stands.
SensorReading at(double time) {
  SensorReading reading;
  reading.time = time;
  reading.gyro = Vec3(0.01, -0.02, 0.005);
  reading.accelerometer = Vec3(0.3, -0.2, kGravity);
  return reading;
}

SensorHealth encoders_jump() {
  SensorHealth health;
  health.encoders.fault = SampleFault::jump;
  return health;
}

SensorHealth imu_jumps() {
  SensorHealth health;
  health.imu.fault = SampleFault::jump;
  return health;
}

TEST(FirstReadings, AreContradictedByEncodersOrImuThatJump) {
  FirstReadings readings(kPeriod);
  EXPECT_FALSE(readings.are_contradicted(at(0.0), true, {}, true));
  EXPECT_TRUE(readings.are_contradicted(at(kPeriod), true, encoders_jump(), true));
  EXPECT_TRUE(readings.are_contradicted(at(2.0 * kPeriod), true, imu_jumps(), true));
}

TEST(FirstReadings, AreNotContradictedByWhatSaysNothingOfThem) {
  FirstReadings readings(kPeriod);
  for (const SampleFault fault :
       {SampleFault::not_a_number, SampleFault::silent, SampleFault::late, SampleFault::repeats}) {
    SensorHealth health;
    health.encoders.fault = health.imu.fault = health.joint_torques.fault = fault;
    EXPECT_FALSE(readings.are_contradicted(at(0.0), true, health, true));
  }
  SensorHealth torques;  // which jump where a robot comes to stand
  torques.joint_torques.fault = SampleFault::jump;
  EXPECT_FALSE(readings.are_contradicted(at(0.0), true, torques, true));
}

TEST(FirstReadings, AreContradictedByAnotherClock) {
  FirstReadings readings(kPeriod);
  EXPECT_FALSE(readings.are_contradicted(at(1.0), true, {}, true));
  EXPECT_FALSE(readings.are_contradicted(at(1.0), false, {}, true)) << "a driver that is dead";
  EXPECT_FALSE(readings.are_contradicted(at(kNaN), false, {}, true)) << "no clock";
  EXPECT_TRUE(readings.are_contradicted(at(0.0), false, {}, true));
}

TEST(FirstReadings, AreContradictedByAnImuThatSaysSomethingElse) {
  SensorReading turned = at(0.0), lying = at(0.0);
  turned.gyro.z() += 0.3;
  lying.accelerometer = lying.accelerometer.reverse().eval();  // as long, elsewhere
  for (const SensorReading& first : {turned, lying}) {
    FirstReadings readings(kPeriod);
    EXPECT_FALSE(readings.are_contradicted(first, true, {}, false));
    EXPECT_FALSE(readings.are_contradicted(first, true, {}, true)) << "a slow one";
    EXPECT_TRUE(readings.are_contradicted(at(2.0 * kPeriod), true, {}, true));
  }
}

TEST(FirstReadings, AreNotContradictedByARobotThatGetsToMove) {
  FirstReadings readings(kPeriod);
  EXPECT_FALSE(readings.are_contradicted(at(0.0), true, {}, false));
  EXPECT_FALSE(readings.are_contradicted(at(kPeriod), true, {}, true)) << "the same sample again";
  for (int i = 2; i < 20; ++i) {
    SensorReading reading = at(i * kPeriod);
    reading.gyro.x() += 0.1 * i;
    reading.accelerometer.z() -= 0.5 * i;
    EXPECT_FALSE(readings.are_contradicted(reading, true, {}, true)) << i;
  }
}

TEST(FirstReadings, AreNotContradictedAnyMoreOnceTheRobotHasBeenControlledFor100Ms) {
  FirstReadings readings(kPeriod);
  for (int i = 0; i < 10 * kTicks; ++i) {
    EXPECT_EQ(readings.are_contradicted(at(i * kPeriod), true, imu_jumps(), false), i >= 2)
        << "waits";
  }
  for (int i = 0; i < kTicks; ++i) {
    EXPECT_TRUE(readings.are_contradicted(at(1.0 + i * kPeriod), true, encoders_jump(), true));
  }
  EXPECT_FALSE(readings.are_contradicted(at(2.0), true, encoders_jump(), true));
  EXPECT_FALSE(readings.are_contradicted(at(0.0), false, {}, true));
}

}  // namespace
}  // namespace surefoot
