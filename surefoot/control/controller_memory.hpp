#pragma once

#include "surefoot/control/controller.hpp"
#include "surefoot/control/footing.hpp"
#include "surefoot/estimation/com_calibration.hpp"
#include "surefoot/estimation/kinematic_calibration.hpp"
#include "surefoot/estimation/link_mass_estimator.hpp"
#include "surefoot/estimation/reading_guard.hpp"
#include "surefoot/estimation/rest_check.hpp"
#include "surefoot/estimation/sensor_consistency.hpp"
#include "surefoot/gaits/planner.hpp"
#include "surefoot/model/robot_model.hpp"

namespace surefoot {

/// What the readings so far have taught a controller, beside what its estimator and `Safety` know.
/// A copy from the start is what it begins anew with.
struct ControllerMemory {
  /// Throws Error where the period is no time above 0.
  ControllerMemory(const RobotDescription& robot, const ControllerOptions& options,
                   const RobotModel& model);

  ReadingGuard guard;
  RestCheck rest_check;
  ContactForceEstimator contact_force;
  JointVector joint_velocity = JointVector::Zero();  // observed [rad/s]
  KinematicCalibration kinematics;
  KinematicErrors errors_before;
  LinkMassEstimator link_masses;
  ComCalibration com_calibration;
  SlipDetector slip;
  ExternalForceEstimator external_force;
  SensorConsistency consistency;
  LiftDetector lift;
  Footing footing;
  Planner planner;
  HierarchyOutcome last;
  double last_time = kNaN;  // of the last state that was believed [s]
};

}  // namespace surefoot
