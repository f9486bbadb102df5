#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/config/config_tree.hpp"
#include "surefoot/signals/leg.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace surefoot::config {

/// Suffix that marks the place of a drawn number.
inline constexpr const char* kDrawn = ": randomise";

/// A value that was drawn for a path of the scenario.
struct RandomDraw {
  std::string path;
  double value = 0.0;
  std::string key{};  ///< of `randomise:`: the path, or that of the whole vector
};

/// Includes the files of `randomise: {include: …}`: one name or a list, of data files in
/// randomisations/ or paths relative to `folder`. Files can include others. The section's own
/// ranges have priority, and an empty value removes an included range. Files with `scaled` are
/// fitted to the robot. Returns the files. Throws Error, naming file, line and key, on files that
/// do not exist or hold anything but ranges.
std::vector<std::filesystem::path> include_ranges(ConfigNode& scenario,
                                                  const std::filesystem::path& folder,
                                                  const Scale& scale = {});

/// Checks the assignments `randomise.key=`, which remove ranges. Throws Error on one whose range is
/// not in the scenario or its included files.
void check_taken_ranges(ConfigNode scenario, const std::filesystem::path& folder,
                        const std::vector<std::string>& assignments);

/// Draws the scenario's `randomise:` section, a map from paths to [min, max], uniformly, and writes
/// the values into the scenario. Ranges of whole numbers include both ends. A key with several
/// numbers draws each of them, by its path: sensors.encoders.offset.LF_KFE.
///
/// A value depends on seed and path alone, also across scenarios. `assigned` paths are not drawn.
/// Seed 0 draws nothing. Throws Error on invalid ranges.
std::vector<RandomDraw> randomise(ConfigNode& scenario, std::uint64_t seed,
                                  const std::vector<std::string>& assigned,
                                  int num_legs = kNumLegs);

/// The scenario with every range at its lower end, and with every range at its upper end. If both
/// can be read, each key's draws are within its limits. Empty if nothing is drawn. Throws Error.
[[nodiscard]] std::vector<ConfigNode> ends_of_ranges(const ConfigNode& scenario,
                                                     const std::vector<std::string>& assigned,
                                                     int num_legs = kNumLegs);

/// A uniform number in [0, 1) from a seed and a name, platform-independent.
[[nodiscard]] double uniform_of(std::uint64_t seed, const std::string& name);

}  // namespace surefoot::config
