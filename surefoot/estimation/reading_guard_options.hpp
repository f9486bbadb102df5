#pragma once

#include "surefoot/math/types.hpp"

namespace surefoot {

/// What a sensor of a legged robot can truly give.
struct ReadingGuardOptions {
  static constexpr double kLongestPatience = 0.02;  // [s]

  /// A sample older than this is of no use any more, and is made up for no longer; at most
  /// kLongestPatience [s].
  double patience = kLongestPatience;
  /// How late samples may come: a robot that walks by later ones falls [s].
  double max_encoder_delay = 0.006, max_torque_delay = 0.011, max_imu_delay = 0.011;

  double max_angle = 2.0 * kPi;  ///< no joint turns further [rad]
  /// How far an encoder may be from where the joint's velocity led: as its velocity limit leads in
  /// a period, or, when the next sample says so, too, as twice the limit does, which an impact can
  /// turn about; and …
  double angle_margin = 0.01;    ///< [rad] …
  double velocity_margin = 2.0;  ///< of a joint that was not seen for a time [rad/s]
  /// Half of the joints this far from where their velocities led at once is believed when the next
  /// sample says so, too: on boxes, stairs and when pushed 8e-4 was the most [rad].
  double sure_angles = 0.004;
  /// Half of them this far at once is believed of no robot that is not hit: at 8 rad/s more than
  /// they had [rad].
  double max_angles = 0.02;

  /// As shares of the joint's torque limit. An impact loads the spring of a drive beyond what the
  /// motor gives, and at once.
  double max_torque = 3.0;
  double max_torque_step = 2.0;
  /// A larger step is believed when the next sample says so, too: single samples that are wrong
  /// come to nothing, and what is hit hard is noticed a sample later.
  double sure_torque_step = 1.0;

  double max_gyro = 35.0;           ///< range of common gyroscopes, 2000 °/s [rad/s]
  double max_acceleration = 300.0;  ///< 30 g [m/s²]
  /// In a tick of 2.5 ms: a hard kick gives a torso 1000 rad/s².
  double max_gyro_step = 3.0;            ///< [rad/s]
  double max_acceleration_step = 150.0;  ///< [m/s²]
  /// A larger step is believed when the next sample says so, too, and the other instrument of the
  /// IMU made a step of half its size here within `patience`: a blow is felt by both. On boxes,
  /// stairs and when pushed 0.25 rad/s and 11 m/s² were the most.
  double sure_gyro_step = 0.6;           ///< [rad/s]
  double sure_acceleration_step = 25.0;  ///< [m/s²]
  int repeats = 3;                       ///< of a sample, bit by bit, until it is no measurement
};

}  // namespace surefoot
