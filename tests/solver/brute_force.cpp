#include "tests/solver/brute_force.hpp"

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFeasible = 1e-9;

struct Row {
  VectorXd a;
  double lower, upper;
};

/// What a row does in one of the choices.
enum class Role { ignored, held_at_lower, held_at_upper, counts_below, counts_above };

double violation(const Row& row, const VectorXd& x) {
  const double value = row.a.dot(x);
  return std::max(0.0, value - row.upper) - std::max(0.0, row.lower - value);
}

std::vector<Role> roles(const Row& row, bool is_own) {
  if (row.lower == row.upper) return {is_own ? Role::counts_above : Role::held_at_upper};
  std::vector<Role> possible{Role::ignored};
  if (std::isfinite(row.lower)) possible.push_back(Role::held_at_lower);
  if (std::isfinite(row.upper)) possible.push_back(Role::held_at_upper);
  if (is_own && std::isfinite(row.lower)) possible.push_back(Role::counts_below);
  if (is_own && std::isfinite(row.upper)) possible.push_back(Role::counts_above);
  return possible;
}

/// All choices for one level.
class LevelSearch {
 public:
  LevelSearch(Index unknowns, const std::vector<Row>& constraints, const std::vector<Row>& own)
      : unknowns_(unknowns), rows_(constraints), num_constraints_(constraints.size()) {
    rows_.insert(rows_.end(), own.begin(), own.end());
    roles_.assign(rows_.size(), Role::ignored);
  }

  VectorXd best_x() {
    try_roles(0);
    return best_x_;
  }

 private:
  void try_roles(std::size_t row) {
    if (row == rows_.size()) {
      try_choice();
      return;
    }
    for (const Role role : roles(rows_[row], row >= num_constraints_)) {
      roles_[row] = role;
      try_roles(row + 1);
    }
  }

  void try_choice() {
    MatrixXd held(0, unknowns_), counting(0, unknowns_);
    VectorXd held_bound(0), counting_bound(0);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const bool is_lower = roles_[i] == Role::held_at_lower || roles_[i] == Role::counts_below;
      const double bound = is_lower ? rows_[i].lower : rows_[i].upper;
      const bool counts = roles_[i] == Role::counts_below || roles_[i] == Role::counts_above;
      if (roles_[i] == Role::ignored) continue;
      append(counts ? counting : held, counts ? counting_bound : held_bound, rows_[i].a, bound);
    }
    consider(minimum(held, held_bound, counting, counting_bound));
  }

  static void append(MatrixXd& A, VectorXd& b, const VectorXd& row, double bound) {
    A.conservativeResize(A.rows() + 1, Eigen::NoChange);
    A.bottomRows(1) = row.transpose();
    b.conservativeResize(b.size() + 1);
    b[b.size() - 1] = bound;
  }

  // min ‖counting x − b‖ subject to held x = d.
  VectorXd minimum(const MatrixXd& held, const VectorXd& d, const MatrixXd& counting,
                   const VectorXd& b) const {
    VectorXd x = VectorXd::Zero(unknowns_);
    MatrixXd Z = MatrixXd::Identity(unknowns_, unknowns_);
    if (held.rows() > 0 && held.norm() > 0.0) {
      const Eigen::FullPivLU<MatrixXd> lu(held);
      x = held.completeOrthogonalDecomposition().solve(d);
      Z = lu.dimensionOfKernel() > 0 ? MatrixXd(lu.kernel()) : MatrixXd(unknowns_, 0);
    }
    if (counting.rows() == 0 || Z.cols() == 0) return x;
    MatrixXd AZ = counting * Z;
    for (Index i = 0; i < AZ.rows(); ++i) {  // what depends on the held rows can't move
      if (AZ.row(i).norm() < 1e-9 * counting.row(i).norm()) AZ.row(i).setZero();
    }
    if (AZ.norm() == 0.0) return x;
    return x + Z * AZ.completeOrthogonalDecomposition().solve(b - counting * x);
  }

  void consider(const VectorXd& x) {
    double sum = 0.0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double v = violation(rows_[i], x);
      if (i >= num_constraints_) {
        sum += v * v;
      } else if (std::abs(v) > kFeasible * (1.0 + rows_[i].a.norm() * x.norm())) {
        return;
      }
    }
    if (sum >= best_) return;
    best_ = sum;
    best_x_ = x;
  }

  Index unknowns_;
  std::vector<Row> rows_;
  std::size_t num_constraints_;
  std::vector<Role> roles_;
  double best_ = std::numeric_limits<double>::infinity();
  VectorXd best_x_;
};

}  // namespace

std::vector<double> brute_force_residuals(Index unknowns, const HierarchyData& levels) {
  std::vector<double> residuals;
  std::vector<Row> constraints;
  for (const LevelData& level : levels) {
    std::vector<Row> own;
    for (Index i = 0; i < level.lower.size(); ++i) {
      own.push_back({level.A.row(i).transpose(), level.lower[i], level.upper[i]});
    }
    const VectorXd x = LevelSearch(unknowns, constraints, own).best_x();
    double sum = 0.0;
    for (Row& row : own) {
      const double v = violation(row, x);
      sum += v * v;
      // The violation at the optimum is unique: it is what lower levels have to keep.
      if (row.lower == row.upper) {
        row.lower = row.upper = row.a.dot(x);
      } else {
        row.upper += std::max(0.0, v);
        row.lower += std::min(0.0, v);
      }
      constraints.push_back(row);
    }
    residuals.push_back(std::sqrt(sum));
  }
  return residuals;
}

}  // namespace surefoot::test
