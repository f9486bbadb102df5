#include "surefoot/model/support_dynamics.hpp"

namespace surefoot::model {

void SupportDynamics::update(const Dynamics& dynamics, const MotionPlan& plan) noexcept {
  stack_jacobians(dynamics, plan);
  const int n_u = dynamics.num_velocities(), n_tau = dynamics.num_joints();
  M_Q_u_.resize(n_u, n_u);
  Lambda_.resize(rows_ * dynamics.num_legs(), n_u + n_tau);
  if (num_contacts_ == 0) {
    rank_ = 0;
    Q_.setIdentity(n_u, n_u);
    M_Q_u_ = dynamics.M;
    return;
  }
  qr_.setThreshold(kRankTolerance);
  qr_.compute(J_s_transposed_);
  rank_ = static_cast<int>(qr_.rank());
  Q_ = qr_.householderQ();
  M_Q_u_.leftCols(n_u - rank_).noalias() = dynamics.M * Q_u();
  invert();
  const int n = num_forces();
  Lambda_.topLeftCorner(n, n_u).noalias() = inverse_ * dynamics.M;
  Lambda_.topRightCorner(n, n_tau) = -inverse_.rightCols(n_tau);
  lambda_0_.head(n).noalias() = inverse_ * dynamics.h;
}

Vec3 SupportDynamics::force(Leg leg, const Eigen::Ref<const Eigen::VectorXd>& x) const noexcept {
  if (!in_contact(leg)) return Vec3::Zero();
  const int row = first_force(leg);
  return Lambda_.middleRows<3>(row) * x + lambda_0_.segment<3>(row);
}

Vec3 SupportDynamics::moment(Leg leg, const Eigen::Ref<const Eigen::VectorXd>& x) const noexcept {
  if (rows_ == 3 || !in_contact(leg)) return Vec3::Zero();
  const int row = first_force(leg) + 3;
  return Lambda_.middleRows<3>(row) * x + lambda_0_.segment<3>(row);
}

/// J_s = Π Rᵀ Q_cᵀ, so u̇ = Q_c R⁻ᵀ Πᵀ a.
GeneralizedVector SupportDynamics::shortest_motion(
    const Eigen::Ref<const Eigen::VectorXd>& a) const noexcept {
  if (rank_ == 0) return GeneralizedVector::Zero(Q_.rows());
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxForces, 1> in_Q_c =
      qr_.colsPermutation().transpose() * a;
  qr_.matrixR()
      .topLeftCorner(rank_, rank_)
      .triangularView<Eigen::Upper>()
      .transpose()
      .solveInPlace(in_Q_c);
  return Q_c() * in_Q_c;
}

void SupportDynamics::stack_jacobians(const Dynamics& dynamics, const MotionPlan& plan) {
  num_contacts_ = 0;
  rows_ = dynamics.contact_rows();
  J_s_transposed_.resize(dynamics.num_velocities(), rows_ * plan.num_contacts());
  first_force_.resize(dynamics.num_legs());
  for (const Leg leg : first_force_.legs()) {
    first_force_[index(leg)] = -1;
    if (!plan.contact(leg)) continue;
    const int first = rows_ * num_contacts_;
    first_force_[index(leg)] = first;
    J_s_transposed_.middleCols<3>(first) = dynamics.contact[index(leg)].J.transpose();
    if (rows_ == 6)
      J_s_transposed_.middleCols<3>(first + 3) = dynamics.shank[index(leg)].J.transpose();
    ++num_contacts_;
  }
}

/// At full rank (J_sᵀ)⁺ = Π R⁻¹ Q_cᵀ. Otherwise the r remaining rows of R are wide, and R_rᵀ = Z L
/// gives the least-norm solution Π Z L⁻ᵀ Q_cᵀ.
void SupportDynamics::invert() {
  const int n = num_forces();
  Inverse solution = Inverse::Zero(n, Q_.rows());
  auto solved = solution.topRows(rank_);
  solved = Q_.leftCols(rank_).transpose();
  const auto R = qr_.matrixR();
  if (rank_ == n) {
    R.topLeftCorner(n, n).triangularView<Eigen::Upper>().solveInPlace(solved);
  } else {
    using Wide = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxForces,
                               kMaxForces>;
    Wide wide = Wide::Zero(n, rank_);
    wide = R.topRows(rank_).triangularView<Eigen::Upper>().toDenseMatrix().transpose();
    const Eigen::HouseholderQR<Wide> second(wide);
    second.matrixQR().topRows(rank_).triangularView<Eigen::Upper>().transpose().solveInPlace(
        solved);
    solution.applyOnTheLeft(second.householderQ());
  }
  inverse_.noalias() = qr_.colsPermutation() * solution;
}

}  // namespace surefoot::model
