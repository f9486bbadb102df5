#include "surefoot/estimation/first_readings.hpp"

#include <gtest/gtest.h>

namespace surefoot::estimation {
namespace {

constexpr double kPeriod = 0.0025;  // [s]
constexpr int kWindow = 40;         // ticks of an estimate in which the first readings are doubted
constexpr int kYoung = 8;           // … and in which a single jump says that
constexpr int kLongest = 400;       // since the first tick

/// Of a robot that stands.
SensorReading at(double time) {
  SensorReading reading;
  reading.time = reading.encoder_time = reading.imu_time = time;
  reading.gyro = Vec3(0.01, -0.02, 0.005);
  reading.accelerometer = Vec3(0.3, -0.2, kGravity);
  return reading;
}

SensorHealth encoders(SampleFault fault) {
  SensorHealth health;
  health.encoders.fault = fault;
  return health;
}

SensorHealth imu(SampleFault fault) {
  SensorHealth health;
  health.imu.fault = fault;
  return health;
}

/// The first readings of a robot, tick by tick, behind as many healthy ones.
struct Beginning {
  explicit Beginning(int without_estimate = 0, int with_one = 0) {
    run(without_estimate, false);
    run(with_one);
  }
  FirstReadings readings{kPeriod};
  double time = 0.0;

  bool tick(const SensorHealth& health = {}, bool estimates = true) {
    return tick_with(at(time), health, estimates);
  }
  bool tick_with(const SensorReading& reading, const SensorHealth& health = {},
                 bool estimates = true) {
    time += kPeriod;
    return readings.are_contradicted(reading, true, health, estimates);
  }
  /// Healthy ones.
  void run(int ticks, bool estimates = true) {
    for (int i = 0; i < ticks; ++i) EXPECT_FALSE(tick({}, estimates)) << time;
  }
};

TEST(FirstReadings, AreContradictedByEncodersOrImuThatJumpWithin20Ms) {
  for (const SensorHealth& health : {encoders(SampleFault::jump), imu(SampleFault::jump)}) {
    for (const int good : {1, 2, kYoung, kYoung + 1, kWindow - 1}) {
      Beginning beginning(1, good - 1);
      EXPECT_EQ(beginning.tick(health), good <= kYoung) << good;
    }
  }
}

TEST(FirstReadings, AreContradictedByWhatJumpsBehindAGap) {
  for (const SampleFault gap : {SampleFault::silent, SampleFault::not_a_number}) {
    for (const int good : {kYoung + 5, kWindow - 3, kWindow}) {
      Beginning beginning(1, good - 1);
      EXPECT_FALSE(beginning.tick(encoders(gap)));
      EXPECT_EQ(beginning.tick(encoders(SampleFault::jump)), good < kWindow) << good;
    }
  }
}

TEST(FirstReadings, AreNotContradictedByWhatSaysNothingOfThem) {
  for (const SampleFault fault :
       {SampleFault::not_a_number, SampleFault::silent, SampleFault::late, SampleFault::repeats}) {
    Beginning beginning(1);
    SensorHealth health = encoders(fault);
    health.imu.fault = health.joint_torques.fault = fault;
    EXPECT_FALSE(beginning.tick(health));
  }
  Beginning beginning(1);
  SensorHealth torques;  // which jump where a robot comes to stand
  torques.joint_torques.fault = SampleFault::jump;
  EXPECT_FALSE(beginning.tick(torques));
}

TEST(FirstReadings, AreContradictedByAnotherClock) {
  for (const bool estimates : {false, true}) {
    FirstReadings readings(kPeriod);
    EXPECT_FALSE(readings.are_contradicted(at(1.0), true, {}, false));
    EXPECT_FALSE(readings.are_contradicted(at(1.0), false, {}, estimates)) << "is dead";
    EXPECT_FALSE(readings.are_contradicted(at(kNaN), false, {}, estimates)) << "has no clock";
    EXPECT_TRUE(readings.are_contradicted(at(0.0), false, {}, estimates));
    EXPECT_FALSE(readings.are_contradicted(at(0.0), false, {}, false)) << "is dead since";
  }
}

// Among 320 correct starts 0.085 rad/s and 2.1 m/s² were the largest steps.
TEST(FirstReadings, AreNotContradictedByAnImuThatSaysNearlyTheSame) {
  for (const double share : {0.95, 1.05}) {
    SensorReading turned = at(0.0), lifted = at(0.0);
    turned.gyro.z() += share * 0.15;
    lifted.accelerometer.z() += share * 3.0;
    for (const SensorReading& second : {turned, lifted}) {
      Beginning beginning;
      EXPECT_FALSE(beginning.tick_with(at(0.0), {}, false));
      EXPECT_EQ(beginning.tick_with(second), share > 1.0) << share;
    }
  }
}

TEST(FirstReadings, AreContradictedByAnImuThatSaysSomethingElse) {
  SensorReading turned = at(0.0), lying = at(0.0);
  turned.gyro.z() += 0.2;
  lying.accelerometer = lying.accelerometer.reverse().eval();  // as long, elsewhere
  for (const SensorReading& first : {turned, lying}) {
    for (const bool is_wrong : {false, true}) {
      Beginning beginning;
      EXPECT_FALSE(beginning.tick_with(is_wrong ? first : at(0.0), {}, false));
      EXPECT_FALSE(beginning.tick_with(is_wrong ? first : at(0.0))) << "a slow one";
      SensorReading missing = at(2.0 * kPeriod);
      missing.gyro.x() = kNaN;
      EXPECT_FALSE(beginning.tick_with(missing)) << "is not the second";
      EXPECT_TRUE(beginning.tick_with(is_wrong ? at(0.0) : first));
      EXPECT_TRUE(beginning.tick_with(is_wrong ? first : at(0.0))) << "again";
    }
  }
}

TEST(FirstReadings, OfAnImuTheyAreContradictedWithin20Ms) {
  SensorReading lying = at(0.0);
  lying.accelerometer = lying.accelerometer.reverse().eval();
  for (const int good : {kYoung, kYoung + 1}) {
    Beginning beginning(1, good - 1);
    EXPECT_EQ(beginning.tick_with(lying), good <= kYoung) << good;
  }
}

TEST(FirstReadings, AreNotContradictedByARobotThatGetsToMove) {
  Beginning beginning(1);
  for (int i = 1; i < 20; ++i) {
    SensorReading reading = at(i * kPeriod);
    reading.gyro.x() += 0.05 * i;
    reading.accelerometer.z() -= 0.5 * i;
    EXPECT_FALSE(beginning.tick_with(reading)) << i;
  }
}

// Joint velocities are unknown yet, so correct angles may jump.
TEST(FirstReadings, BeforeTheEstimateSaysTheSecondReadingSoOrWhatIsNotBelieved) {
  Beginning beginning(1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(beginning.tick(encoders(SampleFault::jump), false)) << "against the first";
  }
  for (int again = 0; again < 2; ++again) {
    EXPECT_FALSE(beginning.tick(encoders(SampleFault::jump), false));
    EXPECT_FALSE(beginning.tick(encoders(SampleFault::jump), false));
    EXPECT_TRUE(beginning.tick(encoders(SampleFault::jump), false));
  }
  EXPECT_FALSE(beginning.tick(encoders(SampleFault::jump), false));
  EXPECT_FALSE(beginning.tick(encoders(SampleFault::jump), false));
  EXPECT_FALSE(beginning.tick({}, false)) << "it came to be believed";
  EXPECT_FALSE(beginning.tick(encoders(SampleFault::jump), false));
}

TEST(FirstReadings, ASampleThatIsHeldJumpsOnce) {
  Beginning beginning(2);
  const SensorReading sample = at(beginning.time);
  for (int held = 0; held < 8; ++held) {
    EXPECT_FALSE(beginning.tick_with(sample, imu(SampleFault::jump), false)) << held;
  }
}

TEST(FirstReadings, AreNotDoubtedForEver) {
  Beginning beginning(1);
  int contradicted = 0;
  for (int tick = 1; tick < 2 * kLongest; ++tick) {
    if (!beginning.tick(encoders(tick % 5 == 0 ? SampleFault::jump : SampleFault::none))) continue;
    ++contradicted;
    EXPECT_LT(tick, kLongest);
  }
  EXPECT_GT(contradicted, 70);
}

}  // namespace
}  // namespace surefoot::estimation
