#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/householder.hpp"
#include "surefoot/solver/level_rows.hpp"

#include <Eigen/Core>

#include <vector>

namespace surefoot::solver {

/// All rows that still matter, in a basis of the unknowns that simplifies the next step.
///
/// The basis Q is orthogonal; its columns from `first_free` on span the null space Z of all fixed
/// rows (Eqs. 12, 13). Row i of T holds aᵢ Q. The first `unknowns` rows are the identity's, so
/// there T = Q and value = x. Then come rows of finished levels that are still inequalities, then
/// the rows of the current level:
///
///     [0, unknowns)  x   |   [unknowns, level_begin)  constraints   |   [level_begin, num_rows)
///     level
///
/// Columns before `first_free` are stale: nothing moves along them.
class Tableau {
 public:
  Tableau(Eigen::Index unknowns, Eigen::Index max_rows);

  /// Z = I, x = 0, no rows.
  void reset();

  /// Adds the rows of the next level: T = A Z, value = A x.
  void append(const Level& level);

  /// Q ← Q (I − β v vᵀ) on the columns from `first`, as many as v has, in all rows.
  void reflect(Eigen::Index first, const Eigen::Ref<const Eigen::VectorXd>& v, double beta);

  /// Rotates the columns `first` and `first` + 1 so that T(row, first + 1) becomes zero.
  Rotation rotate(Eigen::Index row, Eigen::Index first);

  /// Rotates pairs of neighbouring columns, the last pair first, until T(row, :) is zero after
  /// column `first`; rotations[k] is that of the columns `first` + k and `first` + k + 1.
  void gather(Eigen::Index row, Eigen::Index first, std::vector<Rotation>& rotations);

  /// Moves x and the values of all rows by `step` · T(:, first …) p; see `motion`.
  void move(double step);

  /// motion ← T(:, first …) p, the rate of all values along p; 0 for rounding, and for rows that
  /// depend on those before `first`, see `RankTolerance::keep`.
  void set_direction(Eigen::Index first, const Eigen::Ref<const Eigen::VectorXd>& p,
                     double rounding);

  /// Is at most `rounding` ‖aᵢ‖ left of row i in the columns from `first` on?
  [[nodiscard]] bool is_dependent(Eigen::Index row, Eigen::Index first, double rounding) const;

  /// Ends a level: drops rows without `keep`, and makes the others constraints.
  void retire();

  /// Rounding of row i's value.
  [[nodiscard]] double noise(Eigen::Index i) const { return row_values().noise(i); }

  [[nodiscard]] RowValues row_values() const {
    return {value.data(),  lower.data(), upper.data(), scale.data(),
            motion.data(), level_begin,  num_rows,     x_size};
  }

  [[nodiscard]] Eigen::Index num_free() const { return unknowns - first_free; }
  [[nodiscard]] auto rows(Eigen::Index first_column, Eigen::Index columns) {
    return T.block(0, first_column, num_rows, columns);
  }

  Eigen::Index unknowns;
  Eigen::Index first_free = 0;
  Eigen::Index level_begin = 0;
  Eigen::Index num_rows = 0;
  double x_size = 0.0;  ///< largest ‖x‖ so far

  Eigen::MatrixXd T;
  Eigen::VectorXd value, lower, upper;  ///< by row
  Eigen::VectorXd scale;                ///< length of the row in the space of x
  Eigen::VectorXd motion;
  std::vector<char> keep;  ///< by row; set by the level before `retire`
  std::vector<char> held;  ///< by row; 1 while in the working set
  Eigen::VectorXd scratch;
};

}  // namespace surefoot::solver
