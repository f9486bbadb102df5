#pragma once

#include "surefoot/solver/householder.hpp"

#include <Eigen/Core>

namespace surefoot::solver {

/// min ‖B p + r‖ over the last columns of B. Updates its factorization when pairs of columns rotate
/// and when the number of free columns changes: O(d²) instead of a new factorization.
///
///     Uᵀ B P = [R; 0],   c = Uᵀ r        P reverses the columns, R is upper triangular (d × d)
///
/// so the free columns of B are the leading ones of R, independent of the columns before them.
/// Needs full column rank of B; the user confirms the end with a fresh factorization.
class TurningLeastSquares {
 public:
  TurningLeastSquares(Eigen::Index max_rows, Eigen::Index max_columns);

  /// Factorizes; false, and not running, if B is nearly rank deficient or has too few rows.
  bool start(const Eigen::Ref<const Eigen::MatrixXd>& B,
             const Eigen::Ref<const Eigen::VectorXd>& r);
  void stop() { is_running_ = false; }
  [[nodiscard]] bool is_running() const { return is_running_; }

  /// Columns (a, b) at `column` and `column` + 1 of B become (c a + s b, c b − s a).
  void rotate(Eigen::Index column, const Rotation& rotation);

  /// p, as many as there are free columns, minimises ‖B p + r‖.
  void step(Eigen::Ref<Eigen::VectorXd> p);

  /// r moves by `length` of the last step.
  void advance(Eigen::Index num_free, double length) { c_.head(num_free) *= 1.0 - length; }

 private:
  bool is_running_ = false;
  Eigen::Index num_columns_ = 0;
  Eigen::MatrixXd R_;
  Eigen::VectorXd c_;
};

}  // namespace surefoot::solver
