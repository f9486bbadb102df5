#pragma once

#include "surefoot/model/robot_model.hpp"

namespace surefoot::control {

/// A robot at rest with its torso level, the base at W's origin, and these joint angles [rad].
[[nodiscard]] RobotState level_at_rest(const JointVector& q);

/// Joint torques that bear a robot at rest on its four feet whose base is not known
/// [N·m]: the torso is taken to be level, and the feet's forces to be those vertical ones that
/// balance the weight and are of least norm. Where a foot would have to pull, the others bear the
/// weight as if it did not, and the robot tips. Not finite where q [rad] isn't. Leaves the model at
/// this posture. Does not allocate.
[[nodiscard]] JointVector standing_torque(model::RobotModel& model, const JointVector& q) noexcept;

/// Force of the ground on the feet all together, of a robot at rest whose torso is taken to be
/// level, by its joint torques [N], in B. Not finite where q [rad] or a torque [N·m] isn't. As
/// above.
[[nodiscard]] Vec3 borne_force(model::RobotModel& model, const JointVector& q,
                               const JointVector& torque) noexcept;

}  // namespace surefoot::control
