#include "surefoot/control/hierarchy_solver.hpp"

namespace surefoot {

HierarchySolver::HierarchySolver(const Hierarchy& capacity, const SolverOptions& options)
    : solver_(make(capacity, options)) {}

HierarchySolver::Solver HierarchySolver::make(const Hierarchy& capacity,
                                              const SolverOptions& options) {
  if (options.method == SolverMethod::cascade) {
    return Solver(std::in_place_type<CascadeSolver>, capacity);
  }
  return Solver(std::in_place_type<LexicographicSolver>, capacity);
}

const Solution& HierarchySolver::solve(const Hierarchy& hierarchy) noexcept {
  if (auto* cascade = std::get_if<CascadeSolver>(&solver_)) return cascade->solve(hierarchy);
  return std::get_if<LexicographicSolver>(&solver_)->solve(hierarchy);
}

}  // namespace surefoot
