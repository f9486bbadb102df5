#pragma once

#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "tests/support/random_motion.hpp"

namespace surefoot::test {

/// Within ±40 N·m.
[[nodiscard]] JointVector random_torque(Random& random);

/// Of the legs that the plan has in contact, one below the other.
[[nodiscard]] MatX stacked_jacobians(const model::Dynamics& dynamics, const MotionPlan& plan);

struct ForwardDynamics {
  VecX x;       ///< (u̇, τ)
  VecX lambda;  ///< contact forces of least norm
};

/// M u̇ + h = Sᵀτ + J_sᵀλ with J_s u̇ + J̇_s u = 0, as one linear system.
[[nodiscard]] ForwardDynamics forward_dynamics(const model::Dynamics& dynamics,
                                               const MotionPlan& plan, const JointVector& torque);

/// (u̇, τ) under these contact forces, which need not fit the contacts.
[[nodiscard]] VecX accelerated_by(const model::Dynamics& dynamics, const MotionPlan& plan,
                                  const JointVector& torque, const VecX& lambda);

}  // namespace surefoot::test
