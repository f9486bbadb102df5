#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot {

/// Which rung of the safety ladder made the command, best first.
enum class CommandMode : int {
  optimal = 0,   ///< the hierarchy's solution
  degraded = 1,  ///< a lower level was left out; higher levels hold
  hold = 2,      ///< no usable solution: joint hold around the last good posture
  sit = 3,       ///< a sensor is lost: slowly down to a lying posture, latched
  damping = 4,   ///< bad input, fallen, or lying: τ = −k_d q̇, latched
};

/// What took the controller off its optimum for good.
enum class StopCause : int {
  none = 0,
  tilt = 1,      ///< the torso leans too far
  failures = 2,  ///< too many ticks without a state or a solution
  encoders = 3,  ///< … or a sensor was lost
  joint_torques = 4,
  imu = 5,
};

/// Torques for the actuators at one tick: always finite and inside the limits.
struct JointCommand {
  double time = 0.0;                         ///< [s]
  JointVector torque = JointVector::Zero();  ///< [N·m]
  CommandMode mode = CommandMode::hold;
  StopCause cause = StopCause::none;  ///< of `sit` and `damping`
};

}  // namespace surefoot
