#pragma once

#include "surefoot/math/numbers.hpp"
#include "surefoot/signals/per_leg.hpp"

namespace surefoot {

/// Longest gap between readings [s]; after a longer one the past counts as unknown.
inline constexpr double kLongestReadingGap = 0.1;

/// Sensor readings of one control tick. Members that a robot does not measure stay NaN.
struct SensorReading {
  double time = kNaN;                                          ///< [s] since the start of the run
  JointVector q = JointVector::Constant(kNumLegJoints, kNaN);  ///< joint positions, encoders [rad]
  JointVector torque =
      JointVector::Constant(kNumLegJoints, kNaN);  ///< measured joint torques [N·m]
  Vec3 gyro = Vec3::Constant(kNaN);                ///< w_WB_B, angular velocity of B in B [rad/s]
  Vec3 accelerometer = Vec3::Constant(kNaN);       ///< specific force of the base frame in B [m/s²]
  /// Normal force of a foot sensor [N]; NaN on robots without one (ANYmal B has none).
  PerLeg<double> foot_force = per_leg(kNaN);
  /// Sample times [s]: before `time` if a sensor is slow, late or silent.
  double encoder_time = kNaN;  ///< of q
  double torque_time = kNaN;
  double imu_time = kNaN;  ///< of gyro and accelerometer
};

}  // namespace surefoot
