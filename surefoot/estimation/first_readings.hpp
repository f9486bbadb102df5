#pragma once

#include "surefoot/signals/sensor_health.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot {

/// Watches whether what a robot began with was true.
///
/// The first reading has none before it to be held against: it may be a driver's zeros, or its
/// clock another's. Where a later one contradicts it nobody knows which is right, and what began
/// with it (base, feet, plan) is worth nothing. So until 0.1 s after the estimate has begun
/// encoders or IMU that jump, or a clock that leaps or goes back, say that it is to begin anew; and
/// so does the IMU's second sample, if it is further from the first than of a robot that stands:
/// by more than 2 m/s² or 0.25 rad/s. Before, only jumps that the guard does not come to believe
/// do: nothing has been begun, and how fast the joints turn is not known yet.
class FirstReadings {
 public:
  /// `period` of the control loop [s].
  explicit FirstReadings(double period);

  /// One tick: the reading as it came, whether the guard believes its clock, and what it says of
  /// the rest. `has_begun`: the estimate has. True: begin anew, with this reading as the
  /// first.
  [[nodiscard]] bool are_contradicted(const SensorReading& reading, bool clock_is_right,
                                      const SensorHealth& health, bool has_begun) noexcept;

 private:
  [[nodiscard]] bool imu_contradicts(const SensorReading& reading, bool has_begun) noexcept;

  int ticks_left_;
  int jumps_ = 0;       // in a row
  double time_ = kNaN;  // of the reading before [s]
  // Of the IMU's sample that it has begun with, while there is no second one [rad/s], [m/s²].
  Vec3 gyro_ = Vec3::Constant(kNaN), accelerometer_ = Vec3::Constant(kNaN);
};

}  // namespace surefoot
