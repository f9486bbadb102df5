#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/config/config_tree.hpp"
#include "surefoot/gaits/own_gaits.hpp"
#include "surefoot/model/description.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace surefoot::config {

/// What a gait file holds: the part of `planner:` that makes the gait, with a description.
[[nodiscard]] Group gait_fields(gaits::PlannerOptions& planner, std::string& description);

/// Lays the scenario's `planner:` over that of a gait, fitted to the robot if the gait's file is
/// `scaled`. A name is that of a file in gaits/, or a path relative to `folder`; `none` is the
/// crawl, and a gait of the user's `own` has no file. Returns the gait's file. Throws Error, also
/// where the gait is for other legs.
std::optional<std::filesystem::path> include_gait(ConfigNode& scenario, const ConfigNode& name,
                                                  const std::filesystem::path& folder,
                                                  const model::RobotDescription* robot,
                                                  const gaits::OwnGaits& own = {});

/// Removes the key `gait:`.
void remove_gait(ConfigNode& scenario);

}  // namespace surefoot::config
