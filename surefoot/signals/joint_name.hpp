#pragma once

#include "surefoot/signals/leg.hpp"

#include <vector>

namespace surefoot {

/// Names of all joints as in messages: "LF_HAA" for those of legs with three, `names` of the URDF
/// for all others. Two legs have other numbers of joints.
[[nodiscard]] inline std::vector<std::string> told_joints(std::vector<std::string> names,
                                                          int num_legs) {
  if (num_legs < kNumLegs) return names;
  const int known = std::min(kJointsPerLeg * num_legs, static_cast<int>(names.size()));
  for (int i = 0; i < known; ++i) names[static_cast<std::size_t>(i)] = leg_joint_name(i, num_legs);
  return names;
}

}  // namespace surefoot
