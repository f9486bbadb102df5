#pragma once

#include "surefoot/config/config_tree.hpp"
#include "surefoot/config/scenario.hpp"
#include "surefoot/gaits/own_gaits.hpp"

#include <functional>
#include <string>
#include <vector>

namespace surefoot::config {

/// Name of no gait: the speed decides.
inline constexpr const char* kAutoGait = "auto";
/// The gait of a name; of `auto` that of a slow robot.
[[nodiscard]] ConfigNode slowest(const ConfigNode& gait);

/// Replaces the list `gaits:` by a map from the names of all gaits that the scenario can change to,
/// in its list, its `gait:` (`own`, may be null) or its commands, to the whole `planner:` in each,
/// which `planner_of` gives. Takes the list away where there is one gait only, which is neither in
/// the list nor one of the user's.
void load_gaits(ConfigNode& tree, const ConfigNode* own, const gaits::OwnGaits& of_user,
                const std::function<ConfigNode(const ConfigNode& name)>& planner_of);
/// Sets in all gaits what the seed has drawn for `planner:`.
void draw_gaits(ConfigNode& tree, const std::vector<RandomDraw>& drawn);
/// Reads the gaits of such a map, each by `read` from a scenario that walks in it, and finds those
/// of `gait:` and of the commands.
void read_gaits(const ConfigNode& tree, const gaits::OwnGaits& of_user,
                const std::function<gaits::PlannerOptions(const ConfigNode& scenario)>& read,
                Scenario& scenario);

/// What commands may call a run's gaits: their names, and `auto` where the speed can choose.
[[nodiscard]] std::vector<std::string> gait_names(const std::vector<gaits::NamedGait>& gaits);
/// End of an error message about a gait that is not among these names.
[[nodiscard]] std::string valid_gaits(const std::string& given,
                                      const std::vector<std::string>& names);
/// The gait of such a name in a command. Throws UnknownNameError with those that there are.
[[nodiscard]] int gait_place(const std::string& name, const std::vector<std::string>& names);

}  // namespace surefoot::config
