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
///       - task: com_position        # its parameters stand beside it
///         kp: 500
///       - name: contact forces
///         tasks: [{task: friction_pyramid}, {task: normal_force}]
///
/// or the levels of another stack, some left out:
///
///     base: terrain_adaptation
///     without: [limb_extension_limits]
///
/// or in another order, with others between them; those of the base stand there by name:
///
///     base: terrain_adaptation
///     levels:
///       - com_xy
///       - {task: body_height_limits, min: 0.3}
///       - swing_foot
///
/// A task may have a `weight` > 0 against the others of its level, on its rows and so in the
/// residual; a level `damping` d ≥ 0 near singularities (see `add_damping`, x_ref = 0; d in units
/// of the rows per unit of x). And a stack can be weighted instead of strict from a level on, to
/// compare the two with the same tasks; this one becomes the last level, named "weighted":
///
///     base: terrain_adaptation
///     weights: {com_xy: 100, swing_foot: 30}      # 1 where none is given
///     weighted_from: com_xy
///
/// Numbers of a file that is `scaled: true`, and all defaults, go with the robot's size. Unknown
/// tasks and parameters are errors. Throws Error.
[[nodiscard]] control::StackOptions load_stack(const std::string& name_or_path,
                                               const std::filesystem::path& beside = {},
                                               const Scale& scale = {});

/// The same of a stack file's text; `name` stands for the file in errors. Throws Error.
[[nodiscard]] control::StackOptions parse_stack(const std::string& text, const std::string& name,
                                                const Scale& scale = {});

/// The files that a stack is read from: its own, then that of its base, that one's base, …
/// Throws Error.
[[nodiscard]] std::vector<std::filesystem::path> stack_files(
    const std::string& name_or_path, const std::filesystem::path& beside = {});

/// Lays parameters over every task of that name: a map from task names to maps of parameters.
/// Throws Error on a task that the stack does not have.
void override_tasks(control::StackOptions& stack, const ConfigNode& tasks, const std::string& path);

}  // namespace surefoot::config
