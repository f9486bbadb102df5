#pragma once

#include "surefoot/estimation/reading_guard.hpp"
#include "tests/support/anymal_b.hpp"

#include <cmath>

namespace surefoot::test {

/// A robot whose joints swing and whose IMU shakes, tick by tick, read through a guard.
struct Swinging {
  static constexpr double kPeriod = 0.0025;  // [s]

  explicit Swinging(int count = 0) { run(count); }

  [[nodiscard]] JointVector angle(double t) const {
    return description.q_nominal +
           JointVector::Constant(kNumLegJoints, amplitude * std::sin(8.0 * t));
  }
  [[nodiscard]] JointVector velocity(double t) const {
    return JointVector::Constant(kNumLegJoints, 8.0 * amplitude * std::cos(8.0 * t));
  }
  [[nodiscard]] SensorReading sample(double t) const {
    SensorReading reading;
    reading.time = reading.encoder_time = reading.torque_time = reading.imu_time = t;
    reading.q = angle(t);
    reading.torque = JointVector::Constant(kNumLegJoints, 20.0 * std::sin(5.0 * t));
    reading.gyro = Vec3(std::sin(7.0 * t), std::cos(7.0 * t), 0.1);
    reading.accelerometer = Vec3(std::cos(9.0 * t), std::sin(9.0 * t), kGravity);
    return reading;
  }
  /// One tick with the reading that a test made of the true one.
  template <typename Change>
  void tick(const Change& change) {
    time = kPeriod * ++ticks;
    SensorReading reading = sample(time);
    change(reading);
    guard.update(reading, velocity(time - 0.5 * kPeriod));
  }
  void run(int count) {
    for (int i = 0; i < count; ++i) tick([](SensorReading&) {});
  }
  [[nodiscard]] bool is_well() const {
    const SensorHealth& health = guard.health();
    return health.encoders.fault == SampleFault::none &&
           health.joint_torques.fault == SampleFault::none && health.imu.fault == SampleFault::none;
  }

  model::RobotDescription description = anymal_b();
  estimation::ReadingGuard guard{{}, description, kPeriod};
  int ticks = 0;
  double time = 0.0;
  double amplitude = 0.3;  // [rad]
};

}  // namespace surefoot::test
