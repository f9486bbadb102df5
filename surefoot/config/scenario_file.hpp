#pragma once

#include "surefoot/config/scenario.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace surefoot::config {

inline constexpr int kLargestSeed = 999'999'999;
/// Of a whole number in digits. Throws Error unless it is from 0 to kLargestSeed.
[[nodiscard]] std::uint64_t parse_seed(const std::string& number);

/// Which experiment, and what to change in it.
struct ScenarioRequest {
  std::string name_or_path;
  /// 0: the nominal run, nothing is drawn from `randomise:`; up to kLargestSeed.
  std::uint64_t seed = 0;
  std::vector<std::string>
      assignments;  ///< "path.to.key=value", laid over the file; they also win over what is drawn
};

/// Reads scenarios/*.yaml with its robot and stack. `base:` names a file that this one is laid
/// over; what that says of its own experiment (description, criteria, success_rate, paper) is not
/// taken over. Throws Error, naming file, line and key, on everything that is unknown, misspelt, of
/// the wrong type or out of range.
[[nodiscard]] Scenario load_scenario(const ScenarioRequest& request);

}  // namespace surefoot::config
