#pragma once

namespace surefoot {

/// When IMU and legs disagree about how the base moved. What is allowed over a span T is
///
///     position_margin + velocity_margin T,   turn_margin + rate_margin T
///
/// and more by `doubt` times what the feet disagree by among themselves and what a blow may have
/// done between two samples.
struct ImuCheckOptions {
  double window = 0.2;            ///< longest span [s]
  double position_margin = 1e-3;  ///< what encoders, rolling and samples out of step cause [m]
  double velocity_margin = 0.04;  ///< what feet that give way, biases and wrong legs cause [m/s]
  double turn_margin = 6e-3;      ///< [rad]
  double rate_margin = 0.03;      ///< [rad/s]
  double doubt = 2.0;
  double force = 20.0;   ///< a foot that carries less says nothing [N] …
  double settle = 0.03;  ///< … nor one that does so for less [s]
  // Nor any where the robot is thrown, as feet come off then before their forces tell it: where
  // these would accelerate it by more than
  double max_acceleration = 6.0;  ///< [m/s²]
  // or it turns faster than this, and feels more or less than g by that:
  double tumbling = 1.0;  ///< [rad/s]
  double shaking = 1.5;   ///< [m/s²]
};

/// When a joint's encoder or torque sensor stands still, bit by bit, though the joint does not.
struct FrozenJointOptions {
  double motion = 0.05;    ///< that plan and standing feet ask of the joint meanwhile [rad]
  double torque = 5.0;     ///< by which its command is off what it was [N·m] …
  double duration = 0.05;  ///< … for so long [s]
};

/// When joint torques are not those that were commanded, or claim more than anything that pushes or
/// loads the robot.
struct TorqueCheckOptions {
  double max_error = 8.0;      ///< of a joint's torque against its command, to one side [N·m] …
  double duration = 0.25;      ///< … for so long; a drive at its limit is off for less [s]
  double max_force = 400.0;    ///< that the torques claim [N]
  double max_moment = 65.0;    ///< [N·m]
  double time_constant = 0.1;  ///< of both [s]
};

/// When sensors contradict each other, though each gives what it can give.
struct SensorConsistencyOptions {
  bool enabled = true;
  ImuCheckOptions imu;
  FrozenJointOptions frozen;
  TorqueCheckOptions torques;
};

}  // namespace surefoot
