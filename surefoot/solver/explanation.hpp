#pragma once

#include "surefoot/solver/optimality_conditions.hpp"

#include <functional>
#include <limits>
#include <vector>

namespace surefoot::solver {

/// A row of a higher level that keeps a level from a smaller residual.
struct Blocker {
  RowIndex at;
  /// Strength of the row in −g = Eᵀ λ + Tᵀ μ, for rows a of their own length: derivative of the
  /// blocked level's ½ residual² by the row's bound. Zero only for rows that do not block.
  double multiplier = 0.0;
  /// Drop of the blocked level's residual without this row, in the unit of its rows; NaN if the
  /// level could not be solved without it.
  double cost = 0.0;
  /// Part of the row, relative to its length, that is independent of all other fixed rows above and
  /// rows at their bound, duplicates counted as one; 1 if it is orthogonal to them. The error of a
  /// multiplier is about ε over it, and other rows may replace this one: multipliers of nearly
  /// dependent rows mean little.
  double independence = 1.0;
};

/// A blocker and its duplicates above: of the same direction, fixed at the same value or held at
/// the same bound. The numbers are of all together.
struct DistinctBlocker : Blocker {
  std::vector<RowIndex> same;  ///< the others
  /// It is violated, and the blocked level would reduce the violation: the row that contradicts it
  /// blocks, not this one.
  bool would_gain = false;
};

/// Result of a level and its reasons.
struct LevelExplanation {
  double residual = 0.0;
  /// Largest cost first, unknown costs last; empty if nothing above holds it back.
  std::vector<DistinctBlocker> blocked_by;
  /// Drop of the residual without any row of level j, for each level j before this one; NaN if that
  /// could not be solved.
  std::vector<double> cost_of_level;
};

struct ExplainOptions {
  /// Number of leading levels that x optimizes.
  std::size_t levels = std::numeric_limits<std::size_t>::max();
  /// Called now and then with the number of completed levels, fractions included.
  std::function<void(double)> progress = nullptr;
};

/// Finds for every level the rows above that hold it back, and their cost, at the optimum x.
///
/// The cost of a row is exact, not first order: the level is solved again without that row, while
/// every other row above keeps its result (equality rows their value, satisfied rows their bounds,
/// and violations do not grow). So it is never negative, and levels in between pay nothing. Every
/// row with a cost is listed. Duplicates are removed together; of other rows that hold the same
/// direction none has a cost alone, but their level has. If no level has a cost either, rows of all
/// of them are listed. Allocates and solves; for programs, tests and reports, not for the loop.
[[nodiscard]] std::vector<LevelExplanation> explain(const Hierarchy& hierarchy,
                                                    const Eigen::VectorXd& x,
                                                    const ExplainOptions& options = {});

}  // namespace surefoot::solver
