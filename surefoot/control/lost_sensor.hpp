#pragma once

#include "surefoot/signals/joint_command.hpp"
#include "surefoot/signals/sensor_health.hpp"

namespace surefoot::control {

/// Is the last good sample older than `bridge_time`? Times in s.
[[nodiscard]] constexpr bool is_lost(double age, double bridge_time) {
  constexpr double kRounding = 1e-9;
  return age > bridge_time + kRounding;
}

/// The first lost sensor; `none` if there is none.
[[nodiscard]] constexpr StopCause lost_sensor(const SensorHealth& health, double bridge_time) {
  if (is_lost(health.encoders.age, bridge_time)) return StopCause::encoders;
  if (is_lost(health.imu.age, bridge_time)) return StopCause::imu;
  return is_lost(health.joint_torques.age, bridge_time) ? StopCause::joint_torques
                                                        : StopCause::none;
}

}  // namespace surefoot::control
