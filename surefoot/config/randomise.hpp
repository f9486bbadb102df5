#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/config/config_tree.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace surefoot::config {

/// What follows the place of a range in that of the numbers drawn from it.
inline constexpr const char* kDrawn = ": randomise";

/// A value that was drawn for a path of the scenario.
struct RandomDraw {
  std::string path;
  double value = 0.0;
  std::string key{};  ///< of `randomise:` that it belongs to: the path, or that of the whole vector
};

/// Lays the files that `randomise: {include: …}` names under the section's own ranges: one name or
/// a list, of data files in randomisations/ or paths as seen from `folder`; a file can include
/// others in the same way. An entry with nothing
/// behind it takes an included range away. Returns the files. Throws Error, naming file, line and
/// key, on files that do not exist or hold anything but ranges.
/// Files that are `scaled` are fitted to the robot.
std::vector<std::filesystem::path> include_ranges(ConfigNode& scenario,
                                                  const std::filesystem::path& folder,
                                                  const Scale& scale = {});

/// Assignments can take ranges away, `randomise.key=` with nothing behind it. Throws Error on one
/// that is not there, in `scenario` as it is without such assignments, files included.
void check_taken_ranges(ConfigNode scenario, const std::filesystem::path& folder,
                        const std::vector<std::string>& assignments);

/// Draws the scenario's `randomise:` section, a map from paths to [min, max], uniformly, and writes
/// the values into the scenario. Both ends are included where the key takes whole numbers. For a
/// key with several numbers each gets its own, told by its name: sensors.encoders.offset.LF_KFE.
///
/// A value depends on seed and path alone, so that scenarios which share a path and a seed share
/// the value too. Paths that were `assigned` are not drawn. Seed 0 draws nothing. Throws Error on
/// ranges that make no sense.
std::vector<RandomDraw> randomise(ConfigNode& scenario, std::uint64_t seed,
                                  const std::vector<std::string>& assigned);

/// The scenario with every range at its lower end, and with every range at its upper end: what is
/// read of both says whether all draws of each key lie in its limits. None where nothing is drawn.
/// Throws as randomise() does.
[[nodiscard]] std::vector<ConfigNode> ends_of_ranges(const ConfigNode& scenario,
                                                     const std::vector<std::string>& assigned);

/// A uniform number in [0, 1) from a seed and a name, the same on every machine.
[[nodiscard]] double uniform_of(std::uint64_t seed, const std::string& name);

}  // namespace surefoot::config
