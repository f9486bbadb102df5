#include "surefoot/control/task_stack.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/signals/hierarchy_report.hpp"
#include "surefoot/tasks/catalog.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace surefoot {
namespace {

/// Without these the torques mean nothing.
constexpr std::array<std::string_view, 4> kPhysics{"equations_of_motion", "no_contact_motion",
                                                   "torque_limits", "friction_cone"};

bool is_physics(const Task& task) {
  return std::ranges::find(kPhysics, task.name()) != kPhysics.end();
}

}  // namespace

TaskStack::TaskStack(const StackOptions& options, const RobotDescription& robot)
    : robot_(robot), hierarchy_(kNumUnknowns) {
  if (options.levels.empty() || options.levels.size() > kMaxLevels) {
    throw Error("stack \"" + options.name + "\" has " + std::to_string(options.levels.size()) +
                " levels; valid are 1 to " + std::to_string(kMaxLevels));
  }
  for (const LevelSpec& spec : options.levels) {
    LevelTasks level;
    int rows = 0, ids = 0;
    for (const TaskSpec& task_spec : spec.tasks) {
      level.tasks.push_back(make_task(task_spec.task, {task_spec.numbers, task_spec.choices}));
      Task& task = *level.tasks.back();
      task.set_first_id(ids);
      ids += task.num_ids();
      rows += task.max_rows();
      if (is_physics(task)) first_free_level_ = static_cast<int>(levels_.size()) + 1;
    }
    hierarchy_.add_level(spec.name, rows);
    levels_.push_back(std::move(level));
  }
}

const Hierarchy& TaskStack::update(const Dynamics& dynamics, const MotionPlan& plan) noexcept {
  support_.update(dynamics, plan);
  const TaskInput input{dynamics, plan, support_, robot_};
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    Level& level = hierarchy_.level(i);
    level.clear();
    for (const auto& task : levels_[i].tasks) task->write(input, level);
  }
  return hierarchy_;
}

const Substitution* TaskStack::substitution(const Dynamics& dynamics) noexcept {
  if (!is_only(0, "equations_of_motion") || !is_only(1, "no_contact_motion")) return nullptr;
  return physics_.update(dynamics, support_, hierarchy_.level(1).lower());
}

bool TaskStack::is_only(std::size_t level, std::string_view task) const {
  if (level >= levels_.size()) return false;
  const auto& tasks = levels_[level].tasks;
  return tasks.size() == 1 && tasks.front()->name() == task;
}

std::string TaskStack::row_name(int level, int id) const {
  if (level < 0 || level >= static_cast<int>(levels_.size())) return "?";
  for (const auto& task : levels_[static_cast<std::size_t>(level)].tasks) {
    if (id >= task->first_id() && id < task->first_id() + task->num_ids()) {
      return task->row_name(id - task->first_id());
    }
  }
  return "?";
}

}  // namespace surefoot
