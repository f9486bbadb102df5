#pragma once

#include "surefoot/math/types.hpp"

namespace surefoot {

/// What the base carries beyond its model, by its mass and its first moment about B's origin, in B.
struct BaseLoad {
  double mass = 0.0;           ///< [kg]; below 0 where the robot is lighter than modelled
  Vec3 moment = Vec3::Zero();  ///< mass times position [kg·m]
};

}  // namespace surefoot
