#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot {

// Of a robot without arms.
inline constexpr int kNumVelocities = 6 + kNumLegJoints;
inline constexpr int kNumUnknowns = kNumVelocities + kNumLegJoints;

}  // namespace surefoot
