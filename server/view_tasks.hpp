#pragma once

#include "server/view_session.hpp"
#include "surefoot/control/stack_options.hpp"
#include "surefoot/control/stack_reach.hpp"

#include <string>
#include <vector>

namespace surefoot::server {

/// A number of a task with its range on the page: from the smallest legal value to ten times the
/// default, as far as that is legal and within the robot's reach.
[[nodiscard]] ViewNumber view_number(const std::string& task, const std::string& name, double value,
                                     const control::StackReach& reach = {});

/// The tasks of a stack with all its defaults; levels numbered as in `level_names`.
[[nodiscard]] std::vector<ViewTask> view_tasks(const control::StackOptions& stack,
                                               const std::vector<std::string>& level_names,
                                               const control::StackReach& reach = {});

/// Name of a task in messages: "motion, com_xy"; the level's alone if both are the same.
[[nodiscard]] std::string task_title(const control::LevelSpec& level,
                                     const control::TaskSpec& task);

/// Differences between stacks with the same levels and tasks: "com_xy kp 100 → 150; order:
/// torso_yaw from 8 to 5". Empty: none.
[[nodiscard]] std::string change_text(const control::StackOptions& before,
                                      const control::StackOptions& after);

/// "0.4 → 0.5", with four significant digits.
[[nodiscard]] std::string change_text(double before, double after);

}  // namespace surefoot::server
