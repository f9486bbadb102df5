#pragma once

#include "surefoot/config/scenario.hpp"
#include "surefoot/gaits/own_gaits.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace surefoot::config {

inline constexpr int kLargestSeed = 999'999'999;
/// Reads a whole number. Throws Error unless it is from 0 to kLargestSeed.
[[nodiscard]] std::uint64_t parse_seed(const std::string& number);

/// Which experiment, and what to change in it.
struct ScenarioRequest {
  std::string name_or_path;
  /// At most kLargestSeed; 0: the nominal run, without draws.
  std::uint64_t seed = 0;
  std::vector<std::string>
      assignments;  ///< "path.to.key=value", applied to the file, with priority over draws
  tasks::OwnTasks own_tasks = {};  ///< of the user, that the stack can name
  gaits::OwnGaits own_gaits = {};  ///< of the user, that `gait:`, `gaits:` and commands can name
};

/// Reads scenarios/*.yaml with its robot and stack. The file is merged over its `base:`, except for
/// the base's description, criteria, success_rate and paper. Throws Error, naming file, line and
/// key, on unknown keys and names, wrong types and numbers out of range.
[[nodiscard]] Scenario load_scenario(const ScenarioRequest& request);

}  // namespace surefoot::config
