#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot {

/// Estimated errors of the description of legs and IMU.
struct KinematicErrors {
  PerLeg<double> thigh{};  ///< true minus described length [m]
  PerLeg<double> shank{};  ///< [m]
  /// Encoder reading at a joint's zero [rad].
  LegJointVector zero = LegJointVector::Zero(kNumLegJoints);
  /// Mounting error of the IMU: its readings, turned by this vector, are in B [rad].
  Vec3 imu = Vec3::Zero();
  Mat3 imu_covariance = Mat3::Zero();  ///< of what is left of it, in B [rad²]

  /// Of the errors themselves.
  [[nodiscard]] bool operator==(const KinematicErrors& other) const {
    return thigh == other.thigh && shank == other.shank && zero == other.zero && imu == other.imu;
  }
};

[[nodiscard]] inline KinematicErrors no_errors(int num_legs) {
  return {.thigh = PerLeg<double>(num_legs, 0.0),
          .shank = PerLeg<double>(num_legs, 0.0),
          .zero = LegJointVector::Zero(kJointsPerLeg * num_legs)};
}

}  // namespace surefoot
