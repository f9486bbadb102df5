#pragma once

#include "surefoot/signals/tick_record.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

namespace surefoot::logging {

/// Values of `HierarchyReport::status`, as in the log's schema.
inline constexpr std::int32_t kIterationCap = 1, kInvalidInput = 2;

/// False if no state was believed, or the solver's input was invalid: the record's forces and
/// residuals are not of that tick.
[[nodiscard]] inline bool was_solved(const HierarchyReport& report) {
  return report.status != kInvalidInput;
}

/// False also if the controller stopped for safety at that tick, after the solver: solution and
/// plan are not used.
[[nodiscard]] inline bool was_used(const TickRecord& tick) {
  const CommandMode mode = tick.command.mode;
  return was_solved(tick.hierarchy) && mode != CommandMode::sit && mode != CommandMode::damping;
}

/// The tick's levels at their optimum, by their numbers in the header, highest first. If the solve
/// was cut off, the numbers of the other levels mean nothing.
[[nodiscard]] inline std::span<const std::int16_t> solved_levels(
    const TickRecord& tick, std::span<const std::int16_t> order) {
  const HierarchyReport& report = tick.hierarchy;
  if (!was_used(tick)) return {};
  if (report.status != kIterationCap) return order;
  const auto failed = std::ranges::find(order, static_cast<std::int16_t>(report.failed_level));
  return order.first(static_cast<std::size_t>(failed - order.begin()));
}

/// Residual of a level by its place, for a tick that was computed and not read. NaN: not solved.
[[nodiscard]] inline double computed_residual(const HierarchyReport& report, std::size_t level) {
  const auto place = static_cast<std::int32_t>(level);
  const bool is_cut_off = report.status == kIterationCap;
  const bool is_known = was_solved(report) && place < report.num_levels &&
                        !(is_cut_off && report.failed_level >= 0 && place >= report.failed_level);
  return is_known ? report.levels[level].residual : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace surefoot::logging
