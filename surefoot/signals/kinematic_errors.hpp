#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot {

/// Estimated errors of the description of legs and IMU.
struct KinematicErrors {
  PerLeg<double> thigh{};                        ///< true minus described length [m]
  PerLeg<double> shank{};                        ///< [m]
  LegJointVector zero = LegJointVector::Zero();  ///< encoder reading at a joint's zero [rad]
  /// Mounting error of the IMU: its readings, turned by this vector, are in B [rad].
  Vec3 imu = Vec3::Zero();

  [[nodiscard]] bool operator==(const KinematicErrors&) const = default;
};

}  // namespace surefoot
