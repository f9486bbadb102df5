#pragma once

#include "surefoot/gaits/planner_options.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {

/// How far a leg reaches along the ground with its hip at a height over it [m].
[[nodiscard]] inline double horizontal_reach(const SwingOptions& swing, double height) {
  const double reach = swing.reach_max;
  return std::sqrt(std::max(0.0, reach * reach - height * height));
}

}  // namespace surefoot
