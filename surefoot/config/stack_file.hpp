#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/config/config_tree.hpp"
#include "surefoot/control/stack_options.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace surefoot::config {

/// Reads stacks/*.yaml by name or path: levels, highest priority first, each with one task or a
/// list of them.
///
///     levels:
///       - task: com_position        # with its parameters
///         kp: 500
///       - name: contact forces
///         tasks: [{task: friction_pyramid}, {task: normal_force}]
///
/// or the levels of another stack, without some of them:
///
///     base: terrain_adaptation
///     without: [limb_extension_limits]
///
/// or the base's levels by name, in any order, among others:
///
///     base: terrain_adaptation
///     levels:
///       - com_xy
///       - {task: body_height_limits, min: 0.3}
///       - swing_foot
///
/// A task may have a `weight` > 0, a factor on its rows and therefore on the residual; a level may
/// have a `damping` d ≥ 0 for singularities (see `add_damping`, x_ref = 0; d in units of the rows
/// per unit of x). For comparisons a stack can be weighted instead of strict from a level on; these
/// levels become the last one, named "weighted":
///
///     base: terrain_adaptation
///     weights: {com_xy: 100, swing_foot: 30}      # default 1
///     weighted_from: com_xy
///
/// Numbers of a file with `scaled: true`, and all defaults, are scaled to the robot. Levels can
/// name tasks of the user's `own`. Throws Error, also on unknown tasks and parameters.
[[nodiscard]] control::StackOptions load_stack(const std::string& name_or_path,
                                               const std::filesystem::path& beside = {},
                                               const Scale& scale = {},
                                               const tasks::OwnTasks& own = {});

/// The same for a stack file's text; `name` stands for the file in errors. Throws Error.
[[nodiscard]] control::StackOptions parse_stack(const std::string& text, const std::string& name,
                                                const Scale& scale = {},
                                                const tasks::OwnTasks& own = {});

/// `control::with_arms`, `with_further_joints` and `with_stops`, with the numbers of their levels
/// scaled to the robot.
[[nodiscard]] control::StackOptions with_scaled_arms(const control::StackOptions& stack,
                                                     const model::RobotDescription& robot);

/// The files of a stack: its own, then those of its bases, recursively. Throws Error.
[[nodiscard]] std::vector<std::filesystem::path> stack_files(
    const std::string& name_or_path, const std::filesystem::path& beside = {});

/// Overrides parameters of tasks: `tasks` is a map from task names to maps of parameters. Throws
/// Error on a task that the stack does not have.
void override_tasks(control::StackOptions& stack, const ConfigNode& tasks, const std::string& path);

}  // namespace surefoot::config
