#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot::control {

/// Where the legs of a robot that is not on its feet are to go, in joint space.
struct LegPosture {
  JointVector q;          ///< [rad]
  JointVector qd;         ///< [rad/s]
  double softness = 1.0;  ///< of legs that stand: 0 hard, 1 as soft as in the air
  PerLeg<bool> stands{};  ///< legs with a foot on the ground
  double bears = 0.0;     ///< share of the weight that the feet are to bear
};

}  // namespace surefoot::control
