#pragma once

#include "surefoot/solver/optimality_conditions.hpp"

#include <string>
#include <vector>

namespace surefoot {

/// A row of a higher level that keeps a level from a smaller residual.
struct Blocker {
  RowIndex at;
  /// Strength of the row in −g = Eᵀ λ + Tᵀ μ, for rows a of their own length: how fast ½ residual²
  /// of the blocked level falls when the bound gives way. Zero only for rows that do not block.
  double multiplier = 0.0;
  /// By how much the residual of the blocked level falls without this row, in the unit of its rows.
  double cost = 0.0;
};

/// How a level came out, and because of what.
struct LevelExplanation {
  double residual = 0.0;
  std::vector<Blocker> blocked_by;  ///< dearest first; empty where nothing above holds it back
  /// By how much the residual falls without any row of level j, for each level j before this one.
  std::vector<double> cost_of_level;
};

/// Says for every level which rows above it cost it how much, at the optimum x of the hierarchy.
///
/// The cost of a row is exact, not first order: the level is solved again without that row, while
/// every other row above keeps what it has (equality and violated rows their value, satisfied rows
/// their bounds). So it is never negative, and the levels between do not answer for it. Of several
/// rows that hold alone (duplicates) none has a cost by itself; their level has. Allocates and
/// solves; for the program, tests and reports, not for the loop.
[[nodiscard]] std::vector<LevelExplanation> explain(const Hierarchy& hierarchy,
                                                    const Eigen::VectorXd& x);

}  // namespace surefoot
