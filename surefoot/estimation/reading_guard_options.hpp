#pragma once

#include "surefoot/math/types.hpp"

namespace surefoot {

/// Limits of plausible sensor values of a legged robot.
struct ReadingGuardOptions {
  static constexpr double kLongestPatience = 0.02;  // [s]

  /// Largest age of a useful sample, and longest time it is replaced; at most kLongestPatience [s].
  double patience = kLongestPatience;
  /// Largest tolerated delays; with later samples a walking robot falls [s].
  double max_encoder_delay = 0.006, max_torque_delay = 0.011, max_imu_delay = 0.011;

  double max_angle = 2.0 * kPi;  ///< no joint turns further [rad]
  /// Allowed distance of an encoder from its predicted value: what the velocity limit gives in a
  /// period (twice that if the next sample confirms it, as an impact can reverse a joint) plus
  double angle_margin = 0.01;    ///< [rad]
  double velocity_margin = 2.0;  ///< per time without a good sample [rad/s]
  /// A common jump of half of the joints beyond this needs confirmation by the next sample; boxes,
  /// stairs and pushes showed at most 8e-4 [rad].
  double sure_angles = 0.004;
  /// A common jump of half of the joints beyond this needs an impact: 8 rad/s more than they had
  /// [rad].
  double max_angles = 0.02;

  /// Shares of the joint's torque limit. An impact loads a drive's spring beyond the motor's torque
  /// at once.
  double max_torque = 3.0;
  double max_torque_step = 2.0;
  /// A larger step needs confirmation by the next sample: single bad samples have no effect, and an
  /// impact is noticed one sample later.
  double sure_torque_step = 1.0;

  double max_gyro = 35.0;           ///< range of common gyroscopes, 2000 °/s [rad/s]
  double max_acceleration = 300.0;  ///< 30 g [m/s²]
  /// In a tick of 2.5 ms: a hard kick gives a torso 1000 rad/s².
  double max_gyro_step = 3.0;            ///< [rad/s]
  double max_acceleration_step = 150.0;  ///< [m/s²]
  /// A larger step needs confirmation by the next sample and a step of half its limit in the IMU's
  /// other instrument within `patience`, as both sense an impact. Boxes, stairs and pushes showed
  /// at most 0.25 rad/s and 11 m/s².
  double sure_gyro_step = 0.6;           ///< [rad/s]
  double sure_acceleration_step = 25.0;  ///< [m/s²]
  int repeats = 3;                       ///< of a bit-identical sample that make it faulty
};

}  // namespace surefoot
