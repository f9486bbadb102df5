#pragma once

namespace surefoot::control {

/// When the controller stops for good, and how the robot then sits down.
struct SafetyOptions {
  int damp_after_failures = 80;  ///< 200 ms at 400 Hz
  double max_tilt = 1.05, bridge_time = 0.02;
  double sit_duration = 3.0, sit_height = 0.15;
  double max_torque_change = 4.0;
};

}  // namespace surefoot::control
