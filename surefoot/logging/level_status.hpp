#pragma once

#include "surefoot/signals/hierarchy_report.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace surefoot::logging {

/// Result of a level.
enum class LevelStatus : std::int8_t {
  met = 0,
  missed,       ///< its residual exceeds rounding
  no_rows,      ///< it has no rows
  cut_off,      ///< the solver stopped early in it
  not_reached,  ///< the solver stopped early above it
  not_solved,   ///< nothing was solved
};

inline constexpr std::array<std::string_view, 6> kLevelStatusNames{
    "met", "missed", "no rows", "cut off", "not reached", "not solved"};

[[nodiscard]] constexpr std::string_view name_of(LevelStatus status) {
  return kLevelStatusNames[static_cast<std::size_t>(status)];
}

/// Of a solved level.
[[nodiscard]] LevelStatus level_status(const LevelReport& level);

/// Of the report's level at this place in the order of priority.
[[nodiscard]] LevelStatus level_status(const HierarchyReport& report, std::size_t place);

}  // namespace surefoot::logging
