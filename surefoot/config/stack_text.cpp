#include "surefoot/config/stack_text.hpp"

#include "surefoot/logging/json_text.hpp"
#include "surefoot/tasks/catalog.hpp"

#include <cmath>

namespace surefoot {
namespace {

/// JSON's numbers and quoted texts are YAML's too, and its numbers read back to the same double.
template <typename Value>
std::string yaml_quoted(const Value& value) {
  std::string text;
  JsonText(text).value(value);
  return text;
}

std::string task_yaml(const TaskSpec& task) {
  std::string text = "{task: " + task.task;
  for (const auto& [name, value] : task.numbers) text += ", " + name + ": " + yaml_quoted(value);
  for (const auto& [name, value] : task.choices) {
    text += ", " + name + ": " + yaml_quoted(std::string_view(value));
  }
  if (task.weight != 1.0) text += ", weight: " + yaml_quoted(task.weight);
  return text + "}";
}

}  // namespace

std::vector<std::string> level_names(const StackOptions& stack) {
  std::vector<std::string> names;
  for (const LevelSpec& level : stack.levels) names.push_back(level.name);
  return names;
}

StackOptions with_defaults(StackOptions stack) {
  for (LevelSpec& level : stack.levels) {
    for (TaskSpec& task : level.tasks) {
      const TaskInfo& info = task_info(task.task);
      for (const TaskParameter& parameter : info.parameters) {
        task.numbers.try_emplace(std::string(parameter.name), parameter.default_value);
      }
      for (const TaskChoice& choice : info.choices) {
        task.choices.try_emplace(std::string(choice.name), choice.default_value);
      }
    }
  }
  return stack;
}

std::string stack_yaml(const StackOptions& stack) {
  std::string text = "name: " + yaml_quoted(std::string_view(stack.name)) + "\nlevels:\n";
  for (const LevelSpec& level : stack.levels) {
    text += "  - name: " + yaml_quoted(std::string_view(level.name)) + "\n";
    if (level.damping != 0.0) text += "    damping: " + yaml_quoted(level.damping) + "\n";
    text += "    tasks:\n";
    for (const TaskSpec& task : level.tasks) text += "      - " + task_yaml(task) + "\n";
  }
  return text;
}

}  // namespace surefoot
