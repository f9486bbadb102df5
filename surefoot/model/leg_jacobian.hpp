#pragma once

#include "surefoot/model/dynamics.hpp"

namespace surefoot::model {

/// The leg's own columns of a point's Jacobian: ∂v_WP / ∂q̇_leg [m].
[[nodiscard]] Mat3 leg_jacobian(const PointKinematics& point, Leg leg);

/// J⁺ = Jᵀ (J Jᵀ + δ² 1)⁻¹ stays finite near the straight leg, with δ = 1 cm of the reference robot
/// and `scale` of this one. q̇ = J⁺ v, and joint torques press on the ground with λ = J⁺ᵀ τ.
[[nodiscard]] Mat3 damped_inverse(const Mat3& leg_jacobian, const Scale& scale);

}  // namespace surefoot::model
