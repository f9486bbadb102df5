// How the solver's answer becomes a Solution.
#include "surefoot/solver/lexicographic_solver.hpp"
#include "surefoot/solver/row_states.hpp"
#include "surefoot/solver/tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

using Index = Eigen::Index;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

signed char side_of(RowState state) {
  const int side = static_cast<int>(state);
  if (state == RowState::equality) return 2;
  return static_cast<signed char>((side > 0) - (side < 0));
}

}  // namespace

// The end of a budget. The levels before that of the point are finished.
void LexicographicSolver::take_kept_point() {
  Sweep& s = memory_.sweep;
  std::copy_n(kept_.x.data(), s.unknowns, s.x);
  kernels_.evaluate(s, s.level_begin[first_level_], s.num_rows);
  solution_.status = SolveStatus::iteration_cap;
  solution_.failed_level = std::min(kept_.level, s.num_levels - 1);
  for (int k = first_level_; k < s.num_levels; ++k) {
    solution_.levels[at(k)].degrees_of_freedom_left = kept_.freedom_left[at(k)];
  }
}

void LexicographicSolver::take_from_cascade(const Hierarchy& hierarchy) {
  const Solution& solution = cascade_.solve(hierarchy);
  solution_.status = solution.status;
  solution_.failed_level = solution.failed_level;
  solution_.x = solution.x;
  Sweep& s = memory_.sweep;
  for (std::size_t k = 0; k < solution_.levels.size(); ++k) {
    const LevelResult& from = solution.levels[k];
    LevelResult& to = solution_.levels[k];
    to.residual = from.residual;
    to.num_rows = from.num_rows;
    to.degrees_of_freedom_left = from.degrees_of_freedom_left;
    to.iterations = from.iterations;
    to.time = from.time;
    for (std::size_t i = 0; i < at(to.num_rows); ++i) {
      to.rows[i] = from.rows[i];
      s.side[at(s.level_begin[k]) + i] = side_of(from.rows[i]);
    }
  }
}

void LexicographicSolver::describe(const Hierarchy& hierarchy) {
  Sweep& s = memory_.sweep;
  for (int i = 0; i < s.unknowns; ++i) solution_.x[i] = s.x[i];
  kernels_.evaluate(s, 0, s.level_begin[first_level_]);
  const double tolerance = tolerance::kAtBound * solution_.x.norm();
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    LevelResult& result = solution_.levels[k];
    result.iterations = num_sweeps_;
    result.time = 0.0;
    result.num_rows = hierarchy.level(k).num_rows();
    double sum = 0.0;
    const int begin = s.level_begin[k];
    const double *value = s.value + begin, *scale = s.scale + begin;
    const double *lower = s.lower + begin, *upper = s.upper + begin;
    RowState* states = result.rows.data();
    for (Index i = 0; i < result.num_rows; ++i) {
      const double violation = std::max(std::max(0.0, lower[i] - value[i]), value[i] - upper[i]);
      sum += violation * violation;
      states[i] = state_of(value[i], lower[i], upper[i], tolerance * scale[i]);
    }
    result.residual = std::sqrt(sum);
  }
}

// A column counts for the level that fixed its row.
void LexicographicSolver::count_freedom() {
  const Sweep& s = memory_.sweep;
  for (int k = first_level_; k < s.num_levels; ++k) {
    solution_.levels[at(k)].degrees_of_freedom_left = s.columns;
  }
  for (int k = first_level_; k < s.num_levels; ++k) {
    for (int column = s.first_column[k]; column < s.first_column[k + 1]; ++column) {
      const int row = s.pivot[column];
      const int fixed_by = row >= 0 ? search_.fixed_by(row) : k;
      for (int j = fixed_by; j < s.num_levels; ++j) {
        --solution_.levels[at(j)].degrees_of_freedom_left;
      }
    }
  }
}

}  // namespace surefoot
