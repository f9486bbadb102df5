#include "surefoot/control/hierarchy_solver.hpp"

namespace surefoot::control {

HierarchySolver::HierarchySolver(const solver::Hierarchy& capacity, const SolverOptions& options)
    : solver_(make(capacity, options)),
      solver_after_(make(capacity, options)),
      soft_levels_(capacity),
      wants_substitution_(options.structure && options.method == SolverMethod::lexicographic) {}

HierarchySolver::Solver HierarchySolver::make(const solver::Hierarchy& capacity,
                                              const SolverOptions& options) {
  if (options.method == SolverMethod::cascade) {
    solver::CascadeOptions cascade;
    cascade.clock = options.clock;
    return Solver(std::in_place_type<solver::CascadeSolver>, capacity, cascade);
  }
  solver::LexicographicOptions lexicographic;
  lexicographic.budget.flops = options.budget.flops;
  lexicographic.clock = options.clock;
  return Solver(std::in_place_type<solver::LexicographicSolver>, capacity, lexicographic);
}

const solver::Solution& HierarchySolver::solve(const solver::Hierarchy& hierarchy,
                                               const solver::Substitution* substitution,
                                               const LevelTransition& transition) noexcept {
  is_optimum_ = !transition.is_going_on();
  if (is_optimum_) return solve_with(solver_, hierarchy, substitution);
  const solver::Solution& before =
      solve_with(solver_, soft_levels_.select(hierarchy, transition.before), substitution);
  const solver::Solution& after =
      solve_with(solver_after_, soft_levels_.select(hierarchy, transition.after), substitution);
  return soft_levels_.between(hierarchy, before, after, transition.share);
}

const solver::Solution& HierarchySolver::solve_with(
    Solver& solver, const solver::Hierarchy& hierarchy,
    const solver::Substitution* substitution) noexcept {
  if (auto* cascade = std::get_if<solver::CascadeSolver>(&solver)) return cascade->solve(hierarchy);
  auto& lexicographic = *std::get_if<solver::LexicographicSolver>(&solver);
  return substitution == nullptr ? lexicographic.solve(hierarchy)
                                 : lexicographic.solve(hierarchy, *substitution);
}

std::span<const solver::LevelBlockers> HierarchySolver::blockers() noexcept {
  auto* lexicographic = std::get_if<solver::LexicographicSolver>(&solver_);
  if (lexicographic == nullptr || !is_optimum_) return {};
  return lexicographic->blockers();
}

}  // namespace surefoot::control
