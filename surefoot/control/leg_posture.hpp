#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot::control {

/// Desired leg posture of a robot that is off its feet, in joint space.
struct LegPosture {
  JointVector q;          ///< [rad]
  JointVector qd;         ///< [rad/s]
  double softness = 1.0;  ///< of stance legs: 0 stiff, 1 as soft as swing legs
  PerLeg<bool> stands{};  ///< legs with a foot on the ground
  double bears = 0.0;     ///< share of the weight that the feet shall carry
};

}  // namespace surefoot::control
