#pragma once

#include "surefoot/signals/leg.hpp"

#include <vector>

namespace surefoot {

/// As in messages: "LF_HAA", or an arm's joint by its name among those of all joints of the robot.
[[nodiscard]] inline std::string joint_name(int joint, const std::vector<std::string>& names) {
  const auto place = static_cast<std::size_t>(joint);
  if (joint < kNumLegJoints) return leg_joint_name(joint);
  return place < names.size() ? names[place] : "joint " + std::to_string(joint + 1);
}

}  // namespace surefoot
