#pragma once

#include "surefoot/model/dynamics.hpp"

namespace surefoot::model {

/// The leg's own columns of a point's Jacobian: ∂v_WP / ∂q̇_leg [m].
[[nodiscard]] Mat3 leg_jacobian(const PointKinematics& point, Leg leg);

/// J⁺ = Jᵀ (J Jᵀ + δ² 1)⁻¹ with δ = 1 cm stays finite near the straight leg. q̇ = J⁺ v, and joint
/// torques press on the ground with λ = J⁺ᵀ τ.
[[nodiscard]] Mat3 damped_inverse(const Mat3& leg_jacobian);

}  // namespace surefoot::model
