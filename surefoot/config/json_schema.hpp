#pragma once

#include "surefoot/tasks/task_definition.hpp"

#include <string>
#include <vector>

namespace surefoot::config {

/// The kinds of files that have a schema: scenario, randomisation, robot, stack.
[[nodiscard]] const std::vector<std::string>& kinds_of_files();

/// JSON Schema (draft 2020-12) of a kind of file, generated from its options: keys, types, ranges,
/// valid names. It has no rules between keys, and requires no key of a scenario. Stacks and
/// scenarios may name the tasks of the user's `own`, too.
[[nodiscard]] std::string json_schema(const std::string& kind, const tasks::OwnTasks& own = {});

}  // namespace surefoot::config
