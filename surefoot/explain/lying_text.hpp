#pragma once

#include "surefoot/simulation/ground_truth.hpp"

#include <string>

namespace surefoot::explain {

/// Parts of the robot that touched the ground within `kLyingWindow`: contacts of a lying robot come
/// and go.
struct GroundTouch {
  PerLeg<bool> feet{};
  bool torso = false;
  int shanks = 0;        ///< bit k: thigh, knee or shank of leg k
  double largest = 0.0;  ///< force on another part than a foot [N]

  void see(const simulation::GroundTruth& truth);
};

inline constexpr double kLyingWindow = 0.05;  ///< [s]

/// What it lies on besides its feet: "its torso, up to 152 N on a part"; empty if it stands.
[[nodiscard]] std::string lying_text(const GroundTouch& touch);

}  // namespace surefoot::explain
