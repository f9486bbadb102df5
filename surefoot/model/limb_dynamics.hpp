#pragma once

#include "surefoot/model/dynamics.hpp"

namespace surefoot::model {

/// A leg with a flat foot, apart from the rest: its block M_kk, and the six rows J_k of its
/// contact, of force and moment. Inverted as by `damped_inverse`. Does not allocate.
class LimbDynamics {
 public:
  using Joints = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxLegJoints, 1>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  LimbDynamics(const Dynamics& dynamics, Leg leg) noexcept;

  /// M_kk⁻¹ (τ − h − M_kb u̇_b)_k: of its joints in the air [rad/s²].
  [[nodiscard]] Joints free_acceleration(const JointVector& torque, const Vector6& base) const;
  /// The a with J_k a + J_kb u̇_b + J̇ u = 0: with its foot at rest [rad/s²].
  [[nodiscard]] Joints stance_acceleration(const Vector6& base) const;
  /// The force and the moment of the ground in W that add these accelerations, (J_kᵀ)⁺ M_kk a [N],
  /// [N·m].
  [[nodiscard]] Vector6 wrench(const JointVector& acceleration) const;

 private:
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                               kMaxLegJoints, kMaxLegJoints>;
  using Contact = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, kMaxLegJoints>;

  const Dynamics& dynamics_;
  JointRange joints_;
  Square M_;
  Contact J_;
  Eigen::Matrix<double, 6, 6> squared_;  // J Jᵀ + δ² 1
  Eigen::Matrix<double, 6, 6> J_base_;
  Vector6 Jdot_u_;
};

}  // namespace surefoot::model
