#include "surefoot/control/stack_options.hpp"

#include "surefoot/base/error.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace surefoot::control {
namespace {

constexpr std::array<std::string_view, 4> kPhysics{"equations_of_motion", "no_contact_motion",
                                                   "torque_limits", "friction_cone"};

constexpr std::array<std::string_view, 2> kEfforts{"contact_force_minimisation",
                                                   "torque_minimisation"};

}  // namespace

bool keeps_physics(const LevelSpec& level) {
  return std::ranges::any_of(level.tasks, [](const TaskSpec& task) {
    return std::ranges::find(kPhysics, task.task) != kPhysics.end();
  });
}

StackOptions with_arms(StackOptions stack) {
  const auto moves_arms = [](const TaskSpec& task) {
    const auto joints = task.choices.find("joints");
    const bool is_of_legs = joints != task.choices.end() && joints->second == "legs";
    return task.task == "frame_position" || task.task == "frame_orientation" ||
           (task.task == "posture" && !is_of_legs);
  };
  const bool is_told = std::ranges::any_of(stack.levels, [&](const LevelSpec& level) {
    return std::ranges::any_of(level.tasks, moves_arms);
  });
  if (is_told) return stack;
  const auto level = [](const char* name, std::initializer_list<const char*> tasks) {
    LevelSpec made{.name = name, .tasks = {}};
    for (const char* task : tasks) made.tasks.emplace_back().task = task;
    return made;
  };
  const auto saves = [](const TaskSpec& task) {
    return std::ranges::find(kEfforts, task.task) != kEfforts.end();
  };
  const auto effort = std::ranges::find_if(
      stack.levels, [&](const LevelSpec& one) { return std::ranges::all_of(one.tasks, saves); });
  LevelSpec rest = level("arm_rest", {"posture"}), idle = level("arm_posture", {"posture"});
  rest.tasks.front().choices["joints"] = "reaching_arm";
  idle.tasks.front().choices["joints"] = "idle_arms";
  stack.levels.insert(effort, {level("arm_tip", {"frame_position", "frame_orientation"}), rest});
  const auto last = std::find_if(stack.levels.rbegin(), stack.levels.rend(), keeps_physics);
  stack.levels.insert(last.base(), idle);
  return stack;
}

StackOptions weighted_from(StackOptions stack, std::size_t first) {
  if (first >= stack.levels.size()) return stack;
  const auto physics = std::find_if(stack.levels.rbegin(), stack.levels.rend(), keeps_physics);
  if (stack.levels.rend() - physics > static_cast<std::ptrdiff_t>(first)) {
    throw Error("the level \"" + physics->name +
                "\" keeps the physics and can't be weighted; valid is a level after it");
  }
  LevelSpec weighted{.name = "weighted", .tasks = {}};
  for (std::size_t k = first; k < stack.levels.size(); ++k) {
    for (TaskSpec& task : stack.levels[k].tasks) weighted.tasks.push_back(std::move(task));
  }
  stack.levels.resize(first);
  stack.levels.push_back(std::move(weighted));
  return stack;
}

}  // namespace surefoot::control
