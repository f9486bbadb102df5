#include "app/view_tasks.hpp"

#include "app/stack_text.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/tasks/catalog.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ranges>
#include <sstream>
#include <utility>

namespace surefoot {
namespace {

constexpr std::array<double, 5> kRanges{10.0, 5.0, 2.0, 1.5, 1.0};  // of the default

bool is_legal(const std::string& task, const std::string& name, double value) {
  try {
    (void)make_task(task, {{{name, value}}, {}});
    return true;
  } catch (const Error&) {
    return false;
  }
}

double largest(const std::string& task, const TaskParameter& parameter) {
  const double usual = parameter.default_value > 0.0 ? parameter.default_value : 1.0;
  for (const double factor : kRanges) {
    if (is_legal(task, std::string(parameter.name), factor * usual)) return factor * usual;
  }
  return parameter.default_value;
}

/// Within the robot's reach, in whole millimetres.
double within(const StackReach& reach, const std::string& task, const std::string& name,
              double value) {
  const double greatest = reach.greatest(task, name);
  return value <= greatest ? value : std::floor(1e3 * greatest) / 1e3;
}

using Names = std::vector<std::string>;

std::size_t place(const Names& names, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()) + 1;
}

/// Names of an order, and how well they are told as those that did not move.
struct Part {
  Names names;
  std::uint64_t weight = 0;
};

/// More names weigh more, whichever; of as many those that were not moved, or long ago.
std::uint64_t weight(const std::string& name, const Names& moved) {
  static_assert(kMaxLevels < 32);
  const std::size_t k = place(moved, name);
  return (std::uint64_t{1} << 32) - (k > moved.size() || k > 31 ? 0 : std::uint64_t{1} << (31 - k));
}

/// The longest part of an order that stands as it did before; of several that without the levels
/// that were `moved`, the latest first; then the one that lets others rise.
Names stayed(const Names& order, const Names& before, const Names& moved) {
  std::vector<Part> parts;  // the best that ends with each name
  for (const std::string& name : order) {
    Part best;
    for (const Part& part : parts) {
      const bool goes_on = place(before, part.names.back()) < place(before, name);
      if (goes_on && part.weight >= best.weight) best = part;
    }
    best.names.push_back(name);
    best.weight += weight(name, moved);
    parts.push_back(std::move(best));
  }
  return std::ranges::max_element(parts | std::views::reverse, {}, &Part::weight)->names;
}

std::string order_text(const StackOptions& before, const StackOptions& after, const Names& moved) {
  const Names was = level_names(before), is = level_names(after);
  std::string text;
  for (const std::string& name : moved_levels(before, after, moved)) {
    text += (text.empty() ? "" : ", ") + name + " from " + std::to_string(place(was, name)) +
            " to " + std::to_string(place(is, name));
  }
  return "order: " + text;
}

bool has_same_order(const StackOptions& a, const StackOptions& b) {
  return std::ranges::equal(a.levels, b.levels, {}, &LevelSpec::name, &LevelSpec::name);
}

}  // namespace

std::string task_title(const LevelSpec& level, const TaskSpec& task) {
  return level.name == task.task ? level.name : level.name + ", " + task.task;
}

ViewNumber view_number(const std::string& task, const std::string& name, double value,
                       const StackReach& reach) {
  const auto& parameters = task_info(task).parameters;
  const auto parameter = std::ranges::find(parameters, name, &TaskParameter::name);
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

std::vector<ViewTask> view_tasks(const StackOptions& stack,
                                 const std::vector<std::string>& level_names,
                                 const StackReach& reach) {
  std::vector<ViewTask> tasks;
  for (const LevelSpec& level : stack.levels) {
    const auto number = std::ranges::find(level_names, level.name) - level_names.begin();
    for (const TaskSpec& task : level.tasks) {
      ViewTask& view = tasks.emplace_back();
      view.level = static_cast<std::size_t>(number);
      view.level_name = level.name;
      view.task = task.task;
      view.keeps_physics = keeps_physics(level);
      view.choices = task.choices;
      for (const TaskParameter& parameter : task_info(task.task).parameters) {
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

std::vector<std::string> moved_levels(const StackOptions& before, const StackOptions& after,
                                      const std::vector<std::string>& moved) {
  Names names = level_names(after);
  const Names rest = stayed(names, level_names(before), moved);
  std::erase_if(names, [&](const auto& name) { return place(rest, name) <= rest.size(); });
  return names;
}

std::string change_text(const StackOptions& before, const StackOptions& after,
                        const std::vector<std::string>& moved) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  for (const LevelSpec& level : after.levels) {
    const auto old = std::ranges::find(before.levels, level.name, &LevelSpec::name);
    if (old == before.levels.end()) continue;
    for (std::size_t i = 0; i < std::min(level.tasks.size(), old->tasks.size()); ++i) {
      for (const auto& [name, value] : level.tasks[i].numbers) {
        const auto was = old->tasks[i].numbers.find(name);
        if (was == old->tasks[i].numbers.end() || was->second == value) continue;
        add(task_title(level, level.tasks[i]) + " " + name + " " + change_text(was->second, value));
      }
    }
  }
  if (!has_same_order(before, after)) add(order_text(before, after, moved));
  return text;
}

}  // namespace surefoot
