#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace surefoot::solver {

enum class SolveStatus : int {
  optimal = 0,  ///< every level is at its lexicographic optimum; for `SoftLevels::between`: both
                ///< sides are
  /// Ended early at `failed_level`, at the cap of iterations or of the budget; all levels before
  /// are optimal, and x is feasible for them. If it is the number of levels, all are optimal, and
  /// only x is not the shortest yet.
  iteration_cap = 1,
  /// NaN, lower > upper, impossible infinities, a row or a finite bound beyond
  /// `tolerance::kLargest` (1e150), or a level with too many rows: then `failed_level` is the first
  /// such level. −1: the hierarchy exceeds the capacity or has other unknowns, or ‖x‖² or a
  /// residual overflows. x is zero.
  invalid_input = 2,
};

/// State of a row at the solution.
enum class RowState : std::int8_t {
  inactive = 0,
  at_lower = -1,  ///< held at its lower bound
  at_upper = 1,   ///< held at its upper bound
  equality = 2,
  below_lower = -3,  ///< violated
  above_upper = 3,
};

struct LevelResult {
  double residual = 0.0;  ///< √Σ violation² over the weighted rows of this level
  Eigen::Index num_rows = 0;
  Eigen::Index degrees_of_freedom_left = 0;  ///< columns of the null space after this level
  /// Of the active-set method. LexicographicSolver solves all levels at once: then the number of
  /// sweeps, for every level, unless the cascade solved.
  int iterations = 0;
  /// Time of solving this level [s], over all sweeps; 0 without a clock, or if it was not solved
  /// alone: several levels of equalities before the first inequality are solved at once. Shared
  /// work, like set-up and rows' states, counts in none.
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
  /// If the status isn't optimal: index of the level, from 0; −1: none, or no single one.
  int failed_level = -1;
  /// Rounding decides which answer is the optimum. Either the solver found two answers with
  /// different residuals, and x is the better one, or a decision was too close to call: a row was
  /// almost dependent on those above it, or a limit was hardly needed
  /// (`tolerance::kBorderlinePivot`, `kBorderlineForce`), or it was slightly clearer and there was
  /// no second answer. False for an answer that ended early.
  bool borderline = false;
  bool is_swept = false;  ///< found by sweeps, whose number is every level's `iterations`
  double time = 0.0;      ///< of solving [s]; 0 without a clock
  /// Additions and multiplications by the count of a budget (`SolveBudget`), without the cascade's.
  double flops = 0.0;
};

}  // namespace surefoot::solver
