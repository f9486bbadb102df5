#pragma once

#include "surefoot/signals/sensor_health.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot {

/// Watches whether what a robot began with was true.
///
/// The first reading has none before it to be held against: it may be a driver's zeros, or its
/// clock another's. Where a later one contradicts it nobody knows which is right, and what began
/// with it (base, feet, plan) is worth nothing: the robot is to begin anew, with the later one as
/// the first. Contradicted it is until 0.1 s after the estimate has begun, and 1 s after the first
/// tick at most, by
///
/// - a clock that leaps or goes back;
/// - encoders or IMU that jump within 20 ms, or behind a gap. Later, what has been right for so
///   long is not doubted for a sample, nor for a sensor that has failed;
/// - a sample of the IMU within 20 ms that is further from the one before than of a robot that
///   stands: by more than 3 m/s² or 0.15 rad/s.
///
/// Before the estimate has begun nobody knows how fast the joints turn, and only the first jumps
/// after a beginning say so, or those that the guard does not come to believe.
class FirstReadings {
 public:
  /// `period` of the control loop [s].
  explicit FirstReadings(double period);

  /// One tick: the reading as it came, whether the guard believes its clock, and what it says of
  /// the rest; `estimates`: there is an estimate of the base. True: begin anew, with this reading
  /// as the first.
  [[nodiscard]] bool are_contradicted(const SensorReading& reading, bool clock_is_right,
                                      const SensorHealth& health, bool estimates) noexcept;

 private:
  /// Of encoders or IMU.
  struct Sensor {
    double time = kNaN;       // of the last sample [s]
    int jumps = 0;            // of samples in a row
    bool was_missed = false;  // the sample before
  };

  [[nodiscard]] bool jumps(Sensor& sensor, double sample_time, SampleFault fault, bool estimates);
  [[nodiscard]] bool imu_differs(const SensorReading& reading, bool estimates);
  void begin_anew();

  int window_, young_;     // [ticks]
  int ticks_left_;         // of the window
  int ticks_left_in_all_;  // of the second
  int age_ = 0;            // of what was begun with [ticks]
  int times_begun_anew_ = 0;
  double time_ = kNaN;  // of the reading before [s]
  Sensor encoders_, imu_;
  // The IMU's last whole sample [rad/s], [m/s²].
  Vec3 gyro_ = Vec3::Constant(kNaN), accelerometer_ = Vec3::Constant(kNaN);
};

}  // namespace surefoot
