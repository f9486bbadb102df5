#pragma once

#include "surefoot/math/types.hpp"

namespace surefoot {

/// Payload of the base as point masses: total mass and first moment about B's origin, in B. The
/// base's inertia about its own centre of mass stays unchanged.
struct BaseLoad {
  double mass = 0.0;                 ///< m [kg]; negative if the robot is lighter than modelled
  Vec3 first_moment = Vec3::Zero();  ///< Σ m p_BL [kg·m]
};

}  // namespace surefoot
