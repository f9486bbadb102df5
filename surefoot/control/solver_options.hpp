#pragma once

#include "surefoot/solver/budget.hpp"

#include <array>
#include <string_view>

namespace surefoot::control {

/// Which solver the controller asks.
enum class SolverMethod : int {
  lexicographic = 0,  ///< LexicographicSolver, which starts from the rows active at the last tick
  cascade = 1,        ///< CascadeSolver, the reference, which starts from nothing
};

inline constexpr std::array kSolverMethods{SolverMethod::lexicographic, SolverMethod::cascade};

/// As scenarios have it.
[[nodiscard]] constexpr std::string_view name(SolverMethod method) {
  switch (method) {
    case SolverMethod::lexicographic:
      return "lexicographic";
    case SolverMethod::cascade:
      return "cascade";
  }
  return "unknown";
}

/// How the controller solves its hierarchy. Without a budget the optimum is the same, the time is
/// not.
struct SolverOptions {
  SolverMethod method = SolverMethod::lexicographic;
  /// Equations of motion and contacts in closed form, where they allow it (PhysicsSubstitution);
  /// the cascade never uses it.
  bool structure = true;
  /// What a tick may cost; where it ends the search x is feasible for all levels that are finished.
  /// The controller has no clock, so that a replay ends at the same place: only the flops count.
  /// The cascade has none.
  solver::SolveBudget budget{};
  /// Seconds of any steady clock, for `Controller::level_times` alone: nothing else depends on it.
  double (*clock)() = nullptr;
};

}  // namespace surefoot::control
