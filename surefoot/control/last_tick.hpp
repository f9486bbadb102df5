#pragma once

#include "surefoot/estimation/imu_step_check.hpp"
#include "surefoot/signals/base_load.hpp"
#include "surefoot/signals/hierarchy_outcome.hpp"
#include "surefoot/signals/kinematic_errors.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/per_leg.hpp"

#include <optional>

namespace surefoot::control {

/// All that a tick uses of the tick before.
struct LastTick {
  MotionPlan plan;
  Vec3 terrain_normal_W = Vec3::UnitZ();  ///< unit
  /// Estimated, in W [N].
  PerLeg<Vec3> foot_force = per_leg<Vec3>(Vec3::Constant(kNaN));
  PerLeg<bool> slips{};        ///< the foot slides
  JointVector joint_velocity;  ///< observed [rad/s]
  JointVector torque;          ///< commanded [N·m]
  KinematicErrors kinematics;  ///< calibrated
  BaseLoad load;               ///< payload of the base, calibrated
  HierarchyOutcome outcome;
  std::optional<estimation::ImuStep> imu_step;  ///< the legs' verdict on a step of the IMU
  bool restarts = false;                        ///< the estimate restarts, all feet standing
};

}  // namespace surefoot::control
