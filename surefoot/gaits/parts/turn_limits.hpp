#pragma once

namespace surefoot {

/// How far a foot may be left behind, sideways, by a heading that turns: a share of max_side_step.
inline constexpr double kMostBehind = 0.5625;

/// Before that the heading is slowed down in proportion to what is left, times this.
inline constexpr double kBrake = 3.0;

/// Whether the heading waits for the feet not only in a turn's first steps but for good: a foot is
/// left behind by half of its stride, sideways, when it steps again. `side_stride`: of a foot in a
/// cycle, as the turn makes it [m].
[[nodiscard]] constexpr bool turns_slower(double side_stride, double max_side_step) {
  constexpr double kFree = kMostBehind * (1.0 - 1.0 / kBrake);
  return 0.5 * side_stride > kFree * max_side_step;
}

}  // namespace surefoot
