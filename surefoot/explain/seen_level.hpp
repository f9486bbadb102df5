#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace surefoot::explain {

/// Status of a level at a tick, as the viewer shows it.
enum class SeenLevel : int {
  not_solved = 0,  ///< or its solution was not used
  no_rows,
  met,
  at_limit,   ///< met, with a row at a bound
  gives_way,  ///< its residual is more than `visible_residual`
  minimised,  ///< minimises forces or torques: always has a residual
};

inline constexpr std::array<std::string_view, 6> kSeenLevelNames{
    "not solved", "no rows", "met", "at limit", "gives way", "minimised"};

/// For a solved level; `visible`: see `visible_residual`.
[[nodiscard]] constexpr SeenLevel seen_level(std::size_t num_rows, double residual, double visible,
                                             bool is_at_bound) {
  if (num_rows == 0) return SeenLevel::no_rows;
  if (visible != visible) return SeenLevel::minimised;
  if (residual > visible) return SeenLevel::gives_way;
  return is_at_bound ? SeenLevel::at_limit : SeenLevel::met;
}

}  // namespace surefoot::explain
