#pragma once

#include "surefoot/signals/tick_record.hpp"
#include "surefoot/solver/solution.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

namespace surefoot {

/// False where no state was believed, or the input was invalid: no force and no residual is of
/// that tick, whatever its record has.
[[nodiscard]] inline bool was_solved(const HierarchyReport& report) {
  return report.status != static_cast<std::int32_t>(SolveStatus::invalid_input);
}

/// Of a tick's levels, highest first by their numbers in the header, those that are at their
/// optimum: of a solve that was cut off the numbers of the others say nothing.
[[nodiscard]] inline std::span<const std::int16_t> solved_levels(
    const HierarchyReport& report, std::span<const std::int16_t> order) {
  if (!was_solved(report)) return {};
  if (report.status != static_cast<std::int32_t>(SolveStatus::iteration_cap)) return order;
  const auto failed = std::ranges::find(order, static_cast<std::int16_t>(report.failed_level));
  return order.first(static_cast<std::size_t>(failed - order.begin()));
}

}  // namespace surefoot
