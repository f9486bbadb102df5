#pragma once

#include "surefoot/signals/sensor_health.hpp"

namespace surefoot {

/// The rung of the safety ladder that made the command, best first.
enum class CommandMode : int {
  optimal = 0,   ///< the hierarchy's solution
  degraded = 1,  ///< lower levels are skipped; higher levels hold
  hold = 2,      ///< no usable solution: joint hold around the last good posture
  sit = 3,       ///< a sensor is lost: lowers itself slowly to a lying posture, latched
  damping = 4,   ///< bad input, fallen, or lying: τ = −k_d q̇, latched
  lifted = 5,    ///< something other than its feet holds the robot: legs are held softly
  rise = 6,      ///< lies or was put down: gets up, joint by joint
};

/// Why the controller left `optimal` for good.
enum class StopCause : int {
  none = 0,
  tilt = 1,      ///< the torso leans too far
  failures = 2,  ///< too many ticks without a state or a solution
  encoders = 3,  ///< a sensor was lost: encoders, joint torques or IMU
  joint_torques = 4,
  imu = 5,
  cannot_stand = 6,  ///< did not come to stand on its feet
  fallen = 7,        ///< the torso lies on the ground
  own_part = 8,      ///< code of the user's own failed: a task, the planner or the estimator
};

/// Neither stands nor has stopped: nothing follows the plan.
[[nodiscard]] constexpr bool is_off_its_feet(CommandMode mode) {
  return mode == CommandMode::lifted || mode == CommandMode::rise;
}

/// Was a sensor lost?
[[nodiscard]] constexpr bool is_sensor(StopCause cause) {
  return cause == StopCause::encoders || cause == StopCause::joint_torques ||
         cause == StopCause::imu;
}

/// The sensors that caused a stop; null if something else did.
[[nodiscard]] constexpr const GroupHealth* group_of(const SensorHealth& health, StopCause cause) {
  switch (cause) {
    case StopCause::encoders:
      return &health.encoders;
    case StopCause::joint_torques:
      return &health.joint_torques;
    case StopCause::imu:
      return &health.imu;
    default:
      return nullptr;
  }
}

/// Torques for the actuators at one tick: always finite and inside the limits.
struct JointCommand {
  double time = 0.0;                                      ///< [s]
  JointVector torque = JointVector::Zero(kNumLegJoints);  ///< [N·m]
  CommandMode mode = CommandMode::hold;
  StopCause cause = StopCause::none;  ///< of `sit` and `damping`
  /// If a sensor is the cause: its fault when it was lost, whatever came later.
  SampleFault fault = SampleFault::none;
  int joint = -1;  ///< the only faulty one then, as in a JointVector; −1: none, or several
};

}  // namespace surefoot
