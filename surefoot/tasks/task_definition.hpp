#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/tasks/task.hpp"

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::tasks {

/// A number parameter of a task.
struct TaskParameter {
  std::string name;
  double default_value = 0.0;
  double minimum = 0.0;  ///< smallest legal value
  std::string unit = "–";
  std::string help = {};
  Sizing sizing = Sizing::by_unit;
};

/// A parameter of a task with a few allowed words.
struct TaskChoice {
  std::string name;
  std::vector<std::string> values;
  std::string default_value;
  std::string help = {};
  std::string others = {};  ///< what else is allowed, for lists: "FRAME"; empty: nothing
};

/// All that a choice may be, for lists.
[[nodiscard]] std::vector<std::string> words_of(const TaskChoice& choice);

/// What a stack file may set for a task, and what `list tasks` shows.
struct TaskInfo {
  std::string name;
  std::string summary = {};
  std::string equation = {};  ///< of Bellicoso 2016
  std::string unit = "–";     ///< of its rows; "N and N·m" for several
  std::vector<TaskParameter> parameters = {};
  std::vector<TaskChoice> choices = {};
};

/// Values by name; others keep their defaults.
struct TaskParameters {
  std::map<std::string, double> numbers;       ///< e.g. kp: 500
  std::map<std::string, std::string> choices;  ///< e.g. form: radial
};

/// Makes a task of parameters that its TaskInfo has, and that are legal.
using TaskFactory = std::function<std::unique_ptr<Task>(const TaskParameters&)>;

/// A task that stacks can name. `TaskEntry` writes it.
struct TaskDefinition {
  TaskInfo info;
  TaskFactory make;
};

/// The user's own tasks, which stacks can name besides the library's.
class OwnTasks {
 public:
  /// Throws Error for a task without name or factory, and for a name that is taken.
  void add(TaskDefinition task);

  [[nodiscard]] std::span<const TaskDefinition> all() const { return all_; }
  /// Null if there is none of this name.
  [[nodiscard]] const TaskDefinition* find(std::string_view name) const;

 private:
  std::vector<TaskDefinition> all_;
};

}  // namespace surefoot::tasks
