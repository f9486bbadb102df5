#pragma once

#include "surefoot/control/level_switcher.hpp"
#include "surefoot/control/solver_options.hpp"
#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
#include "surefoot/solver/soft_levels.hpp"

#include <span>
#include <variant>

namespace surefoot::control {

/// The solver chosen by the controller's options.
class HierarchySolver {
 public:
  /// `capacity` gives the sizes; nothing allocates afterwards.
  HierarchySolver(const solver::Hierarchy& capacity, const SolverOptions& options);

  /// Does `solve` use a substitution?
  [[nodiscard]] bool wants_substitution() const { return wants_substitution_; }

  /// `substitution` may be null. During a transition `hierarchy` has the levels of both sides, and
  /// the result interpolates between their optima. The reference stays valid until the next call.
  const solver::Solution& solve(const solver::Hierarchy& hierarchy,
                                const solver::Substitution* substitution,
                                const LevelTransition& transition) noexcept;

  /// The rows that block each level of the last solution; empty if the solver doesn't know them,
  /// and during a transition, which is no optimum. The hierarchy must be unchanged since `solve`.
  [[nodiscard]] std::span<const solver::LevelBlockers> blockers() noexcept;

 private:
  using Solver = std::variant<solver::LexicographicSolver, solver::CascadeSolver>;

  static Solver make(const solver::Hierarchy& capacity, const SolverOptions& options);
  static const solver::Solution& solve_with(Solver& solver, const solver::Hierarchy& hierarchy,
                                            const solver::Substitution* substitution) noexcept;

  Solver solver_;
  Solver solver_after_;  // for the levels after a transition
  solver::SoftLevels soft_levels_;
  bool wants_substitution_;
  bool is_optimum_ = false;  // the last solution
};

}  // namespace surefoot::control
