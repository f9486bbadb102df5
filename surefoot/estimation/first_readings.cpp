#include "surefoot/estimation/first_readings.hpp"

#include <cmath>

namespace surefoot {
namespace {

constexpr double kUntilTrue = 0.1;     // [s]
constexpr int kBelievedWithin = 3;     // ticks: a jump that the next sample confirms
constexpr double kSameTurn = 0.25;     // a tick after a robot has begun 0.05 was the most [rad/s]
constexpr double kSameVertical = 2.0;  // and 0.7 [m/s²]

}  // namespace

FirstReadings::FirstReadings(double period)
    : ticks_left_(static_cast<int>(std::lround(kUntilTrue / period))) {}

bool FirstReadings::are_contradicted(const SensorReading& reading, bool clock_is_right,
                                     const SensorHealth& health, bool has_begun) noexcept {
  // The same time again is a driver that is dead, and none is no other one.
  const bool is_other_clock =
      !clock_is_right && std::isfinite(reading.time) && reading.time != time_;
  time_ = reading.time;
  if (ticks_left_ == 0) return false;
  if (has_begun) --ticks_left_;
  const bool jumps =
      health.encoders.fault == SampleFault::jump || health.imu.fault == SampleFault::jump;
  jumps_ = jumps ? jumps_ + 1 : 0;
  const bool imu_is_other = imu_contradicts(reading, has_begun);
  return is_other_clock || imu_is_other || jumps_ >= (has_begun ? 1 : kBelievedWithin);
}

// A slow one gives the first again before it gives the second.
bool FirstReadings::imu_contradicts(const SensorReading& reading, bool has_begun) noexcept {
  if (!has_begun) {
    gyro_ = reading.gyro;
    accelerometer_ = reading.accelerometer;
    return false;
  }
  const bool is_complete = reading.gyro.allFinite() && reading.accelerometer.allFinite();
  const bool is_same = reading.gyro == gyro_ && reading.accelerometer == accelerometer_;
  if (!is_complete || is_same) return false;
  const bool is_other = (reading.gyro - gyro_).norm() > kSameTurn ||
                        (reading.accelerometer - accelerometer_).norm() > kSameVertical;
  gyro_ = accelerometer_ = Vec3::Constant(kNaN);  // no third is compared
  return is_other;
}

}  // namespace surefoot
