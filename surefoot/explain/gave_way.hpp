#pragma once

#include "surefoot/explain/tick_explanation.hpp"
#include "surefoot/logging/level_status.hpp"

#include <string>
#include <vector>

namespace surefoot::explain {

/// A level that did not get what it asked for.
struct LevelThatGaveWay {
  std::string name, unit;
  double residual = 0.0;
  bool is_minimised = false;  ///< wants zero forces or torques, so it always has a residual
  /// Limits with at least a tenth of the largest cost, then the other rows, each by cost; the row
  /// of the largest cost is among the first four. Empty: nothing above holds the level back.
  std::vector<CostlyRow> to;
  std::size_t num_shown = 0;  ///< the first ones of `to`, which texts name
};

/// Solved levels that gave way, in the order of the tick's hierarchy. Residuals below
/// `visible_residual` are left out.
[[nodiscard]] std::vector<LevelThatGaveWay> gave_way(const TickExplanation& explanation);

/// Name of a row; "row 17" if the log does not name it.
[[nodiscard]] std::string row_name(const TickExplanation& explanation, std::int16_t level,
                                   std::int32_t id);

/// Rows of solved levels that are at or beyond a bound.
[[nodiscard]] std::vector<ActiveRow> rows_at_bounds(const TickExplanation& explanation);

/// Equality rows of solved levels that were missed.
[[nodiscard]] std::vector<MissedEquality> missed_rows(const TickExplanation& explanation);

/// Status of the level at this place of the tick's order; the solution must have been used.
[[nodiscard]] logging::LevelStatus level_status(const TickExplanation& explanation,
                                                std::size_t place);

}  // namespace surefoot::explain
