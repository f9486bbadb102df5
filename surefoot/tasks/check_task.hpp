#pragma once

#include "surefoot/tasks/task_definition.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::tasks {

/// Tries a task, of your own or the library's, in 64 states of a robot, with all sets of feet down,
/// and with each of its choices. Returns what is wrong, in sentences; empty if nothing. Call it in
/// your tests: it finds what throws, what the solver can't solve, rows that differ for the same
/// input, ids without a name and, in a program that links `surefoot::count_allocations`,
/// allocation.
[[nodiscard]] std::vector<std::string> check_task(std::string_view name,
                                                  const model::RobotDescription& robot,
                                                  const OwnTasks& own = {});

}  // namespace surefoot::tasks
