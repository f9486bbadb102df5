#pragma once

#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/math/smoothstep.hpp"

#include <algorithm>

namespace surefoot {

/// Upper limit of a foot's normal force about its phase changes, Eq. (30) [N]: rises after the
/// touchdown, falls to 0 at the lift-off. `loaded_for`: time since the touchdown, `lifts_in`: time
/// to the lift-off [s], ∞ if none.
[[nodiscard]] inline double ramped_force_max(const ForceOptions& force, double loaded_for,
                                             double lifts_in) {
  if (!force.ramps) return force.max;
  const double up = smooth_ramp(loaded_for, force.ramp_up);
  const double down = smooth_ramp(lifts_in, force.ramp_down);
  return force.max * std::min(up, down);
}

}  // namespace surefoot
