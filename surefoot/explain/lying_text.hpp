#pragma once

#include "surefoot/simulation/ground_truth.hpp"

#include <string>

namespace surefoot::explain {

/// What of a robot has touched the ground within `kLyingWindow`: who lies rattles.
struct GroundTouch {
  PerLeg<bool> feet{};
  bool torso = false;
  int shanks = 0;        ///< bit k: thigh, knee or shank of leg k
  double largest = 0.0;  ///< force on another part than a foot [N]

  void see(const simulation::GroundTruth& truth);
};

inline constexpr double kLyingWindow = 0.05;  // [s]

/// What of it beside its feet: "its torso, up to 152 N on a part"; empty of one on its feet.
[[nodiscard]] std::string lying_text(const GroundTouch& touch);

}  // namespace surefoot::explain
