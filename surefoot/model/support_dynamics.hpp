#pragma once

#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/per_leg.hpp"

#include <Eigen/QR>

namespace surefoot::model {

/// The equations of motion, split by the stance feet (Bellicoso 2016, Eqs. 4–7).
///
///     J_sᵀ Π = [Q_c Q_u] [R; 0]
///     without λ:   Q_uᵀ (M u̇ + h − Sᵀτ) = 0
///     λ itself:    λ = (J_sᵀ)⁺ (M u̇ + h − Sᵀτ) = Λ x + λ₀,   x = (u̇, τ)
///
/// J_s stacks the contact Jacobians of the legs in contact, in their order; λ are their
/// forces on the robot in W [N], each followed by its moment about the sole's centre if feet are
/// flat [N·m]. J_sᵀ loses rank when legs are straight or feet coincide: pivots
/// below `kRankTolerance` times the largest count as zero, Q_u keeps all directions without contact
/// force, and λ has least norm. Computed once a tick; does not allocate.
class SupportDynamics {
 public:
  static constexpr int kMaxForces = 3 * kMaxLegs;
  static constexpr double kRankTolerance = 1e-6;

  using ForceMap = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                 kMaxForces, kMaxVelocities + kMaxJoints>;
  using ForceVector = Eigen::Matrix<double, kMaxForces, 1>;

  SupportDynamics() = default;

  /// The plan says which legs are in contact.
  void update(const Dynamics& dynamics, const MotionPlan& plan) noexcept;

  [[nodiscard]] int num_contacts() const { return num_contacts_; }
  /// Rows of J_s: 3 or, with flat feet, 6 a contact.
  [[nodiscard]] int num_forces() const { return rows_ * num_contacts_; }
  [[nodiscard]] int rank() const { return rank_; }  ///< of J_s; `num_forces` at full rank
  [[nodiscard]] bool in_contact(Leg leg) const { return first_force_[index(leg)] >= 0; }
  /// Row of the leg's force in Λ and λ₀; −1 without contact.
  [[nodiscard]] int first_force(Leg leg) const { return first_force_[index(leg)]; }

  /// Basis of the motions without contact force: n_u × (n_u − rank), orthonormal.
  [[nodiscard]] auto Q_u() const { return Q_.rightCols(Q_.cols() - rank_); }
  /// M Q_u: the generalized forces of those motions. n_u × (n_u − rank).
  [[nodiscard]] auto M_Q_u() const { return M_Q_u_.leftCols(Q_.cols() - rank_); }
  /// Basis of the generalized forces that contacts exert: n_u × rank, orthonormal.
  [[nodiscard]] auto Q_c() const { return Q_.leftCols(rank_); }
  /// The shortest u̇ with J_s u̇ = a, with `a` in the order of λ. Needs full rank.
  [[nodiscard]] GeneralizedVector shortest_motion(
      const Eigen::Ref<const Eigen::VectorXd>& a) const noexcept;
  [[nodiscard]] auto Lambda() const { return Lambda_.topRows(num_forces()); }
  [[nodiscard]] auto lambda_0() const { return lambda_0_.head(num_forces()); }

  /// Contact force of a leg at x in W [N]; zero without contact.
  [[nodiscard]] Vec3 force(Leg leg, const Eigen::Ref<const Eigen::VectorXd>& x) const noexcept;
  /// Its moment about the centre of the sole in W [N·m]; zero without contact, and of a sphere.
  [[nodiscard]] Vec3 moment(Leg leg, const Eigen::Ref<const Eigen::VectorXd>& x) const noexcept;

 private:
  using Stacked = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                kMaxVelocities, kMaxForces>;
  using Inverse = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxForces,
                                kMaxVelocities>;

  void stack_jacobians(const Dynamics& dynamics, const MotionPlan& plan);
  void invert();

  int num_contacts_ = 0, rows_ = 3;
  int rank_ = 0;
  PerLeg<int> first_force_ = per_leg(-1);
  Stacked J_s_transposed_;
  Eigen::ColPivHouseholderQR<Stacked> qr_;
  MassMatrix Q_;
  MassMatrix M_Q_u_;
  Inverse inverse_;  ///< (J_sᵀ)⁺
  ForceMap Lambda_;
  ForceVector lambda_0_ = ForceVector::Zero();
};

}  // namespace surefoot::model
