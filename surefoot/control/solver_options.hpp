#pragma once

#include "surefoot/solver/budget.hpp"

#include <array>
#include <string_view>

namespace surefoot::control {

/// Solver of the controller's hierarchy.
enum class SolverMethod : int {
  lexicographic = 0,  ///< LexicographicSolver, warm-started with the last tick's active rows
  cascade = 1,        ///< CascadeSolver, the reference, without a warm start
};

inline constexpr std::array kSolverMethods{SolverMethod::lexicographic, SolverMethod::cascade};

/// The name in scenarios.
[[nodiscard]] constexpr std::string_view name(SolverMethod method) {
  switch (method) {
    case SolverMethod::lexicographic:
      return "lexicographic";
    case SolverMethod::cascade:
      return "cascade";
  }
  return "unknown";
}

/// How the controller solves its hierarchy. Without a budget all methods give the same optimum.
struct SolverOptions {
  SolverMethod method = SolverMethod::lexicographic;
  /// Solves equations of motion and contacts in closed form where possible (PhysicsSubstitution);
  /// not for the cascade.
  bool structure = true;
  /// Budget of a tick. When it ends the search, x is feasible for all finished levels. Only flops
  /// count, as the controller has no clock: so a replay ends at the same place. Not for the
  /// cascade.
  solver::SolveBudget budget{};
  /// A steady clock [s], used for `Controller::level_times` only.
  double (*clock)() = nullptr;
};

}  // namespace surefoot::control
