#pragma once

#include "surefoot/tasks/task.hpp"

#include <string>
#include <string_view>

namespace surefoot::tasks {

/// Throws Error unless a prepared task has the name by which stacks call it, and sizes that hold.
void check_sizes(const Task& task, std::string_view name);

/// What is wrong with the rows that a task has just written from row `first` on; empty if nothing.
/// Allocates only for what is wrong.
[[nodiscard]] std::string what_is_wrong(const Task& task, const solver::Level& level,
                                        Eigen::Index first);

}  // namespace surefoot::tasks
