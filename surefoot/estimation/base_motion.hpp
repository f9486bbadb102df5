#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot::estimation {

/// Velocity of the base's origin and its angular velocity, in B [m/s], [rad/s].
struct BaseMotion {
  Vec3 v = Vec3::Zero();
  Vec3 w = Vec3::Zero();
};

/// Base motion for contact points that stand still, at p_BC and with velocity v_BC relative to the
/// base, in B [m], [m/s]: the v and ω that minimize Σ |v + ω × p_BC + v_BC|². Zero if the points
/// are collinear, as the turn about their line is unknown.
[[nodiscard]] BaseMotion base_motion(const PerLeg<Vec3>& p_BC, const PerLeg<Vec3>& v_BC);

}  // namespace surefoot::estimation
