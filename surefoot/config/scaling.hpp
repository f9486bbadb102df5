#pragma once

#include "surefoot/config/config_tree.hpp"
#include "surefoot/config/scenario.hpp"
#include "surefoot/tasks/catalog.hpp"

namespace surefoot::config {

/// Says of a file that its numbers are those for a robot of scale 1, and go with the robot's size.
inline constexpr const char* kScaled = "scaled";

/// Takes `scaled:` out of a file's top. Throws Error if it is neither true nor false.
[[nodiscard]] bool take_scaled(ConfigNode& file);

/// Numbers of a scenario for a robot of scale 1 become those for this robot: of every option that
/// has a unit, of tasks, ranges and criteria; and joints are fitted to this robot's
/// (joint_fitting).
void fit_scenario(ConfigNode& tree, const model::RobotDescription& robot);
/// The same of `randomise:`, a map from options to ranges.
void scale_ranges(ConfigNode& ranges, const Scale& scale);
/// The same of a scenario's defaults, which `options` are those of; drives are the robot's.
void fit_defaults(Group& options, const model::RobotDescription& robot, Scenario& scenario);
/// The default of a task's number for a robot of this scale.
[[nodiscard]] double default_of(const tasks::TaskParameter& parameter, const Scale& scale);
/// Weights against the units of the tasks' rows, so that rows of several units weigh as much
/// against each other as for a robot of scale 1.
void scale_weights(control::LevelSpec& level, const Scale& scale);
/// The numbers of a level's tasks: of all, with the weights where there are several, or of those
/// alone that keep their defaults.
void scale_level(control::LevelSpec& level, const Scale& scale, bool only_defaults);

}  // namespace surefoot::config
