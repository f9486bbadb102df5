#pragma once

#include "surefoot/model/dynamics.hpp"

namespace surefoot::estimation {

/// Total force and moment of the ground on the feet, in W.
struct GroundReaction {
  Vec3 force = Vec3::Zero();   ///< F = Σ f_k [N]
  Vec3 moment = Vec3::Zero();  ///< M = Σ p_k × f_k about W's origin [N·m]
  double ground = 0.0;         ///< mean z of the contact points [m]

  /// Intersection of its line of action with height z in W, for F_z ≠ 0; on the ground the centre
  /// of pressure [m]:
  ///
  ///     x = (z F_x − M_y) / F_z,   y = (z F_y + M_x) / F_z
  [[nodiscard]] Vec2 line_of_action(double z) const {
    return Vec2(z * force.x() - moment.y(), z * force.y() + moment.x()) / force.z();
  }
};

/// Sum of the forces on the contact points.
[[nodiscard]] inline GroundReaction ground_reaction(const model::Dynamics& dynamics,
                                                    const PerLeg<Vec3>& foot_force) noexcept {
  const auto count = static_cast<double>(foot_force.size());
  GroundReaction result;
  for (const Leg leg : foot_force.legs()) {
    const Vec3& f = foot_force[index(leg)];
    const Vec3& p = dynamics.contact[index(leg)].p;
    result.force += f;
    result.moment += p.cross(f);
    result.ground += p.z() / count;
  }
  return result;
}

}  // namespace surefoot::estimation
