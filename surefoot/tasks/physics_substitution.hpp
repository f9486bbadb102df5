#pragma once

#include "surefoot/model/support_dynamics.hpp"
#include "surefoot/solver/substitution.hpp"

#include <array>

namespace surefoot::tasks {

/// All x = (u̇, τ) that the equations of motion and the stance feet allow, in closed form:
/// x = offset + basis · y with n_τ unknowns y, for any number of stance feet.
///
/// With u̇₀ the shortest motion that satisfies the contacts and g the contact forces in the basis
/// Q_c,
///
///     u̇ = u̇₀ + Q_u w,     J_sᵀ λ = Q_c g,     P = [M Q_u  −Q_c],     p = (w, g),   n_u unknowns
///     Sᵀ τ = P p + M u̇₀ + h     whose six base rows have no torque:
///     P_b p = −(M u̇₀ + h)_b     so six of p follow from the others, y (paper, Eqs. 4–7)
///
/// and the joints' rows are the torques. P has full rank: a vector orthogonal to Q_c and M Q_u is a
/// motion Q_u a without kinetic energy. The six are chosen by size, contact forces before motions,
/// so that most unknowns of y are plain motions or plain contact forces.
class PhysicsSubstitution {
 public:
  explicit PhysicsSubstitution(int num_joints);

  /// `contact_acceleration` is the required J_s u̇, in the order of `support`. Null if the contacts
  /// are singular by `SupportDynamics::kRankTolerance` (J_s u̇ may have no solution) or a number is
  /// not finite. The result stays valid until the next call. Does not allocate.
  [[nodiscard]] const solver::Substitution* update(
      const model::Dynamics& dynamics, const model::SupportDynamics& support,
      const Eigen::Ref<const Eigen::VectorXd>& contact_acceleration) noexcept;

 private:
  static constexpr int kNumBase = 6;

  [[nodiscard]] bool solve_base_rows(int num_motions);
  [[nodiscard]] bool take_pivot(int step, int num_motions);
  void write_offset(const model::SupportDynamics& support, const GeneralizedVector& forces);
  void write_basis(const model::SupportDynamics& support);

  model::MassMatrix P_;
  /// [P_b  −(M u̇₀ + h)_b], then solved for the columns `chosen_`, one a row.
  Eigen::Matrix<double, kNumBase, Eigen::Dynamic, Eigen::RowMajor, kNumBase, kMaxVelocities + 1>
      base_rows_;
  std::array<int, kNumBase> chosen_{};
  std::array<bool, kMaxVelocities> is_chosen_{};
  GeneralizedVector motion_;  ///< u̇₀
  solver::Substitution substitution_;
};

}  // namespace surefoot::tasks
