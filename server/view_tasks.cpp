#include "server/view_tasks.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/stack_text.hpp"
#include "surefoot/tasks/catalog.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

namespace surefoot::server {
namespace {

constexpr std::array<double, 5> kRanges{10.0, 5.0, 2.0, 1.5, 1.0};  // of the default

bool is_legal(const std::string& task, const std::string& name, double value) {
  try {
    (void)tasks::make_task(task, {{{name, value}}, {}});
    return true;
  } catch (const Error&) {
    return false;
  }
}

double largest(const std::string& task, const tasks::TaskParameter& parameter) {
  const double usual = parameter.default_value > 0.0 ? parameter.default_value : 1.0;
  for (const double factor : kRanges) {
    if (is_legal(task, std::string(parameter.name), factor * usual)) return factor * usual;
  }
  return parameter.default_value;
}

/// Limits a value to the robot's reach, in whole millimetres.
double within(const control::StackReach& reach, const std::string& task, const std::string& name,
              double value) {
  const double greatest = reach.greatest(task, name);
  return value <= greatest ? value : std::floor(1e3 * greatest) / 1e3;
}

using Names = std::vector<std::string>;

/// "order: torso_yaw from 8 to 5" if one level was moved; otherwise the new order between the first
/// and the last moved level.
std::string order_text(const Names& before, const Names& after) {
  std::size_t begin = 0, end = after.size();
  while (begin < end && before[begin] == after[begin]) ++begin;
  while (begin < end && before[end - 1] == after[end - 1]) --end;
  if (begin == end) return "";
  for (const auto& [from, to] : {std::pair(end - 1, begin), std::pair(begin, end - 1)}) {
    Names moved = before;
    moved.erase(moved.begin() + static_cast<std::ptrdiff_t>(from));
    moved.insert(moved.begin() + static_cast<std::ptrdiff_t>(to), before[from]);
    if (moved == after) {
      return "order: " + before[from] + " from " + std::to_string(from + 1) + " to " +
             std::to_string(to + 1);
    }
  }
  std::string text = "order from " + std::to_string(begin + 1) + ":";
  for (std::size_t i = begin; i < end; ++i) text += (i == begin ? " " : ", ") + after[i];
  return text;
}

}  // namespace

std::string task_title(const control::LevelSpec& level, const control::TaskSpec& task) {
  return level.name == task.task ? level.name : level.name + ", " + task.task;
}

ViewNumber view_number(const std::string& task, const std::string& name, double value,
                       const control::StackReach& reach) {
  const auto& parameters = tasks::task_info(task).parameters;
  const auto parameter = std::ranges::find(parameters, name, &tasks::TaskParameter::name);
  if (parameter == parameters.end()) {
    throw UnknownNameError("the task " + task + " has no number \"" + name + "\"");
  }
  return {.name = name,
          .unit = std::string(parameter->unit),
          .about = std::string(parameter->help),
          .value = value,
          .min = parameter->minimum,
          .max = std::max(within(reach, task, name, largest(task, *parameter)), value)};
}

std::vector<ViewTask> view_tasks(const control::StackOptions& stack,
                                 const std::vector<std::string>& level_names,
                                 const control::StackReach& reach) {
  std::vector<ViewTask> tasks;
  for (const control::LevelSpec& level : stack.levels) {
    const auto number = std::ranges::find(level_names, level.name) - level_names.begin();
    for (const control::TaskSpec& task : level.tasks) {
      ViewTask& view = tasks.emplace_back();
      view.level = static_cast<std::size_t>(number);
      view.level_name = level.name;
      view.task = task.task;
      for (const tasks::TaskParameter& parameter : tasks::task_info(task.task).parameters) {
        const std::string name(parameter.name);
        view.numbers.push_back(view_number(task.task, name, task.numbers.at(name), reach));
      }
    }
  }
  std::ranges::stable_sort(tasks, {}, &ViewTask::level);
  return tasks;
}

std::string change_text(double before, double after) {
  std::ostringstream text;
  text.precision(4);
  text << before << " → " << after;
  return text.str();
}

std::string change_text(const control::StackOptions& before, const control::StackOptions& after) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  for (const control::LevelSpec& level : after.levels) {
    const auto old = std::ranges::find(before.levels, level.name, &control::LevelSpec::name);
    if (old == before.levels.end()) continue;
    for (std::size_t i = 0; i < std::min(level.tasks.size(), old->tasks.size()); ++i) {
      for (const auto& [name, value] : level.tasks[i].numbers) {
        const auto was = old->tasks[i].numbers.find(name);
        if (was == old->tasks[i].numbers.end() || was->second == value) continue;
        add(task_title(level, level.tasks[i]) + " " + name + " " + change_text(was->second, value));
      }
    }
  }
  const std::string order = order_text(config::level_names(before), config::level_names(after));
  if (!order.empty()) add(order);
  return text;
}

}  // namespace surefoot::server
