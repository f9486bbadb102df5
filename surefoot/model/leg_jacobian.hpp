#pragma once

#include "surefoot/model/dynamics.hpp"

namespace surefoot {

/// The part of a point's Jacobian that belongs to the joints of its leg: ∂v_WP / ∂q̇_leg [m].
[[nodiscard]] Mat3 leg_jacobian(const PointKinematics& point, Leg leg);

/// J⁺ = Jᵀ (J Jᵀ + δ² 1)⁻¹ with δ = 1 cm, which stays finite as the leg becomes straight: q̇ = J⁺ v,
/// and of the force that the leg's torques exert on the ground λ = J⁺ᵀ τ.
[[nodiscard]] Mat3 damped_inverse(const Mat3& leg_jacobian);

}  // namespace surefoot
