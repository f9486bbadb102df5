#pragma once

#include "surefoot/config/hierarchy_json.hpp"
#include "surefoot/solver/solution.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::explain {

/// A row that its level could not reach.
struct MissedRow {
  std::string name;
  /// In the level's unit, of the row as it was given; positive above the bound, negative below it.
  double by = 0.0;
  double weight = 1.0;  ///< in the residual it counts so many times
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
  std::vector<NamedRow> same;  ///< others that say the same: the numbers are of all together
  bool would_gain = false;     ///< see `DistinctBlocker`
  double cost = 0.0;  ///< what the level's residual falls by without this row alone; NaN: not known
  double multiplier = 0.0;    ///< see `Blocker`
  double independence = 1.0;  ///< see `Blocker`
};

/// A level above that holds another back.
struct BlockingLevelAccount {
  std::size_t level = 0;
  /// What the residual falls by without any row of it; 0 where others hold the same, though rows
  /// that say the same as those of others have a cost with them. NaN: not known.
  double cost = 0.0;
  std::vector<BlockingRowAccount> rows;  ///< dearest first
};

/// How a level came out; cut off: at the cap of iterations or the budget, not reached: after that.
constexpr std::string_view kMet = "met", kMissed = "missed", kNoRows = "no rows",
                           kCutOff = "cut off", kNotReached = "not reached";

/// What ended a search that was cut off: its budget, if it is spent.
[[nodiscard]] constexpr std::string_view what_ended(bool is_budget_spent) {
  return is_budget_spent ? "at its budget" : "at the solver's own cap of iterations";
}

/// Why a level came out as it did.
struct LevelAccount {
  std::string name;
  std::string unit;  ///< of residual and costs; empty: not known
  std::string_view status;
  /// So far, where the level was cut off, as are `missed` and `held`; nothing above is known to
  /// hold it back. Of one that was not reached nothing is known but its name, unit and number of
  /// rows.
  double residual = 0.0;
  long num_rows = 0;
  long freedom_left = 0;
  int iterations = 0;
  double time = 0.0;                             ///< [s]; 0: not measured
  std::vector<MissedRow> missed;                 ///< worst first
  std::vector<HeldRow> held;                     ///< in the order of the rows
  std::vector<BlockingLevelAccount> blocked_by;  ///< dearest first
};

/// Of the multiplier of a row in `by`'s unit: of half the squared residual, by the row's bound, as
/// "N² per m/s²". Empty where a unit is not known.
[[nodiscard]] std::string multiplier_unit(const LevelAccount& level, const LevelAccount& by);

/// How many levels, from the first on, are at their optimum: all, unless the search was cut off.
[[nodiscard]] std::size_t num_finished(const solver::Solution& solution, std::size_t num_levels);

/// Of the whole hierarchy; of one that was swept they are sweeps, and no level has its own.
[[nodiscard]] int num_iterations(const solver::Solution& solution);

/// Indices of the levels that have no row: they ask for nothing.
[[nodiscard]] std::vector<std::size_t> levels_without_rows(const solver::Hierarchy& hierarchy);

/// "optimal", "iteration_cap" or "invalid_input".
[[nodiscard]] std::string_view name(solver::SolveStatus status);

}  // namespace surefoot::explain
