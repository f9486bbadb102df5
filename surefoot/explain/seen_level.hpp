#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace surefoot::explain {

/// How a level came out at a tick, as people see it.
enum class SeenLevel : int {
  not_solved = 0,  ///< also where the command is not the solution's
  no_rows,
  met,
  at_limit,   ///< met, and a row of it is at a bound
  gives_way,  ///< its residual is more than `visible_residual`
  minimised,  ///< never content, and as small as can be
};

inline constexpr std::array<std::string_view, 6> kSeenLevelNames{
    "not solved", "no rows", "met", "at limit", "gives way", "minimised"};

/// Of a solved level; `visible`: see `visible_residual`.
[[nodiscard]] constexpr SeenLevel seen_level(std::size_t num_rows, double residual, double visible,
                                             bool is_at_bound) {
  if (num_rows == 0) return SeenLevel::no_rows;
  if (visible != visible) return SeenLevel::minimised;
  if (residual > visible) return SeenLevel::gives_way;
  return is_at_bound ? SeenLevel::at_limit : SeenLevel::met;
}

}  // namespace surefoot::explain
