#include "surefoot/config/stack_text.hpp"

#include "surefoot/logging/json_text.hpp"
#include "surefoot/tasks/catalog.hpp"

#include <cmath>

namespace surefoot::config {
namespace {

/// JSON's numbers and strings are valid YAML, and its numbers read back to the same double.
template <typename Value>
std::string yaml_quoted(const Value& value) {
  std::string text;
  logging::JsonText(text).value(value);
  return text;
}

std::string task_yaml(const control::TaskSpec& task) {
  std::string text = "{task: " + task.task;
  for (const auto& [name, value] : task.numbers) text += ", " + name + ": " + yaml_quoted(value);
  for (const auto& [name, value] : task.choices) {
    text += ", " + name + ": " + yaml_quoted(std::string_view(value));
  }
  if (task.weight != 1.0) text += ", weight: " + yaml_quoted(task.weight);
  return text + "}";
}

}  // namespace

std::vector<std::string> level_names(const control::StackOptions& stack) {
  std::vector<std::string> names;
  for (const control::LevelSpec& level : stack.levels) names.push_back(level.name);
  return names;
}

control::StackOptions with_defaults(control::StackOptions stack) {
  for (control::LevelSpec& level : stack.levels) {
    for (control::TaskSpec& task : level.tasks) {
      const tasks::TaskInfo& info = tasks::task_info(task.task, stack.own_tasks);
      for (const tasks::TaskParameter& parameter : info.parameters) {
        task.numbers.try_emplace(std::string(parameter.name), parameter.default_value);
      }
      for (const tasks::TaskChoice& choice : info.choices) {
        task.choices.try_emplace(std::string(choice.name), choice.default_value);
      }
    }
  }
  return stack;
}

std::string stack_yaml(const control::StackOptions& stack) {
  std::string text = "name: " + yaml_quoted(std::string_view(stack.name)) + "\nlevels:\n";
  for (const control::LevelSpec& level : stack.levels) {
    text += "  - name: " + yaml_quoted(std::string_view(level.name)) + "\n";
    if (level.damping != 0.0) text += "    damping: " + yaml_quoted(level.damping) + "\n";
    text += "    tasks:\n";
    for (const control::TaskSpec& task : level.tasks) text += "      - " + task_yaml(task) + "\n";
  }
  return text;
}

}  // namespace surefoot::config
