#pragma once

#include "surefoot/signals/joint_command.hpp"
#include "surefoot/signals/sensor_health.hpp"

#include <cmath>

namespace surefoot::control {

/// Is the last good sample older than `bridge_time`? Times in s.
[[nodiscard]] constexpr bool is_lost(double age, double bridge_time) {
  constexpr double kRounding = 1e-9;
  return age > bridge_time + kRounding;
}

/// Has a good sample, or one that may stand in for it. False for a sensor that never gave one.
[[nodiscard]] inline bool is_there(const GroupHealth& group, double bridge_time) {
  return group.fault == SampleFault::none ||
         (std::isfinite(group.age) && !is_lost(group.age, bridge_time));
}

[[nodiscard]] inline bool are_all_there(const SensorHealth& health, double bridge_time) {
  return is_there(health.encoders, bridge_time) && is_there(health.imu, bridge_time) &&
         is_there(health.joint_torques, bridge_time);
}

/// The first lost sensor; `none` if there is none.
[[nodiscard]] constexpr StopCause lost_sensor(const SensorHealth& health, double bridge_time) {
  if (is_lost(health.encoders.age, bridge_time)) return StopCause::encoders;
  if (is_lost(health.imu.age, bridge_time)) return StopCause::imu;
  return is_lost(health.joint_torques.age, bridge_time) ? StopCause::joint_torques
                                                        : StopCause::none;
}

}  // namespace surefoot::control
