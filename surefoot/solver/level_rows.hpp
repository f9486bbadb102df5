#pragma once

#include "surefoot/solver/tableau.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace surefoot {

/// The rows of the level being solved and their share in its objective
///
///     φ(z) = ½ Σ rᵢ²,   rᵢ = value − upper above it, value − lower below it, 0 between (Eq. 9
///                       with the slacks v, w eliminated: they are the violations themselves)
///
/// φ is convex, differentiable and quadratic in pieces; a piece is a choice of sides.
class LevelRows {
 public:
  enum class Side : std::int8_t { below = -1, inside = 0, above = 1, equality = 2 };

  explicit LevelRows(Eigen::Index max_rows);

  /// Reads sides and residuals off the values in the tableau.
  void update(const Tableau& tableau);

  /// Rows that count in the present piece, as tableau rows, and their residuals.
  [[nodiscard]] Eigen::Index num_counting() const { return num_counting_; }
  [[nodiscard]] Eigen::Index counting(Eigen::Index i) const {
    return counting_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] auto counting_residuals() const { return counting_residual_.head(num_counting_); }

  [[nodiscard]] bool has_inequalities() const { return has_inequalities_; }

  /// Residuals of all rows of the level; zero where a row does not count.
  [[nodiscard]] auto residuals() const { return residual_.head(num_rows_); }

  [[nodiscard]] Side side(Eigen::Index i) const { return side_[static_cast<std::size_t>(i)]; }

  /// Length of the step along the tableau's motion to the exact minimum of φ, at most `limit`.
  [[nodiscard]] double minimum_along(const Tableau& tableau, double limit);

  /// After `minimum_along` and the move: nothing is left to gain with the constraints now held.
  [[nodiscard]] bool is_stationary(const Tableau& tableau, double length) const;

 private:
  [[nodiscard]] double residual(const Tableau& tableau, Eigen::Index i, Side side,
                                double step) const;
  [[nodiscard]] double break_point(const Tableau& tableau, Eigen::Index i, double step) const;
  void cross(const Tableau& tableau, Eigen::Index i);
  [[nodiscard]] double newton_step(const Tableau& tableau, double step) const;

  Eigen::Index num_rows_ = 0, num_counting_ = 0;
  bool has_inequalities_ = false;
  std::vector<Side> side_;        // at the last update
  std::vector<Side> moved_side_;  // at the end of the last search
  std::vector<Eigen::Index> counting_;
  Eigen::VectorXd residual_, counting_residual_;
};

}  // namespace surefoot
