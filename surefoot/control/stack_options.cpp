#include "surefoot/control/stack_options.hpp"

#include "surefoot/base/error.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace surefoot::control {
namespace {

constexpr std::array<std::string_view, 4> kPhysics{"equations_of_motion", "no_contact_motion",
                                                   "torque_limits", "friction_cone"};

constexpr std::array<std::string_view, 3> kOfArms{"frame_position", "frame_orientation", "posture"};
constexpr std::array<std::string_view, 2> kEfforts{"contact_force_minimisation",
                                                   "torque_minimisation"};

}  // namespace

bool keeps_physics(const LevelSpec& level) {
  return std::ranges::any_of(level.tasks, [](const TaskSpec& task) {
    return std::ranges::find(kPhysics, task.task) != kPhysics.end();
  });
}

StackOptions with_arms(StackOptions stack) {
  const auto has = [](const LevelSpec& level, const auto& names) {
    return std::ranges::any_of(level.tasks, [&](const TaskSpec& task) {
      return std::ranges::find(names, task.task) != names.end();
    });
  };
  const auto moves_arms = [&](const LevelSpec& level) { return has(level, kOfArms); };
  if (std::ranges::any_of(stack.levels, moves_arms)) return stack;
  const auto saves = [&](const LevelSpec& level) { return has(level, kEfforts); };
  const auto place = std::ranges::find_if(stack.levels, saves);
  LevelSpec tip{.name = "arm_tip", .tasks = {}}, posture{.name = "arm_posture", .tasks = {}};
  tip.tasks.resize(2);
  tip.tasks[0].task = "frame_position";
  tip.tasks[1].task = "frame_orientation";
  posture.tasks.resize(1);
  posture.tasks[0].task = "posture";
  stack.levels.insert(place, {tip, posture});
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
