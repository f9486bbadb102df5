#pragma once

#include "surefoot/model/robot_model.hpp"

namespace surefoot::control {

/// The inertia of the torso's rotation with limp joints, in B [kg·m²]: that with the legs, which
/// stand on the ground, would be many times as large.
[[nodiscard]] Mat3 limp_inertia(const model::Dynamics& dynamics);

/// State at rest with a level torso, the base at W's origin, and joint angles q [rad].
[[nodiscard]] RobotState level_at_rest(const JointVector& q);

/// What the ground shall do beside carrying the weight.
struct Righting {
  Quat q_WB = Quat::Identity();  ///< of the torso
  Vec3 moment = Vec3::Zero();    ///< about the COM in W, horizontal [N·m]
};

/// Joint torques that carry a robot at rest on its feet [N·m], by the vertical foot forces of least
/// norm that balance the weight and exert the moment. A foot that would have to pull gets no force;
/// then the moments don't balance. Not finite if q [rad] isn't. Leaves the model at this posture.
/// Does not allocate.
[[nodiscard]] JointVector standing_torque(model::RobotModel& model, const JointVector& q,
                                          const Righting& righting = {}) noexcept;

/// Total ground force on the feet of a robot at rest, from its joint torques [N], in B. Assumes a
/// level torso. Not finite if q [rad] or a torque [N·m] isn't. Leaves the model at this posture.
[[nodiscard]] Vec3 borne_force(model::RobotModel& model, const JointVector& q,
                               const JointVector& torque) noexcept;

}  // namespace surefoot::control
