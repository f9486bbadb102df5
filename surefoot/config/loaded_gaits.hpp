#pragma once

#include "surefoot/config/config_tree.hpp"
#include "surefoot/config/scenario.hpp"
#include "surefoot/gaits/own_gaits.hpp"

#include <functional>

namespace surefoot::config {

/// Name of no gait: the speed decides.
inline constexpr const char* kAutoGait = "auto";
/// The gait of a name; of `auto` that of a slow robot.
[[nodiscard]] ConfigNode slowest(const ConfigNode& gait);

/// Replaces the list `gaits:` by a map from the names of all gaits that the scenario can change to,
/// in its list, its `gait:` (`own`, may be null) or its commands, to the whole `planner:` in each,
/// which `planner_of` gives. Does nothing where there is one gait only, unless that is one of the
/// user's.
void load_gaits(ConfigNode& tree, const ConfigNode* own, const gaits::OwnGaits& of_user,
                const std::function<ConfigNode(const ConfigNode& name)>& planner_of);
/// Sets in all gaits what the seed has drawn for `planner:`.
void draw_gaits(ConfigNode& tree, const std::vector<RandomDraw>& drawn);
/// Reads the gaits of such a map, each by `read` from a scenario that walks in it, and finds those
/// of `gait:` and of the commands.
void read_gaits(const ConfigNode& tree, const gaits::OwnGaits& of_user,
                const std::function<gaits::PlannerOptions(const ConfigNode& scenario)>& read,
                Scenario& scenario);

}  // namespace surefoot::config
