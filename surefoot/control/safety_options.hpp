#pragma once

namespace surefoot {

/// When the controller gives up its optimum for good, and how it then comes to rest.
struct SafetyOptions {
  int damp_after_failures =
      80;                     ///< ticks of joint hold before it stops, latched (200 ms at 400 Hz)
  double max_tilt = 1.05;     ///< damping beyond this tilt of the torso, latched [rad]
  double bridge_time = 0.02;  ///< without a good sample of a sensor, then the robot sits down;
                              ///< not above the guard's patience [s]
  double sit_duration = 3.0;  ///< of the way down, in the last 0.4 of which the torques fade [s]
  double sit_height = 0.15;   ///< of the hips above the feet when it is down [m]
  /// Of a torque from tick to tick while a sensor is at fault, and from then on until the torques
  /// are those of the solution again, after a stop, and while a robot begins late [N·m].
  double max_torque_change = 4.0;
};

}  // namespace surefoot
