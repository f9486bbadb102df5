#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace surefoot {

enum class SolveStatus : int {
  optimal = 0,  ///< every level is at its lexicographic optimum; of `SoftLevels::between`: both
                ///< of its sides are, and x is what it promises between them
  /// ended early at `failed_level`, at the cap of iterations or of the budget; all levels before
  /// are optimal, x is feasible for them. The number of levels where all are: then x is only not
  /// yet the shortest
  iteration_cap = 1,
  /// NaN, or lower > upper, or infinities that make no sense, or a row or a finite bound larger
  /// than `tolerance::kLargest` (1e150), or a level with more rows than it has room for: then
  /// `failed_level` is the first such level. −1: a hierarchy beyond the capacity or with other
  /// unknowns than it, be they fewer, or an ‖x‖² or a residual beyond the range of doubles. x is
  /// zero
  invalid_input = 2,
};

/// What a row of a level does at the solution.
enum class RowState : std::int8_t {
  inactive = 0,
  at_lower = -1,  ///< held at its lower bound
  at_upper = 1,   ///< held at its upper bound
  equality = 2,
  below_lower = -3,  ///< violated: the level could not reach it
  above_upper = 3,
};

struct LevelResult {
  double residual = 0.0;  ///< √Σ violation² over the rows of this level, as they are weighted
  Eigen::Index num_rows = 0;
  Eigen::Index degrees_of_freedom_left = 0;  ///< columns of the null space after this level
  /// Of the active-set method. LexicographicSolver solves all levels at once: there it is the
  /// number of sweeps, of every level, and only where the cascade had to solve its own.
  int iterations = 0;
  /// That solving this level took [s], over all sweeps; 0 without a clock, and where it was not
  /// solved by itself: several levels of equalities before the first inequality are solved at
  /// once. What no level has alone, like setting up and the rows' states, counts in none.
  double time = 0.0;
  std::vector<RowState> rows;  ///< capacity max_rows; the first num_rows are valid
  [[nodiscard]] int num_active() const {
    int count = 0;
    for (Eigen::Index i = 0; i < num_rows; ++i) {
      const RowState state = rows[static_cast<std::size_t>(i)];
      count += (state != RowState::inactive && state != RowState::equality) ? 1 : 0;
    }
    return count;
  }
};

/// The lexicographic optimum of a hierarchy.
struct Solution {
  SolveStatus status = SolveStatus::invalid_input;
  Eigen::VectorXd x;
  std::vector<LevelResult> levels;
  /// Where the status isn't optimal: index of the level, from 0; −1: none, or no single one.
  int failed_level = -1;
  /// Which answer is the optimum depends on less than doubles can tell. Either the solver came to
  /// two answers whose residuals differ, and x is the better one, or a decision was too close to
  /// call: hardly anything was left of a row beside those above it, or hardly any force needed a
  /// limit (`tolerance::kBorderlinePivot`, `kBorderlineForce`), or that was only a little clearer
  /// and there was no second answer. False of an answer that ended early.
  bool borderline = false;
  bool is_swept = false;  ///< found by sweeps, whose number is `iterations` of every level
  double time = 0.0;      ///< that solving took [s]; 0 unless the solver was given a clock
  /// Additions and multiplications that a budget would have counted (`SolveBudget`): without those
  /// of a cascade.
  double flops = 0.0;
};

}  // namespace surefoot
