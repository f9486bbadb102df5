#pragma once

#include "surefoot/tasks/task_definition.hpp"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::tasks {

/// The library's tasks, in the order of Table I, then ours.
[[nodiscard]] std::span<const TaskInfo> task_catalog();

/// The library's tasks, then the user's own.
[[nodiscard]] std::vector<TaskInfo> task_infos(const OwnTasks& own);

/// Names of the library's tasks and of the user's own.
[[nodiscard]] std::vector<std::string> task_names(const OwnTasks& own = {});

/// The entry of a task. Throws UnknownNameError, listing the tasks.
[[nodiscard]] const TaskInfo& task_info(std::string_view name);
[[nodiscard]] const TaskInfo& task_info(std::string_view name, const OwnTasks& own);

/// Makes a task by name. Throws UnknownNameError for an unknown task, parameter or choice, and
/// Error for a number that is not finite or out of range; the message says what would be valid.
[[nodiscard]] std::unique_ptr<Task> make_task(std::string_view name,
                                              const TaskParameters& parameters = {},
                                              const OwnTasks& own = {});

}  // namespace surefoot::tasks
