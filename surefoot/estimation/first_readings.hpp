#pragma once

#include "surefoot/signals/sensor_health.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot::estimation {

/// Watches whether the first readings were true.
///
/// Nothing precedes the first reading to check it: it may be a driver's zeros, or carry another
/// clock. If a later reading contradicts it, either may be wrong, and everything derived from the
/// first (base, feet, plan) is worthless. So the robot restarts with the later reading as the
/// first. The watch ends 0.1 s after the estimate begins, or 1 s after the first tick.
/// Contradictions are
///
/// - a clock that leaps or goes back;
/// - a jump of encoders or IMU within 20 ms, or after a gap. Later, a single jump or a failure is a
///   fault of the sensor, not of the first reading;
/// - an IMU sample within 20 ms that differs from the one before by more than a standing robot's:
///   3 m/s² or 0.15 rad/s.
///
/// Before the estimate begins joint velocities are unknown. Then only the first jumps after a
/// restart count, or those that the guard keeps refusing.
class FirstReadings {
 public:
  /// `period` of the control loop [s].
  explicit FirstReadings(double period);

  /// One tick: the raw reading, whether the guard accepts its clock, and the guard's verdict on the
  /// rest; `estimates`: a base estimate exists. True: restart, with this reading as the first.
  [[nodiscard]] bool are_contradicted(const SensorReading& reading, bool clock_is_right,
                                      const SensorHealth& health, bool estimates) noexcept;

 private:
  /// Of encoders or IMU.
  struct Sensor {
    double time = kNaN;       // of the last sample [s]
    int jumps = 0;            // of samples in a row
    bool was_missed = false;  // the sample before was faulty
  };

  [[nodiscard]] bool jumps(Sensor& sensor, double sample_time, SampleFault fault, bool estimates);
  [[nodiscard]] bool imu_differs(const SensorReading& reading, bool estimates);
  void restart();

  int window_, jump_window_;  // [ticks]
  int ticks_left_;            // of the window
  int ticks_left_in_all_;     // of the second
  int age_ = 0;               // since the last restart [ticks]
  int num_restarts_ = 0;
  double time_ = kNaN;  // of the reading before [s]
  Sensor encoders_, imu_;
  // The IMU's last complete sample [rad/s], [m/s²].
  Vec3 gyro_ = Vec3::Constant(kNaN), accelerometer_ = Vec3::Constant(kNaN);
};

}  // namespace surefoot::estimation
