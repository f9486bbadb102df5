#pragma once

#include "surefoot/config/config_tree.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace surefoot {

/// A value that was drawn for a path of the scenario.
struct RandomDraw {
  std::string path;
  double value = 0.0;
};

/// Draws the scenario's `randomise:` section, a map from paths to [min, max], uniformly. A value
/// depends on seed and path alone, so that scenarios which share a path and a seed share the value
/// too. Seed 0 draws nothing. Throws Error on ranges that make no sense.
[[nodiscard]] std::vector<RandomDraw> draw_random(const ConfigNode& scenario, std::uint64_t seed);

/// A uniform number in [0, 1) from a seed and a name, the same on every machine.
[[nodiscard]] double uniform_of(std::uint64_t seed, const std::string& name);

}  // namespace surefoot
