#pragma once

#include "surefoot/math/types.hpp"

namespace surefoot {
struct Group;
}  // namespace surefoot

namespace surefoot::estimation {

/// Limits of plausible sensor values of a legged robot.
struct ReadingGuardOptions {
  static constexpr double kLongestPatience = 0.02;  // [s]

  double patience = kLongestPatience;
  /// With later samples a walking robot falls.
  double max_encoder_delay = 0.006, max_torque_delay = 0.011, max_imu_delay = 0.011;

  double max_angle = 2.0 * kPi;
  /// Allowed distance of an encoder from its predicted value, plus what the velocity limit gives in
  /// a period (twice that if the next sample confirms it, as an impact can reverse a joint).
  double angle_margin = 0.01, velocity_margin = 2.0;
  /// Boxes, stairs and pushes showed at most 8e-4 rad in a tick; a change by 8 rad/s gives 0.02.
  double sure_angles = 0.004, max_angles = 0.02;

  /// Shares of the joint's torque limit. Single bad samples have no effect, and an impact is
  /// noticed one sample later.
  double max_torque = 3.0, max_torque_step = 2.0, sure_torque_step = 1.0;

  double max_gyro = 35.0, max_acceleration = 300.0;
  /// In a tick of 2.5 ms: a hard kick gives a torso 1000 rad/s².
  double max_gyro_step = 3.0, max_acceleration_step = 150.0;
  /// A larger step needs confirmation by the next sample and a step of half its limit in the IMU's
  /// other instrument within `patience`, as both sense an impact. Boxes, stairs and pushes showed
  /// at most 0.25 rad/s and 11 m/s².
  double sure_gyro_step = 0.6, sure_acceleration_step = 25.0;
  int repeats = 3;
};

/// Their names, units, ranges and help.
[[nodiscard]] Group fields(ReadingGuardOptions& o);

}  // namespace surefoot::estimation
