#pragma once

#include "surefoot/control/level_switcher.hpp"
#include "surefoot/control/solver_options.hpp"
#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
#include "surefoot/solver/soft_levels.hpp"

#include <span>
#include <variant>

namespace surefoot::control {

/// The controller's solver, as its options choose it.
class HierarchySolver {
 public:
  /// Sizes come from `capacity`; nothing allocates afterwards.
  HierarchySolver(const solver::Hierarchy& capacity, const SolverOptions& options);

  /// Is there a use for a substitution?
  [[nodiscard]] bool wants_substitution() const { return wants_substitution_; }

  /// `substitution` may be null. During a transition, for which `hierarchy` has the levels of both
  /// sides, what lies between its two optima. The reference stays valid until the next call.
  const solver::Solution& solve(const solver::Hierarchy& hierarchy,
                                const solver::Substitution* substitution,
                                const LevelTransition& transition) noexcept;

  /// What holds each level of the last solution back; empty where the solver doesn't say, and
  /// during a transition, which is no optimum. The hierarchy must be as it was.
  [[nodiscard]] std::span<const solver::LevelBlockers> blockers() noexcept;

 private:
  using Solver = std::variant<solver::LexicographicSolver, solver::CascadeSolver>;

  static Solver make(const solver::Hierarchy& capacity, const SolverOptions& options);
  static const solver::Solution& solve_with(Solver& solver, const solver::Hierarchy& hierarchy,
                                            const solver::Substitution* substitution) noexcept;

  Solver solver_;
  Solver solver_after_;  // of what is behind a transition
  solver::SoftLevels soft_levels_;
  bool wants_substitution_;
  bool is_optimum_ = false;  // the last solution, of one hierarchy
};

}  // namespace surefoot::control
