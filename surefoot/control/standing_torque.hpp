#pragma once

#include "surefoot/model/robot_model.hpp"

namespace surefoot {

/// Joint torques that bear a robot at rest on its four feet before anything is known of its base
/// [N·m]: the torso is taken to be level, and the feet's forces to be those vertical ones, none of
/// them below zero, that balance the weight and are of least norm. Not finite where q [rad] isn't.
/// Leaves the model at this posture. Does not allocate.
[[nodiscard]] JointVector standing_torque(RobotModel& model, const JointVector& q) noexcept;

}  // namespace surefoot
