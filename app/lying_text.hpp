#pragma once

#include "surefoot/simulation/ground_truth.hpp"

#include <string>

namespace surefoot {

/// What of a robot beside its feet is on the ground: "its torso, up to 152 N on a part"; empty of
/// one on its feet.
[[nodiscard]] std::string lying_text(const GroundTruth& truth);

}  // namespace surefoot
