#pragma once

#include <map>
#include <string>
#include <vector>

namespace surefoot {

/// One task of a stack file: its name in the catalog and its parameters as written.
struct TaskSpec {
  std::string task;
  std::map<std::string, double> numbers;       ///< e.g. kp: 500
  std::map<std::string, std::string> choices;  ///< e.g. form: radial
};

/// One priority level; usually one task.
struct LevelSpec {
  std::string name;
  std::vector<TaskSpec> tasks;
};

/// A hierarchy as data, read from stacks/*.yaml; highest priority first.
struct StackOptions {
  std::string name;
  std::vector<LevelSpec> levels;
};

}  // namespace surefoot
