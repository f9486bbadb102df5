#include "surefoot/tasks/physics_substitution.hpp"

#include <cmath>
#include <limits>

namespace surefoot::tasks {
namespace {

/// Preference for eliminating a contact force of 1 N over a motion that takes 1 N.
constexpr double kForceWeight = 30.0;

}  // namespace

PhysicsSubstitution::PhysicsSubstitution(int num_joints) {
  const int num_velocities = kNumBase + num_joints;
  substitution_.num_levels = 2;
  substitution_.basis.setZero(num_velocities + num_joints, num_joints);
  substitution_.offset.setZero(num_velocities + num_joints);
  P_.setZero(num_velocities, num_velocities);
  base_rows_.setZero(kNumBase, num_velocities + 1);
}

const solver::Substitution* PhysicsSubstitution::update(
    const model::Dynamics& dynamics, const model::SupportDynamics& support,
    const Eigen::Ref<const Eigen::VectorXd>& contact_acceleration) noexcept {
  const int rank = support.rank();
  if (rank != support.num_forces() || contact_acceleration.size() != rank) return nullptr;
  const int num_motions = dynamics.num_velocities() - rank;
  P_.leftCols(num_motions) = support.M_Q_u();
  P_.rightCols(rank) = -support.Q_c();
  motion_ = support.shortest_motion(contact_acceleration);
  const GeneralizedVector forces = dynamics.M * motion_ + dynamics.h;
  base_rows_.leftCols(dynamics.num_velocities()) = P_.topRows<kNumBase>();
  base_rows_.col(dynamics.num_velocities()) = -forces.head<kNumBase>();
  if (!solve_base_rows(num_motions)) return nullptr;
  write_offset(support, forces);
  write_basis(support);
  return substitution_.offset.allFinite() ? &substitution_ : nullptr;
}

/// Gauss-Jordan elimination with full pivoting.
bool PhysicsSubstitution::solve_base_rows(int num_motions) {
  is_chosen_.fill(false);
  for (int step = 0; step < kNumBase; ++step) {
    if (!take_pivot(step, num_motions)) return false;
    const int column = chosen_[static_cast<std::size_t>(step)];
    base_rows_.row(step) /= base_rows_(step, column);
    for (int row = 0; row < kNumBase; ++row) {
      if (row == step) continue;
      const double factor = base_rows_(row, column);
      base_rows_.row(row) -= factor * base_rows_.row(step);
    }
  }
  return true;
}

/// Moves the row with the largest remaining element to `step`, and chooses its column.
bool PhysicsSubstitution::take_pivot(int step, int num_motions) {
  double largest = 0.0;
  int pivot_row = step, pivot_column = -1;
  for (int column = 0; column < P_.cols(); ++column) {
    if (is_chosen_[static_cast<std::size_t>(column)]) continue;
    const double weight = column < num_motions ? 1.0 : kForceWeight;
    for (int row = step; row < kNumBase; ++row) {
      const double size = weight * std::abs(base_rows_(row, column));
      if (size <= largest) continue;
      largest = size;
      pivot_row = row;
      pivot_column = column;
    }
  }
  if (pivot_column < 0 || !std::isfinite(largest)) return false;
  chosen_[static_cast<std::size_t>(step)] = pivot_column;
  is_chosen_[static_cast<std::size_t>(pivot_column)] = true;
  base_rows_.row(step).swap(base_rows_.row(pivot_row));
  return true;
}

/// x at y = 0: only the six chosen unknowns are non-zero.
void PhysicsSubstitution::write_offset(const model::SupportDynamics& support,
                                       const GeneralizedVector& forces) {
  const Eigen::Index n = substitution_.basis.cols();
  auto motion = substitution_.offset.head(P_.rows());
  auto torque = substitution_.offset.tail(n);
  motion = motion_;
  torque = forces.tail(n);
  for (int i = 0; i < kNumBase; ++i) {
    const int column = chosen_[static_cast<std::size_t>(i)];
    const double value = base_rows_(i, P_.cols());
    torque += value * P_.col(column).tail(n);
    if (column < support.Q_u().cols()) motion += value * support.Q_u().col(column);
  }
}

void PhysicsSubstitution::write_basis(const model::SupportDynamics& support) {
  const auto Q_u = support.Q_u();
  const Eigen::Index n = substitution_.basis.cols();
  Eigen::Matrix<double, Eigen::Dynamic, kNumBase, Eigen::RowMajor, kMaxJoints, kNumBase>
      torque_of_chosen(n, kNumBase);
  Eigen::Matrix<double, kNumBase, Eigen::Dynamic, Eigen::RowMajor, kNumBase, kMaxJoints>
      chosen_of_free(kNumBase, n);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, kMaxJoints, kMaxJoints>
      torque(n, n);
  auto motion = substitution_.basis.topRows(P_.rows());
  motion.setZero();
  int next = 0;
  for (int column = 0; column < P_.cols(); ++column) {
    if (is_chosen_[static_cast<std::size_t>(column)]) continue;
    if (column < Q_u.cols()) motion.col(next) = Q_u.col(column);
    torque.col(next) = P_.col(column).tail(n);
    chosen_of_free.col(next++) = base_rows_.col(column);
  }
  for (int i = 0; i < kNumBase; ++i) {
    const int column = chosen_[static_cast<std::size_t>(i)];
    torque_of_chosen.col(i) = P_.col(column).tail(n);
    if (column < Q_u.cols()) motion.noalias() -= Q_u.col(column) * chosen_of_free.row(i);
  }
  torque.noalias() -= torque_of_chosen * chosen_of_free;
  substitution_.basis.bottomRows(n) = torque;
}

}  // namespace surefoot::tasks
