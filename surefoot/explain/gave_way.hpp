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
  bool restless = false;  ///< asks for no force or torque at all, and is never content
  /// Limits that cost a tenth of the dearest row and more, then the others, by cost; the dearest
  /// among the first four. Empty: nothing above holds it back.
  std::vector<CostlyRow> to;
  std::size_t num_told = 0;  ///< so many of them are worth telling
};

/// Of the levels that were solved, in the order of the tick's hierarchy. What is less than
/// `visible_residual` is left out.
[[nodiscard]] std::vector<LevelThatGaveWay> gave_way(const TickExplanation& explanation);

/// "row 17" where the log does not name it.
[[nodiscard]] std::string row_name(const TickExplanation& explanation, std::int16_t level,
                                   std::int32_t id);

/// Rows at or beyond a bound, of the levels that were solved.
[[nodiscard]] std::vector<ActiveRow> rows_at_bounds(const TickExplanation& explanation);

/// Equality rows that were missed, of the levels that were solved.
[[nodiscard]] std::vector<MissedEquality> missed_rows(const TickExplanation& explanation);

/// Of the level at this place of the tick's order, where the solution was used.
[[nodiscard]] logging::LevelStatus level_status(const TickExplanation& explanation,
                                                std::size_t place);

}  // namespace surefoot::explain
