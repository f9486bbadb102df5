#pragma once

namespace surefoot {

/// Limits of the disagreement between IMU and legs about the base's motion. Over a span T they are
///
///     position_margin + velocity_margin T,   turn_margin + rate_margin T
///
/// plus `doubt` times the disagreement among the feet and the possible effect of an impact between
/// two samples.
struct ImuCheckOptions {
  double window = 0.2;            ///< longest span [s]
  double position_margin = 1e-3;  ///< from encoders, rolling and samples out of step [m]
  double velocity_margin = 0.04;  ///< from yielding feet, biases and leg errors [m/s]
  double turn_margin = 6e-3;      ///< [rad]
  double rate_margin = 0.03;      ///< [rad/s]
  double doubt = 2.0;
  double force = 20.0;   ///< smallest load of a foot that counts [N]
  double settle = 0.03;  ///< for so long [s]
  // A shock suspends the check, as feet lift off before their forces show it. Either the feet's
  // forces accelerate the robot by more than
  double max_acceleration = 6.0;  ///< [m/s²]
  // or the robot turns faster than this, and senses more or less than g by that:
  double tumbling = 1.0;  ///< [rad/s]
  double shaking = 1.5;   ///< [m/s²]
};

/// When a bit-identical encoder or torque sensor counts as frozen.
struct FrozenJointOptions {
  double motion = 0.05;    ///< requested of the joint meanwhile by plan and stance feet [rad]
  double torque = 5.0;     ///< change of its command meanwhile [N·m]
  double duration = 0.05;  ///< of that change [s]
};

/// When joint torques contradict the command, or claim more than plausible pushes and loads.
struct TorqueCheckOptions {
  double max_error = 8.0;      ///< of a joint's torque against its command, to one side [N·m]
  double duration = 0.25;      ///< of that error; longer than a drive stays at its limit [s]
  double max_force = 400.0;    ///< claimed by the torques [N]
  double max_moment = 65.0;    ///< [N·m]
  double time_constant = 0.1;  ///< of both [s]
};

/// When plausible sensors contradict each other.
struct SensorConsistencyOptions {
  bool enabled = true;
  ImuCheckOptions imu;
  FrozenJointOptions frozen;
  TorqueCheckOptions torques;
};

}  // namespace surefoot
