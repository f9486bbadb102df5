#pragma once

#include "surefoot/solver/optimality_conditions.hpp"

#include <functional>
#include <limits>
#include <vector>

namespace surefoot {

/// A row of a higher level that keeps a level from a smaller residual.
struct Blocker {
  RowIndex at;
  /// Strength of the row in −g = Eᵀ λ + Tᵀ μ, for rows a of their own length: how fast ½ residual²
  /// of the blocked level falls when the bound gives way. Zero only for rows that do not block.
  double multiplier = 0.0;
  /// By how much the residual of the blocked level falls without this row, in the unit of its rows;
  /// NaN where the level could not be solved without it.
  double cost = 0.0;
  /// What of the row, relative to its length, no other row above that is fixed or at its bound has
  /// as well, rows that say the same counted as one; 1 where they are orthogonal. A multiplier is
  /// known to about ε over it, and others may stand in for the row: of nearly dependent rows
  /// multipliers say little.
  double independence = 1.0;
};

/// The same, of a row and all others above that say the same: of the same direction, fixed at the
/// same value or held at the same bound. They are told once; the numbers are of all together.
struct DistinctBlocker : Blocker {
  std::vector<RowIndex> same;  ///< the others
  /// It is missed, and would be less if the blocked level had its way: it wants the same, and not
  /// it holds the level but what contradicts it.
  bool would_gain = false;
};

/// How a level came out, and because of what.
struct LevelExplanation {
  double residual = 0.0;
  /// Dearest first, unknown costs last; empty where nothing above holds it back.
  std::vector<DistinctBlocker> blocked_by;
  /// By how much the residual falls without any row of level j, for each level j before this one;
  /// NaN where that could not be solved.
  std::vector<double> cost_of_level;
};

struct ExplainOptions {
  /// The first so many levels: those for which x is the optimum.
  std::size_t levels = std::numeric_limits<std::size_t>::max();
  /// Told now and then how many levels are done, fractions too.
  std::function<void(double)> progress = nullptr;
};

/// Says for every level which rows above it cost it how much, at the optimum x of the hierarchy.
///
/// The cost of a row is exact, not first order: the level is solved again without that row, while
/// every other row above keeps what it has (equality rows their value, satisfied rows their bounds,
/// and what is violated is not violated more). So it is never negative, and the levels between do
/// not answer for it. Every row that has a cost is named. Rows that say the same are taken away
/// together; of others that hold the same none has a cost by itself, their level has, and where no
/// level has either, rows of all of them are named. Allocates and solves; for the program, tests
/// and reports, not for the loop.
[[nodiscard]] std::vector<LevelExplanation> explain(const Hierarchy& hierarchy,
                                                    const Eigen::VectorXd& x,
                                                    const ExplainOptions& options = {});

}  // namespace surefoot
