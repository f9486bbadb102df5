#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/tasks/task.hpp"

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::tasks {

/// A number parameter of a task.
struct TaskParameter {
  std::string_view name;
  double default_value = 0.0;
  double minimum = 0.0;  ///< smallest legal value
  std::string_view unit;
  std::string_view help;
  Sizing sizing = Sizing::by_unit;
};

/// A parameter of a task with a few allowed words.
struct TaskChoice {
  std::string_view name;
  std::vector<std::string_view> values;
  std::string_view default_value;
  std::string_view help;
};

/// What a stack file may set for a task, and what `list tasks` shows.
struct TaskInfo {
  std::string_view name;
  std::string_view summary;
  std::string_view equation;  ///< of Bellicoso 2016
  std::string_view unit;      ///< of its rows; "N and N·m" for several
  std::vector<TaskParameter> parameters;
  std::vector<TaskChoice> choices;
};

/// Values by name; others keep their defaults.
struct TaskParameters {
  std::map<std::string, double> numbers;       ///< e.g. kp: 500
  std::map<std::string, std::string> choices;  ///< e.g. form: radial
};

/// All tasks, in the order of Table I, then ours.
[[nodiscard]] std::span<const TaskInfo> task_catalog();

/// The catalog's entry. Throws UnknownNameError, listing the tasks.
[[nodiscard]] const TaskInfo& task_info(std::string_view name);

/// Makes a task by name. Throws UnknownNameError for an unknown task, parameter or choice, and
/// Error for a number that is not finite or out of range; the message says what would be valid.
[[nodiscard]] std::unique_ptr<Task> make_task(std::string_view name,
                                              const TaskParameters& parameters = {});

}  // namespace surefoot::tasks
