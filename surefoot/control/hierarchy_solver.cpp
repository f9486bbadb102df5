#include "surefoot/control/hierarchy_solver.hpp"

namespace surefoot {

HierarchySolver::HierarchySolver(const Hierarchy& capacity, const SolverOptions& options)
    : solver_(make(capacity, options)),
      wants_substitution_(options.structure && options.method == SolverMethod::lexicographic) {}

HierarchySolver::Solver HierarchySolver::make(const Hierarchy& capacity,
                                              const SolverOptions& options) {
  if (options.method == SolverMethod::cascade) {
    return Solver(std::in_place_type<CascadeSolver>, capacity);
  }
  return Solver(std::in_place_type<LexicographicSolver>, capacity);
}

const Solution& HierarchySolver::solve(const Hierarchy& hierarchy,
                                       const Substitution* substitution) noexcept {
  if (auto* cascade = std::get_if<CascadeSolver>(&solver_)) return cascade->solve(hierarchy);
  auto& lexicographic = *std::get_if<LexicographicSolver>(&solver_);
  return substitution == nullptr ? lexicographic.solve(hierarchy)
                                 : lexicographic.solve(hierarchy, *substitution);
}

std::span<const LevelBlockers> HierarchySolver::blockers() noexcept {
  auto* lexicographic = std::get_if<LexicographicSolver>(&solver_);
  if (lexicographic == nullptr) return {};
  return lexicographic->blockers();
}

}  // namespace surefoot
