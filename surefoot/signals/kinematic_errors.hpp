#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot {

/// How legs and IMU differ from their description, as far as the robot has found out.
struct KinematicErrors {
  PerLeg<double> thigh{};                  ///< longer than described by [m]
  PerLeg<double> shank{};                  ///< [m]
  JointVector zero = JointVector::Zero();  ///< what the encoders show at a joint's zero [rad]
  /// How the IMU is mounted askew: what it measures, turned by this vector, is in B [rad].
  Vec3 imu = Vec3::Zero();

  [[nodiscard]] bool operator==(const KinematicErrors&) const = default;
};

}  // namespace surefoot
