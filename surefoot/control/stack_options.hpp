#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace surefoot::control {

/// One task of a stack file: its name in the catalog and its parameters as written.
struct TaskSpec {
  std::string task;
  std::map<std::string, double> numbers;       ///< e.g. kp: 500
  std::map<std::string, std::string> choices;  ///< e.g. form: radial
  double weight = 1.0;  ///< on its rows, against the other tasks of its level; residuals have it
};

/// One priority level; usually one task.
struct LevelSpec {
  std::string name;
  std::vector<TaskSpec> tasks;
  double damping = 0.0;  ///< see `add_damping`, towards x = 0; 0 is none
};

/// A hierarchy as data, read from stacks/*.yaml; highest priority first.
struct StackOptions {
  std::string name;
  std::vector<LevelSpec> levels;
};

/// Has the level a task without which the torques mean nothing: equations of motion, contacts,
/// torque or contact force limits?
[[nodiscard]] bool keeps_physics(const LevelSpec& level);

/// The same tasks with all levels from `first` on as one last level, "weighted", where they count
/// by their weights instead of by their order. Damping of these levels is left out. Throws Error
/// where one of them keeps the physics: a robot can't trade that for a task.
[[nodiscard]] StackOptions weighted_from(StackOptions stack, std::size_t first);

}  // namespace surefoot::control
