#pragma once

#include "surefoot/solver/tolerances.hpp"

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <vector>

namespace surefoot::solver {

/// Values of rows at a point, and their motion along a line; the current level has the rows
/// [level_begin, num_rows).
struct RowValues {
  const double* value;
  const double* lower;
  const double* upper;
  const double* scale;   ///< length of the row
  const double* motion;  ///< change of the value with a step of length 1
  Eigen::Index level_begin, num_rows;
  double x_size;  ///< largest ‖x‖ so far, or an upper bound

  /// Rounding of row i's value.
  [[nodiscard]] double noise(Eigen::Index i) const {
    return tolerance::kRounding * scale[i] * x_size;
  }

  /// Motion of row i; 0 if a step of length 1 changes only rounding, so that no search follows it
  /// far away.
  [[nodiscard]] double rate(Eigen::Index i) const {
    return std::abs(motion[i]) > noise(i) ? motion[i] : 0.0;
  }
};

/// The rows of the current level and their share in its objective
///
///     φ(z) = ½ Σ rᵢ²,   rᵢ = value − upper above it, value − lower below it, 0 between (Eq. 9
///                       with the slacks v, w eliminated: they are the violations themselves)
///
/// φ is convex, differentiable and piecewise quadratic; a piece is a choice of sides.
class LevelRows {
 public:
  enum class Side : std::int8_t { below = -1, inside = 0, above = 1, equality = 2 };

  explicit LevelRows(Eigen::Index max_rows);

  /// Before the first update of a level.
  void enter(const RowValues& values);

  /// Updates sides and residuals from the values.
  void update(const RowValues& values);

  /// Counting rows of the current piece, and their residuals.
  [[nodiscard]] Eigen::Index num_counting() const { return num_counting_; }
  [[nodiscard]] Eigen::Index counting(Eigen::Index i) const {
    return counting_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] auto counting_residuals() const { return counting_residual_.head(num_counting_); }

  /// Rounding of a row's motion in the step to the current piece's minimum: contradicting residuals
  /// cancel, which leaves rounding of the largest.
  [[nodiscard]] double rounding_of_step() const {
    return tolerance::kRounding * counting_residuals().norm();
  }

  [[nodiscard]] bool has_inequalities() const { return has_inequalities_; }

  /// Residuals of all rows of the level; zero for rows that do not count.
  [[nodiscard]] auto residuals() const { return residual_.head(num_rows_); }

  [[nodiscard]] Side side(Eigen::Index i) const { return side_[static_cast<std::size_t>(i)]; }

  /// Length of the step along the motion to the exact minimum of φ, at most `limit`.
  [[nodiscard]] double minimum_along(const RowValues& values, double limit);

  /// After `minimum_along`: did x move? Counts changes of the piece at one point.
  void note_step(bool has_moved);

  /// After `note_step` and the move: is nothing left to gain with the held constraints?
  [[nodiscard]] bool is_stationary(const RowValues& values, double length) const;

 private:
  /// Consecutive changes of the piece at one point; more are rounding.
  static constexpr int kMaxChangesInPlace = 20;

  [[nodiscard]] bool has_crossed() const;
  [[nodiscard]] Side present_side(const RowValues& values, Eigen::Index i) const;
  [[nodiscard]] double residual(const RowValues& values, Eigen::Index i, Side side,
                                double step) const;
  [[nodiscard]] double break_point(const RowValues& values, Eigen::Index i, double step) const;
  void cross(Eigen::Index i);
  [[nodiscard]] double newton_step(const RowValues& values, double step) const;

  Eigen::Index num_rows_ = 0, num_counting_ = 0;
  int changes_in_place_ = 0;
  bool has_inequalities_ = false, has_moved_ = false;
  std::vector<Side> side_;        // at the last update
  std::vector<Side> moved_side_;  // at the end of the last search
  std::vector<Eigen::Index> counting_;
  Eigen::VectorXd rate_;  // of the current search
  Eigen::VectorXd residual_, counting_residual_;
};

}  // namespace surefoot::solver
