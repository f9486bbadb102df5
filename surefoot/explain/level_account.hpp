#pragma once

#include "surefoot/config/hierarchy_json.hpp"
#include "surefoot/solver/solution.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::explain {

/// A row that its level could not meet.
struct MissedRow {
  std::string name;
  /// In the level's unit, without the weight; positive above the bound, negative below it.
  double by = 0.0;
  double weight = 1.0;  ///< of the row, in the residual
};

/// An inequality row that is held at its bound.
struct HeldRow {
  std::string name;
  bool at_upper = true;
};

/// A row and its level.
struct NamedRow {
  std::size_t level = 0;
  std::string name;
};

/// A row above that costs a level something.
struct BlockingRowAccount {
  std::string name;
  std::string_view state;      ///< in words: "at its upper bound"
  bool is_limit = false;       ///< an inequality
  std::vector<NamedRow> same;  ///< rows that ask for the same: the numbers are of all together
  bool would_gain = false;     ///< see `DistinctBlocker`
  double cost = 0.0;  ///< decrease of the level's residual without this row alone; NaN: not known
  double multiplier = 0.0;    ///< see `Blocker`
  double independence = 1.0;  ///< see `Blocker`
};

/// A level above that holds another back.
struct BlockingLevelAccount {
  std::size_t level = 0;
  /// Decrease of the residual without all rows of this level. 0 if other levels hold the same; a
  /// row can still have a cost together with its equals there. NaN: not known.
  double cost = 0.0;
  std::vector<BlockingRowAccount> rows;  ///< costliest first
};

/// Status of a level. The search was cut off in it (cap of iterations or budget), or before it (not
/// reached).
constexpr std::string_view kMet = "met", kMissed = "missed", kNoRows = "no rows",
                           kCutOff = "cut off", kNotReached = "not reached";

/// What ended a search that was cut off.
[[nodiscard]] constexpr std::string_view what_ended(bool is_budget_spent) {
  return is_budget_spent ? "at its budget" : "at the solver's own cap of iterations";
}

/// Result of a level, and its causes.
struct LevelAccount {
  std::string name;
  std::string unit;  ///< of residual and costs; empty: not known
  std::string_view status;
  /// In a level that was cut off, `residual`, `missed` and `held` are those so far, and
  /// `blocked_by` is empty. A level that was not reached has only name, unit and number of rows.
  double residual = 0.0;
  long num_rows = 0;
  long freedom_left = 0;
  int iterations = 0;
  double time = 0.0;                             ///< [s]; 0: not measured
  std::vector<MissedRow> missed;                 ///< worst first
  std::vector<HeldRow> held;                     ///< in the order of the rows
  std::vector<BlockingLevelAccount> blocked_by;  ///< costliest first
};

/// Unit of the multiplier of a row of `by`: half the squared residual of `level` per bound of the
/// row, "N² per m/s²". Empty if a unit is not known.
[[nodiscard]] std::string multiplier_unit(const LevelAccount& level, const LevelAccount& by);

/// Number of levels, from the first on, at their optimum: all, unless the search was cut off.
[[nodiscard]] std::size_t num_finished(const solver::Solution& solution, std::size_t num_levels);

/// Of the whole hierarchy. If the solution is swept, they are sweeps over all levels.
[[nodiscard]] int num_iterations(const solver::Solution& solution);

/// Indices of the levels without rows.
[[nodiscard]] std::vector<std::size_t> levels_without_rows(const solver::Hierarchy& hierarchy);

/// "optimal", "iteration_cap" or "invalid_input".
[[nodiscard]] std::string_view name(solver::SolveStatus status);

}  // namespace surefoot::explain
