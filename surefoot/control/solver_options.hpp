#pragma once

#include <array>
#include <string_view>

namespace surefoot {

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

/// How the controller solves its hierarchy. The optimum is the same, the time is not.
struct SolverOptions {
  SolverMethod method = SolverMethod::lexicographic;
  /// Equations of motion and contacts in closed form, where they allow it (PhysicsSubstitution);
  /// the cascade never uses it.
  bool structure = true;
};

}  // namespace surefoot
