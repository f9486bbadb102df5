#pragma once

#include "server/view_session.hpp"
#include "surefoot/control/stack_options.hpp"
#include "surefoot/control/stack_reach.hpp"

#include <string>
#include <vector>

namespace surefoot::server {

/// A number of a task with the range in which the page may change it: from the smallest legal value
/// to ten times the default, or what is still legal of that and within the robot's reach.
[[nodiscard]] ViewNumber view_number(const std::string& task, const std::string& name, double value,
                                     const control::StackReach& reach = {});

/// The tasks of a stack with all its defaults; levels numbered as in `level_names`.
[[nodiscard]] std::vector<ViewTask> view_tasks(const control::StackOptions& stack,
                                               const std::vector<std::string>& level_names,
                                               const control::StackReach& reach = {});

/// A task as changes and refusals call it: "motion, com_xy"; where its level has its name, by that.
[[nodiscard]] std::string task_title(const control::LevelSpec& level,
                                     const control::TaskSpec& task);

/// What is another in the second stack, which has the levels and tasks of the first:
/// "com_xy kp 100 → 150; order: torso_yaw from 8 to 5". Empty where nothing is.
[[nodiscard]] std::string change_text(const control::StackOptions& before,
                                      const control::StackOptions& after);

/// "0.4 → 0.5", with four digits that count.
[[nodiscard]] std::string change_text(double before, double after);

}  // namespace surefoot::server
