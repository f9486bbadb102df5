#pragma once

#include "surefoot/signals/hierarchy_report.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace surefoot {

/// How a level came out.
enum class LevelStatus : std::int8_t {
  met = 0,
  missed,       ///< its residual is more than rounding
  no_rows,      ///< it asks for nothing
  cut_off,      ///< the solve ended early in it
  not_reached,  ///< the solve ended early above it
  not_solved,   ///< nothing was solved
};

inline constexpr std::array<std::string_view, 6> kLevelStatusNames{
    "met", "missed", "no rows", "cut off", "not reached", "not solved"};

[[nodiscard]] constexpr std::string_view name_of(LevelStatus status) {
  return kLevelStatusNames[static_cast<std::size_t>(status)];
}

/// Of a level that was solved.
[[nodiscard]] LevelStatus level_status(const LevelReport& level);

/// Of a level of the report, by its place in the order of priority.
[[nodiscard]] LevelStatus level_status(const HierarchyReport& report, std::size_t place);

}  // namespace surefoot
