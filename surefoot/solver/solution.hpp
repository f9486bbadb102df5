#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace surefoot {

enum class SolveStatus : int {
  optimal = 0,  ///< every level is at its lexicographic optimum
  iteration_cap =
      1,  ///< ended early at `failed_level`; all levels before are optimal, x is feasible for them
  invalid_input = 2,  ///< NaN, or lower > upper, or infinities that make no sense; x is zero
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
  double residual = 0.0;  ///< √Σ violation², unweighted, over the rows of this level
  Eigen::Index num_rows = 0;
  Eigen::Index degrees_of_freedom_left = 0;  ///< columns of the null space after this level
  int iterations = 0;                        ///< of the active-set method
  double time = 0.0;  ///< that the level took [s]; 0 unless CascadeSolver was given a clock
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
  int failed_level = -1;  ///< where the status isn't optimal; −1: none
  double time = 0.0;      ///< that solving took [s]; 0 unless the solver was given a clock
};

}  // namespace surefoot
