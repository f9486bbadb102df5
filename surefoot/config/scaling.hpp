#pragma once

#include "surefoot/config/config_tree.hpp"
#include "surefoot/config/scenario.hpp"
#include "surefoot/tasks/catalog.hpp"

namespace surefoot::config {

/// Key of files whose numbers are for a robot of scale 1 and are scaled to the robot.
inline constexpr const char* kScaled = "scaled";

/// Removes the key `scaled:` and returns its value. Throws Error unless it is true or false.
[[nodiscard]] bool take_scaled(ConfigNode& file);

/// Scales a scenario from a robot of scale 1 to this robot: every option with a unit, tasks, ranges
/// and criteria; also fits joints to this robot's (joint_fitting).
void fit_scenario(ConfigNode& tree, const model::RobotDescription& robot);
/// The same for `randomise:`, a map from options to ranges.
void scale_ranges(ConfigNode& ranges, const Scale& scale);
/// The same for the defaults of a scenario, whose fields are `options`; drives are the robot's.
void fit_defaults(Group& options, const model::RobotDescription& robot, Scenario& scenario);
/// The default of a task's number for a robot of this scale.
[[nodiscard]] double default_of(const tasks::TaskParameter& parameter, const Scale& scale);
/// Weights against the units of the tasks' rows, to keep the balance of rows with different units.
void scale_weights(control::LevelSpec& level, const Scale& scale, const tasks::OwnTasks& own = {});
/// The same for the parameters of a level's tasks: for all, with the weights where there are
/// several, or only for defaults.
void scale_level(control::LevelSpec& level, const Scale& scale, const tasks::OwnTasks& own,
                 bool only_defaults);

}  // namespace surefoot::config
