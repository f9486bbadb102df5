#include "surefoot/solver/cascade_solver.hpp"

#include "surefoot/solver/capacity.hpp"
#include "surefoot/solver/denormals.hpp"
#include "surefoot/solver/index.hpp"
#include "surefoot/solver/row_states.hpp"
#include "surefoot/solver/tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::solver {
namespace {}  // namespace

CascadeSolver::CascadeSolver(const Hierarchy& capacity, const CascadeOptions& options)
    : options_(options),
      tableau_(capacity.unknowns(), max_rows(capacity)),
      level_solver_(capacity.unknowns(), max_rows(capacity)),
      solution_(empty_solution(capacity)) {}

const Solution& CascadeSolver::solve(const Hierarchy& hierarchy) noexcept {
  const FlushDenormals flush_denormals;
  const double begin = now();
  if (!fits(hierarchy, solution_) || first_unsound_level(hierarchy) >= 0) {
    reject(hierarchy, solution_);
    return solution_;
  }
  solution_.status = SolveStatus::optimal;
  solution_.failed_level = -1;
  tableau_.reset();
  level_solver_.reset(options_.rank);
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    LevelResult& result = solution_.levels[k];
    result.iterations = 0;
    const double level_begin = now();
    if (solution_.status == SolveStatus::optimal && tableau_.num_free() > 0) {
      tableau_.append(hierarchy.level(k));
      if (level_solver_.minimize(tableau_, max_iterations())) {
        level_solver_.retire(tableau_);
      } else {
        solution_.status = SolveStatus::iteration_cap;
        solution_.failed_level = static_cast<int>(k);
      }
      result.iterations = level_solver_.iterations();
    }
    result.degrees_of_freedom_left = tableau_.num_free();
    result.time = now() - level_begin;
  }
  solution_.borderline = solution_.status == SolveStatus::optimal && level_solver_.is_borderline();
  solution_.x = tableau_.value.head(tableau_.unknowns);
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    describe(hierarchy.level(k), solution_.levels[k]);
  }
  clear_levels(solution_, hierarchy.num_levels());
  const bool is_in_range = std::isfinite(tableau_.x_size);
  if (!is_in_range || !is_finite(solution_, hierarchy.num_levels())) {
    reject(hierarchy, solution_);
    return solution_;
  }
  solution_.time = now() - begin;
  return solution_;
}

int CascadeSolver::max_iterations() const {
  if (options_.max_iterations > 0) return options_.max_iterations;
  return 50 + 10 * static_cast<int>(tableau_.num_rows - tableau_.unknowns);
}

void CascadeSolver::describe(const Level& level, LevelResult& result) const {
  result.num_rows = level.num_rows();
  double sum = 0.0;
  for (Index i = 0; i < level.num_rows(); ++i) {
    const double value = level.A().row(i).dot(solution_.x);
    const double tolerance = tolerance::kAtBound * level.A().row(i).norm() * tableau_.x_size;
    const double lower = level.lower()[i];
    const double upper = level.upper()[i];
    const double violation = signed_violation(value, lower, upper);
    sum += violation * violation;
    result.rows[static_cast<std::size_t>(i)] = state_of(value, lower, upper, tolerance);
  }
  result.residual = std::sqrt(sum);
}

}  // namespace surefoot::solver
