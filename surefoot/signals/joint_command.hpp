#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot {

/// Which rung of the safety ladder made the command, best first.
enum class CommandMode : int {
  optimal = 0,   ///< the hierarchy's solution
  degraded = 1,  ///< a lower level was left out; higher levels hold
  hold = 2,      ///< no usable solution: joint hold around the last good posture
  damping = 3,   ///< bad input or fallen: τ = −k_d q̇, latched
};

/// Torques for the actuators at one tick: always finite and inside the limits.
struct JointCommand {
  double time = 0.0;                         ///< [s]
  JointVector torque = JointVector::Zero();  ///< [N·m]
  CommandMode mode = CommandMode::hold;
};

}  // namespace surefoot
