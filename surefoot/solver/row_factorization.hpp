#pragma once

#include "surefoot/solver/tolerances.hpp"

#include <Eigen/Core>

#include <vector>

namespace surefoot::solver {

/// Rank-revealing orthogonal factorization of a stack of rows K (m × d),
///
///     P K = [L 0] Qᵀ,   L lower trapezoidal (m × rank),   Q = H₁ H₂ … of Householder reflections,
///
/// with rows chosen by the largest relative remaining length. The columns of Q past `num_fixed()`
/// span the null space N(K) of Eq. 12. Memory is fixed at construction.
class RowFactorization {
 public:
  RowFactorization(Eigen::Index max_rows, Eigen::Index max_columns);

  /// Storage for the rows, one a column (d × m), and for their lengths in the space of x, to be
  /// filled before `compute`.
  [[nodiscard]] auto rows_to_fill(Eigen::Index num_rows, Eigen::Index num_columns) {
    num_rows_ = num_rows;
    num_columns_ = num_columns;
    return K_.topLeftCorner(num_columns, num_rows);
  }
  [[nodiscard]] auto scales_to_fill() { return scale_.head(num_rows_); }

  void compute(const RankTolerance& tolerance);

  /// Directions that are no longer free: usable ones, and those too weak to use.
  [[nodiscard]] Eigen::Index num_fixed() const { return num_fixed_; }
  /// Is a direction fixed that was too weak to use?
  [[nodiscard]] bool has_unused() const { return num_fixed_ > rank_; }
  /// Smallest relative length among the used pivots; 1 if there are none.
  [[nodiscard]] double smallest_pivot() const { return smallest_pivot_; }

  /// p (d) of minimum norm among the minimisers of ‖K p + r‖ within the usable directions.
  void least_squares_step(const Eigen::Ref<const Eigen::VectorXd>& r,
                          Eigen::Ref<Eigen::VectorXd> p);

  /// T ← T Q, for T (k × d); `scratch` has k elements.
  void apply_on_the_right(Eigen::Ref<Eigen::MatrixXd> T, Eigen::Ref<Eigen::VectorXd> scratch);

 private:
  [[nodiscard]] Eigen::Index choose_pivot(Eigen::Index step) const;
  void swap_rows(Eigen::Index i, Eigen::Index j);
  void eliminate(Eigen::Index step);
  void downdate_length(Eigen::Index step, Eigen::Index row);
  void solve_triangle(const Eigen::Ref<const Eigen::VectorXd>& r);
  void solve_trapezoid(const Eigen::Ref<const Eigen::VectorXd>& r);
  void pivot_trapezoid(Eigen::Index s);

  Eigen::Index num_rows_ = 0, num_columns_ = 0, rank_ = 0, num_fixed_ = 0;
  double smallest_pivot_ = 1.0;
  Eigen::MatrixXd K_;      // d × m: reflections below the diagonal, Lᵀ above
  Eigen::VectorXd scale_;  // m, moves with the rows
  Eigen::VectorXd beta_;
  Eigen::VectorXd length_, reference_length_;
  std::vector<Eigen::Index> order_;  // position → row as filled
  Eigen::VectorXd v_, q_;
  // Second factorization of the trapezoid, for rows and columns of any scale.
  Eigen::MatrixXd G_;
  Eigen::VectorXd c_;
  std::vector<Eigen::Index> column_order_;
};

}  // namespace surefoot::solver
