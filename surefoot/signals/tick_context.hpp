#pragma once

#include "surefoot/signals/kinematic_errors.hpp"

namespace surefoot {

/// What is believed of a foot's contact when readings come in, from the tick before.
struct FootContact {
  bool carries = true;        ///< the plan lets the foot stand
  double normal_force = 0.0;  ///< estimated, along the terrain normal [N]
  bool slips = false;         ///< the foot is believed to slide
};

/// What a state estimator is told beside the readings.
struct TickContext {
  PerLeg<FootContact> contacts{};
  JointVector joint_velocity = JointVector::Zero();  ///< from the encoders, observed [rad/s]
  /// How far the readings' joints and IMU are behind the tick: samples come late [s].
  double joint_lag = 0.0, imu_lag = 0.0;
  KinematicErrors kinematics{};  ///< found so far; the readings are without zeros and askew IMU
  /// All feet stand and nothing is asked of them: forget what is believed, but for the place and
  /// the heading, and begin anew.
  bool restarts = false;
  /// No foot is known to stand: the robot is lifted, or lies. Its base is taken to be at rest.
  bool off_its_feet = false;
};

}  // namespace surefoot
