// Converts the solver's answer to a Solution.
#include "surefoot/solver/answer_comparison.hpp"
#include "surefoot/solver/index.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
#include "surefoot/solver/row_states.hpp"
#include "surefoot/solver/tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::solver {
namespace {

// The kernels write these values.
static_assert(static_cast<int>(RowState::inactive) == 0);
static_assert(static_cast<int>(RowState::at_upper) == 1);
static_assert(static_cast<int>(RowState::at_lower) == -1);
static_assert(static_cast<int>(RowState::equality) == 2);
static_assert(static_cast<int>(RowState::above_upper) == 3);
static_assert(static_cast<int>(RowState::below_lower) == -3);

signed char side_of(RowState state) {
  const int side = static_cast<int>(state);
  if (state == RowState::equality) return 2;
  return static_cast<signed char>((side > 0) - (side < 0));
}

}  // namespace

void LexicographicSolver::take(Outcome outcome, const Hierarchy& hierarchy) {
  solution_.status = SolveStatus::optimal;
  solution_.failed_level = -1;
  solution_.borderline = false;
  switch (outcome) {
    case Outcome::optimal:
      take_from_sweep(hierarchy);
      solution_.borderline = depends_on(tolerance::kWeakPivot, tolerance::kWeakForce);
      if (solution_.borderline && !budget_.is_limited()) ask_cascade(hierarchy);
      return;
    case Outcome::out_of_budget:
      take_kept_point();
      solution_.borderline =
          solution_.status == SolveStatus::optimal && depends_on(tolerance::kWeakPivot, 0.0);
      return describe(hierarchy);
    case Outcome::stuck:
      (void)solve_by_cascade(hierarchy);
      take_from_cascade(hierarchy);
  }
}

// Did the last sweep use a pivot below `pivot`, need a force below `force`, or skip a weak row?
bool LexicographicSolver::depends_on(double pivot, double force) const {
  const Sweep& s = memory_.sweep;
  return s.smallest_pivot < pivot || s.unused_pivot < 1.0 || search_.weakest_force() < force;
}

bool LexicographicSolver::is_too_close_to_call() const {
  return depends_on(tolerance::kBorderlinePivot, tolerance::kBorderlineForce);
}

// Gets a second answer, and takes the better one.
void LexicographicSolver::ask_cascade(const Hierarchy& hierarchy) {
  if (!is_finite(solution_, hierarchy.num_levels())) return;
  const bool is_too_close = is_too_close_to_call();
  const Solution& other = solve_by_cascade(hierarchy);
  if (other.status != SolveStatus::optimal) return;
  const AnswerComparison comparison = compare(hierarchy, solution_, other);
  if (comparison.is_better) take_from_cascade(hierarchy);
  solution_.borderline = comparison.differs || is_too_close;
}

// The last sweep has found the optimum.
void LexicographicSolver::take_from_sweep(const Hierarchy& hierarchy) {
  describe(hierarchy);
  count_freedom();
  is_swept_ = true;
}

// The budget is spent. The levels before the kept point's level are finished, if not all are.
void LexicographicSolver::take_kept_point() {
  Sweep& s = memory_.sweep;
  std::copy_n(kept_.x.data(), s.unknowns, s.x);
  kernels_.evaluate(s, s.level_begin[first_level_], s.num_rows);
  if (!kept_.is_optimal) {
    solution_.status = SolveStatus::iteration_cap;
    solution_.failed_level = std::min(kept_.level, s.num_levels);
  }
  for (int k = first_level_; k < s.num_levels; ++k) {
    solution_.levels[at(k)].degrees_of_freedom_left = kept_.freedom_left[at(k)];
  }
}

const Solution& LexicographicSolver::solve_by_cascade(const Hierarchy& hierarchy) {
  const Solution& solution = cascade_.solve(hierarchy);
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) timer_.add(k, solution.levels[k].time);
  return solution;
}

// Takes the cascade's answer, or the sweeps' shorter x if it is equally good.
void LexicographicSolver::take_from_cascade(const Hierarchy& hierarchy) {
  const Solution& found = cascade_.solution();
  const bool is_polished = found.status == SolveStatus::optimal && polish();
  if (is_polished) take_from_sweep(hierarchy);
  num_sweeps_ = options_.max_sweeps + options_.max_exchanges + 1;
  if (!is_polished) return adopt(found);
  const AnswerComparison comparison = compare(hierarchy, solution_, found);
  solution_.borderline = comparison.differs || is_too_close_to_call();
  if (comparison.is_better) adopt(found);
}

void LexicographicSolver::adopt(const Solution& solution) {
  is_swept_ = solution_.is_swept = false;
  solution_.borderline = solution_.borderline || solution.borderline;
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
    for (std::size_t i = 0; i < at(to.num_rows); ++i) {
      to.rows[i] = from.rows[i];
      s.side[at(s.level_begin[k]) + i] = side_of(from.rows[i]);
    }
  }
}

void LexicographicSolver::describe(const Hierarchy& hierarchy) {
  Sweep& s = memory_.sweep;
  solution_.is_swept = true;
  for (int i = 0; i < s.unknowns; ++i) solution_.x[i] = s.x[i];
  kernels_.evaluate(s, 0, s.level_begin[first_level_]);
  kernels_.judge_rows(s, tolerance::kAtBound * solution_.x.norm());
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    LevelResult& result = solution_.levels[k];
    const int begin = s.level_begin[k], rows = s.level_begin[k + 1] - begin;
    double sum = 0.0;
    for (int i = 0; i < rows; ++i) {
      sum += s.square_violation[begin + i];
      result.rows[at(i)] = static_cast<RowState>(s.state[begin + i]);
    }
    result.residual = std::sqrt(sum);
    result.num_rows = rows;
    result.iterations = num_sweeps_;
  }
}

// A column counts for the level that fixed its row.
void LexicographicSolver::count_freedom() {
  const Sweep& s = memory_.sweep;
  for (int k = first_level_; k < s.num_levels; ++k) {
    solution_.levels[at(k)].degrees_of_freedom_left = 0;
  }
  for (int k = first_level_; k < s.num_levels; ++k) {
    for (int column = s.first_column[k]; column < s.first_column[k + 1]; ++column) {
      const int row = s.pivot[column];
      const int fixed_by = row >= 0 ? search_.fixed_by(row) : k;
      if (fixed_by < s.num_levels) --solution_.levels[at(fixed_by)].degrees_of_freedom_left;
    }
  }
  Index left = s.columns;
  for (int k = first_level_; k < s.num_levels; ++k) {
    left = solution_.levels[at(k)].degrees_of_freedom_left += left;
  }
}

}  // namespace surefoot::solver
