#pragma once

#include "surefoot/math/types.hpp"

namespace surefoot {

/// What the base carries beyond its model, as masses at points: by its mass and its first moment of
/// mass about B's origin, in B. The base's inertia about its own centre of mass stays as it is.
struct BaseLoad {
  double mass = 0.0;                 ///< m [kg]; below 0 where the robot is lighter than modelled
  Vec3 first_moment = Vec3::Zero();  ///< m p_BL, or Σ of them [kg·m]
};

}  // namespace surefoot
