#pragma once

#include "surefoot/config/hierarchy_json.hpp"
#include "surefoot/solver/solution.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

/// A row that its level could not reach.
struct MissedRow {
  std::string name;
  double by = 0.0;  ///< in the level's unit; positive above the bound, negative below it
};

/// An inequality row that is held at its bound.
struct HeldRow {
  std::string name;
  bool at_upper = true;
};

/// A row above that costs a level something.
struct BlockingRowAccount {
  std::string name;
  std::string_view state;   ///< in words: "at its upper bound"
  double cost = 0.0;        ///< what the level's residual falls by without this row alone
  double multiplier = 0.0;  ///< see `Blocker`
};

/// A level above that holds another back.
struct BlockingLevelAccount {
  std::size_t level = 0;
  /// What the residual falls by without any row of it; 0 where others hold the same.
  double cost = 0.0;
  std::vector<BlockingRowAccount> rows;  ///< dearest first
};

/// Why a level came out as it did.
struct LevelAccount {
  std::string name;
  std::string unit;  ///< of residual and costs; empty: not known
  /// "met", "missed", "no rows", "cut off" (at the cap of iterations), "not solved" (after that)
  std::string_view status;
  double residual = 0.0;
  long num_rows = 0;
  long freedom_left = 0;
  int iterations = 0;
  double time = 0.0;                             ///< [s]; 0: not measured
  std::vector<MissedRow> missed;                 ///< worst first
  std::vector<HeldRow> held;                     ///< in the order of the rows
  std::vector<BlockingLevelAccount> blocked_by;  ///< dearest first
};

/// Of every level. What is rounding counts as 0.
[[nodiscard]] std::vector<LevelAccount> account_for(const NamedHierarchy& question,
                                                    const Solution& solution);

/// Of the whole hierarchy; of one that was swept they are sweeps, and no level has its own.
[[nodiscard]] int num_iterations(const Solution& solution);

/// Indices of the levels that have no row: they ask for nothing.
[[nodiscard]] std::vector<std::size_t> levels_without_rows(const Hierarchy& hierarchy);

/// "optimal", "iteration_cap" or "invalid_input".
[[nodiscard]] std::string_view name(SolveStatus status);

}  // namespace surefoot
