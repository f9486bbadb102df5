#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot {

/// Velocity of the base's origin and its angular velocity, in B [m/s], [rad/s].
struct BaseMotion {
  Vec3 v = Vec3::Zero();
  Vec3 w = Vec3::Zero();
};

/// How a base moves if the points of its feet that touch the ground stand still, where they are at
/// p_BC and move by v_BC as seen from it, in B [m], [m/s]: the v and ω that leave least of
/// Σ |v + ω × p_BC + v_BC|². Zero where all points lie in a line, about which it might turn.
[[nodiscard]] BaseMotion base_motion(const PerLeg<Vec3>& p_BC, const PerLeg<Vec3>& v_BC);

}  // namespace surefoot
