#include "surefoot/control/stack_reach.hpp"

#include "surefoot/model/proportions.hpp"
#include "surefoot/tasks/catalog.hpp"

#include <algorithm>
#include <sstream>
#include <string>

namespace surefoot::control {
namespace {

/// Largest distance from hip to foot, over all knee angles regardless of their limits.
double leg_length(const model::RobotModel& model, Leg leg) {
  return model::longest(-kPi, kPi, [&](double q_knee) {
    const Vec3 q(0.0, 0.0, q_knee);
    return (model.foot_in_base(leg, q) - model.hip_in_base(leg, q)).norm();
  });
}

void check(const LevelSpec& level, const TaskSpec& task, const tasks::TaskInfo& info,
           const StackReach& reach) {
  for (const tasks::TaskParameter& parameter : info.parameters) {
    const std::string name(parameter.name);
    const auto given = task.numbers.find(name);
    const double value = given == task.numbers.end() ? parameter.default_value : given->second;
    const double greatest = reach.greatest(task.task, name);
    if (value <= greatest) continue;
    std::ostringstream message;
    message.precision(4);
    message << (level.name == task.task ? "" : level.name + ", ") << task.task << ": " << name
            << " is " << value << ", but this robot reaches only " << greatest
            << " m; valid is a number up to that";
    throw BeyondReachError(message.str(), task.task, name);
  }
}

}  // namespace

double StackReach::greatest(std::string_view task, std::string_view number) const {
  const bool is_bound = number == "min" || number == "max";
  if (is_bound && task == "limb_extension_limits") return leg;
  if (is_bound && task == "body_height_limits") return base;
  return std::numeric_limits<double>::infinity();
}

StackReach reach_of(const model::RobotModel& model) {
  if (!model.description().can_walk()) return {};
  StackReach reach{.leg = 0.0, .base = 0.0};
  for (const Leg leg : model.description().legs.legs()) {
    const double length = leg_length(model, leg);
    reach.leg = std::max(reach.leg, length);
    reach.base = std::max(reach.base, length + model.hip_in_base(leg, Vec3::Zero()).norm());
  }
  return reach;
}

void check_reach(const StackOptions& stack, const StackReach& reach) {
  for (const LevelSpec& level : stack.levels) {
    for (const TaskSpec& task : level.tasks)
      check(level, task, tasks::task_info(task.task, stack.own_tasks), reach);
  }
}

}  // namespace surefoot::control
