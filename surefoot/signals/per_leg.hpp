#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot {

/// The same for every leg. (The vectors of a PerLeg<Vec3>{} are not zero.)
template <typename T>
[[nodiscard]] constexpr PerLeg<T> per_leg(const T& value, int num_legs = kNumLegs) {
  return PerLeg<T>(num_legs, value);
}

}  // namespace surefoot
