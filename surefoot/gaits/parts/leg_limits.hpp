#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/math/numbers.hpp"
#include "surefoot/math/smoothstep.hpp"
#include "surefoot/signals/per_leg.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {

/// A time that is never reached [s].
inline constexpr double kNever = kInfinity;

/// Place of a leg along the torso: 1 for the front pair, −1 for the hind one, evenly between.
[[nodiscard]] inline double along(Leg leg, int num_legs) {
  const int pair = static_cast<int>(leg) / 2, last = num_legs / 2 - 1;
  return 1.0 - 2.0 * pair / last;
}

/// Foot of the nominal stance relative to the stance's centre, in heading axes [m].
[[nodiscard]] inline Vec2 nominal_offset(const StanceOptions& stance, Leg leg, int num_legs) {
  return {along(leg, num_legs) * stance.half_length,
          is_left(leg) ? stance.half_width : -stance.half_width};
}

/// Feet as seen from above.
[[nodiscard]] inline PerLeg<Vec2> on_the_ground(const PerLeg<Vec3>& feet) {
  PerLeg<Vec2> result(static_cast<int>(feet.size()), Vec2::Zero());
  for (std::size_t k = 0; k < feet.size(); ++k) result[k] = feet[k].head<2>();
  return result;
}

/// Height of the hips over the feet in the nominal stance [m].
[[nodiscard]] inline double hip_height(const StanceOptions& stance, const Scale& scale) {
  return stance.height + scale.hip_height;
}

/// Horizontal reach of a foot with the hip at this height over it [m].
[[nodiscard]] inline double horizontal_reach(const SwingOptions& swing, double height) {
  return std::sqrt(std::max(0.0, swing.reach_max * swing.reach_max - height * height));
}

/// Upper limit of a foot's normal force about its phase changes, Eq. (30) [N]: rises after the
/// touchdown, falls to 0 at the lift-off. `loaded_for`: since the touchdown, `lifts_in`: to the
/// lift-off [s].
[[nodiscard]] inline double ramped_force_max(const ForceOptions& force, double loaded_for,
                                             double lifts_in) {
  if (!force.ramps) return force.max;
  const double up = smooth_ramp(loaded_for, force.ramp_up);
  const double down = smooth_ramp(lifts_in, force.ramp_down);
  return force.max * std::min(up, down);
}

}  // namespace surefoot::gaits
