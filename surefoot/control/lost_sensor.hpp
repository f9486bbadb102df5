#pragma once

#include "surefoot/signals/joint_command.hpp"
#include "surefoot/signals/sensor_health.hpp"

namespace surefoot::control {

/// Was the last good sample longer ago than may be bridged? Times in s.
[[nodiscard]] constexpr bool is_lost(double age, double bridge_time) {
  constexpr double kRounding = 1e-9;
  return age > bridge_time + kRounding;
}

/// The first sensor that is lost; `none`: all are well enough.
[[nodiscard]] constexpr StopCause lost_sensor(const SensorHealth& health, double bridge_time) {
  if (is_lost(health.encoders.age, bridge_time)) return StopCause::encoders;
  if (is_lost(health.imu.age, bridge_time)) return StopCause::imu;
  return is_lost(health.joint_torques.age, bridge_time) ? StopCause::joint_torques
                                                        : StopCause::none;
}

}  // namespace surefoot::control
