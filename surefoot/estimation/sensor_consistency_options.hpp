#pragma once

namespace surefoot {
struct Group;
}  // namespace surefoot

namespace surefoot::estimation {

/// Limits of the disagreement between IMU and legs about the base's motion. Over a span T they are
///
///     position_margin + velocity_margin T,   turn_margin + rate_margin T
///
/// plus `doubt` times the disagreement among the feet and the possible effect of an impact between
/// two samples.
struct ImuCheckOptions {
  double window = 0.2;
  double position_margin = 1e-3, velocity_margin = 0.04, turn_margin = 6e-3, rate_margin = 0.03;
  double doubt = 2.0;
  double force = 20.0, settle = 0.03;
  // A shock suspends the check, as feet lift off before their forces show it.
  double max_acceleration = 6.0, tumbling = 1.0, shaking = 1.5;
};

/// When a bit-identical encoder or torque sensor counts as frozen.
struct FrozenJointOptions {
  double motion = 0.05, torque = 5.0, duration = 0.05;
};

/// When joint torques contradict the command, or claim more than plausible pushes and loads.
struct TorqueCheckOptions {
  double max_error = 8.0, duration = 0.25;
  double max_force = 400.0, max_moment = 65.0, time_constant = 0.1;
};

/// When plausible sensors contradict each other.
struct SensorConsistencyOptions {
  bool enabled = true;
  ImuCheckOptions imu;
  FrozenJointOptions frozen;
  TorqueCheckOptions torques;
};

/// Their names, units, ranges and help.
[[nodiscard]] Group fields(SensorConsistencyOptions& o);

}  // namespace surefoot::estimation
