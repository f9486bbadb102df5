#pragma once

#include "surefoot/signals/kinematic_errors.hpp"

namespace surefoot {

/// State of a foot's contact, from the tick before.
struct FootContact {
  bool carries = true;        ///< the plan lets it carry load
  double normal_force = 0.0;  ///< estimated, along the terrain normal [N]
  bool slips = false;         ///< the foot is believed to slide
};

/// Inputs of a state estimator besides the readings.
struct TickContext {
  PerLeg<FootContact> contacts{};
  JointVector joint_velocity =
      JointVector::Zero(kNumLegJoints);  ///< from the encoders, observed [rad/s]
  /// Age of the joint and IMU samples at the tick [s].
  double joint_lag = 0.0, imu_lag = 0.0;
  KinematicErrors kinematics{};  ///< found so far; readings are corrected for zeros and IMU
  /// All feet stand and nothing is commanded: restart the estimate, keep position and heading.
  bool restarts = false;
  /// No foot is known to stand: the robot is lifted, or lies. Its base counts as at rest.
  bool off_its_feet = false;
};

}  // namespace surefoot
