#include "surefoot/estimation/first_readings.hpp"

#include "surefoot/estimation/reading_guard_options.hpp"

#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kWindow = 0.1;                                        // of an estimate [s]
constexpr double kMaxWindow = 1.0;                                     // since the first tick [s]
constexpr double kJumpWindow = ReadingGuardOptions::kLongestPatience;  // [s]
constexpr int kUnconfirmedJumps = 3;   // in a row: the second would confirm the first
constexpr int kMaxRestartsByJump = 3;  // by one jump, without known velocities
constexpr double kMaxTurnStep = 0.15;  // of a standing robot [rad/s]
constexpr double kMaxForceStep = 3.0;  // of a standing robot [m/s²]

int ticks_in(double time, double period) { return static_cast<int>(std::lround(time / period)); }

}  // namespace

FirstReadings::FirstReadings(double period)
    : window_(ticks_in(kWindow, period)),
      jump_window_(ticks_in(kJumpWindow, period)),
      ticks_left_(window_),
      ticks_left_in_all_(ticks_in(kMaxWindow, period)) {}

bool FirstReadings::are_contradicted(const SensorReading& reading, bool clock_is_right,
                                     const SensorHealth& health, bool estimates) noexcept {
  // A repeated time means a dead driver, and a missing one is no other clock.
  const bool is_other_clock =
      !clock_is_right && std::isfinite(reading.time) && reading.time != time_;
  time_ = reading.time;
  if (ticks_left_ == 0 || ticks_left_in_all_ == 0) return false;
  if (estimates) --ticks_left_;
  --ticks_left_in_all_;
  const bool encoders_jump =
      jumps(encoders_, reading.encoder_time, health.encoders.fault, estimates);
  const bool imu_jumps = jumps(imu_, reading.imu_time, health.imu.fault, estimates);
  const bool is_other_imu = imu_differs(reading, estimates);
  ++age_;
  const bool contradicted = is_other_clock || encoders_jump || imu_jumps || is_other_imu;
  if (contradicted) restart();
  return contradicted;
}

// A held sample is no evidence; a NaN time counts as new.
bool FirstReadings::jumps(Sensor& sensor, double sample_time, SampleFault fault, bool estimates) {
  const bool is_new = sample_time != sensor.time;
  const bool is_after_gap = sensor.was_missed;
  sensor.was_missed = fault != SampleFault::none && fault != SampleFault::jump;
  if (!is_new) return false;
  sensor.time = sample_time;
  sensor.jumps = fault == SampleFault::jump ? sensor.jumps + 1 : 0;
  if (sensor.jumps == 0) return false;
  if (estimates) return age_ <= jump_window_ || is_after_gap;
  return sensor.jumps >= kUnconfirmedJumps || (age_ == 1 && num_restarts_ < kMaxRestartsByJump);
}

bool FirstReadings::imu_differs(const SensorReading& reading, bool estimates) {
  const bool is_complete = reading.gyro.allFinite() && reading.accelerometer.allFinite();
  if (!is_complete) return false;
  const bool differs = (reading.gyro - gyro_).norm() > kMaxTurnStep ||
                       (reading.accelerometer - accelerometer_).norm() > kMaxForceStep;
  gyro_ = reading.gyro;
  accelerometer_ = reading.accelerometer;
  return estimates && differs && age_ <= jump_window_;
}

void FirstReadings::restart() {
  ++num_restarts_;
  ticks_left_ = window_;
  age_ = 1;
  encoders_.jumps = imu_.jumps = 0;
}

}  // namespace surefoot::estimation
