#pragma once

#include "surefoot/config/config_tree.hpp"
#include "surefoot/config/scenario_file.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace surefoot::config {

/// What a scenario's files and assignments say together, before it is read into options.
struct ScenarioTree {
  ConfigNode root;
  std::optional<model::RobotDescription> robot;  ///< none if it can't be loaded: to be told later
  std::vector<std::filesystem::path> scenarios;  ///< its own, then its bases
  std::optional<std::filesystem::path> gait;     ///< the gait's
};

/// Merges the file over its gait and its `base:`, each fitted to the robot if it is `scaled`, then
/// applies the assignments. Throws Error.
[[nodiscard]] ScenarioTree read_scenario_tree(const ScenarioRequest& request,
                                              const std::filesystem::path& file);

}  // namespace surefoot::config
