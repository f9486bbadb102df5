#include "surefoot/control/task_stack.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/signals/hierarchy_report.hpp"
#include "surefoot/signals/sensor_reading.hpp"
#include "surefoot/solver/extra_rows.hpp"
#include "surefoot/tasks/catalog.hpp"
#include "surefoot/tasks/task_rows.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace surefoot::control {

TaskStack::TaskStack(const StackOptions& options, const model::RobotDescription& robot)
    : robot_(robot),
      own_tasks_(options.own_tasks),
      hierarchy_(6 + 2 * robot.num_joints()),
      physics_(robot.num_joints()),
      no_motion_(Eigen::VectorXd::Zero(hierarchy_.unknowns())) {
  if (options.levels.empty() || options.levels.size() > kMaxLevels) {
    throw Error("stack \"" + options.name + "\" has " + std::to_string(options.levels.size()) +
                " levels; valid are 1 to " + std::to_string(kMaxLevels));
  }
  for (const LevelSpec& spec : options.levels) {
    levels_.push_back(make_level(spec));
    if (keeps_physics(spec)) first_free_level_ = static_cast<int>(levels_.size());
  }
  torso_tilt_ = level_of("torso_roll_pitch");
}

TaskStack::LevelTasks TaskStack::make_level(const LevelSpec& spec) {
  LevelTasks level;
  int rows = 0;
  level.damping = spec.damping;
  if (spec.damping != 0.0)
    solver::check_weight(spec.damping, "damping of level \"" + spec.name + "\"");
  for (const TaskSpec& task_spec : spec.tasks) {
    solver::check_weight(task_spec.weight, "weight of task \"" + task_spec.task + "\"");
    std::unique_ptr<tasks::Task> task = make_task(task_spec, level);
    task->set_first_id(level.num_ids);
    level.num_ids += task->num_ids();
    rows += task->max_rows();
    level.weights.push_back(task_spec.weight);
    level.tasks.push_back(std::move(task));
  }
  hierarchy_.add_level(spec.name, spec.damping > 0.0 ? 2 * rows : rows);
  return level;
}

std::unique_ptr<tasks::Task> TaskStack::make_task(const TaskSpec& spec, LevelTasks& level) {
  std::unique_ptr<tasks::Task> task =
      tasks::make_task(spec.task, {spec.numbers, spec.choices}, own_tasks_);
  if (const auto* cone = dynamic_cast<const tasks::FrictionCone*>(task.get()))
    friction_cone_ = cone;
  task->prepare(robot_);
  note_followed(*task);
  if (own_tasks_.find(spec.task) != nullptr) {
    tasks::check_sizes(*task, spec.task);
    level.has_own = true;
  }
  return task;
}

void TaskStack::note_followed(const tasks::Task& task) {
  follows_joints_ = follows_joints_ || task.follows_joints();
  const model::FollowedFrame frame = task.follows();
  if (frame.number < 0) return;
  const auto same =
      std::ranges::find(followed_frames_, frame.number, &model::FollowedFrame::number);
  if (same == followed_frames_.end()) {
    followed_frames_.push_back(frame);
  } else if (same->in_world != frame.in_world) {
    throw Error("one task holds the frame \"" +
                model::Frames(robot_).names()[static_cast<std::size_t>(frame.number)] +
                "\" in the base, another in the world; give all its tasks the same held_in");
  }
  if (followed_frames_.size() > FrameList::kMost)
    throw Error("tasks follow more than " + std::to_string(FrameList::kMost) +
                " frames; valid are as many at most");
}

const solver::Hierarchy& TaskStack::update(const model::Dynamics& dynamics,
                                           const MotionPlan& plan) noexcept {
  fault_.clear();
  support_.update(dynamics, plan);
  const tasks::TaskInput input{dynamics, plan, support_, robot_};
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    solver::Level& level = hierarchy_.level(i);
    level.clear();
    if (levels_[i].is_present) write(levels_[i], input, level);
  }
  return hierarchy_;
}

void TaskStack::set_present(const solver::LevelSet& present) noexcept {
  for (std::size_t i = 0; i < levels_.size(); ++i) levels_[i].is_present = present[i];
}

const solver::Substitution* TaskStack::substitution(const model::Dynamics& dynamics) noexcept {
  if (!is_only(0, "equations_of_motion") || !is_only(1, "no_contact_motion")) return nullptr;
  return physics_.update(dynamics, support_, hierarchy_.level(1).lower());
}

bool TaskStack::is_only(std::size_t level, std::string_view task) const {
  if (level >= levels_.size()) return false;
  const LevelTasks& only = levels_[level];
  return only.tasks.size() == 1 && only.tasks.front()->name() == task &&
         only.weights.front() == 1.0 && only.damping == 0.0;
}

std::size_t TaskStack::level_of(std::string_view task) const {
  std::size_t level = 0;
  while (level < levels_.size() && !is_only(level, task)) ++level;
  return level;
}

double TaskStack::tilt_shortfall(const solver::Solution& solution) const noexcept {
  if (torso_tilt_ >= levels_.size()) return 0.0;
  const bool is_cut_off = solution.status != solver::SolveStatus::optimal &&
                          solution.failed_level >= 0 &&
                          static_cast<std::size_t>(solution.failed_level) <= torso_tilt_;
  const bool is_solved = solution.status != solver::SolveStatus::invalid_input && !is_cut_off &&
                         torso_tilt_ < solution.levels.size();
  return is_solved ? solution.levels[torso_tilt_].residual : kNaN;
}

PerLeg<Vec3> TaskStack::pyramid_normals(const MotionPlan& plan) const noexcept {
  PerLeg<Vec3> normals(robot_.num_legs(), Vec3::Constant(kNaN));
  if (friction_cone_ == nullptr) return normals;
  for (const Leg leg : normals.legs())
    normals[index(leg)] = friction_cone_->pyramid(plan, leg).normal();
  return normals;
}

void TaskStack::write(const LevelTasks& tasks, const tasks::TaskInput& input,
                      solver::Level& level) noexcept {
  if (tasks.has_own) return write_own(tasks, input, level);
  for (std::size_t i = 0; i < tasks.tasks.size(); ++i) {
    const Eigen::Index first = level.num_rows();
    tasks.tasks[i]->write(input, level);
    if (tasks.weights[i] != 1.0) level.rows(first).weigh(tasks.weights[i]);
  }
  if (tasks.damping > 0.0) solver::add_damping(level, tasks.damping, no_motion_, tasks.num_ids);
}

// After a fault the level has a row that can't be solved: no solution without the task is used.
void TaskStack::write_own(const LevelTasks& tasks, const tasks::TaskInput& input,
                          solver::Level& level) noexcept {
  for (std::size_t i = 0; i < tasks.tasks.size() && !fault_.is_set(); ++i) {
    const tasks::Task& task = *tasks.tasks[i];
    const Eigen::Index first = level.num_rows();
    if (!runs([&] { task.write(input, level); }, fault_, "task \"", task.name(), "\"")) continue;
    const std::string wrong = tasks::what_is_wrong(task, level, first);
    if (!wrong.empty()) {
      fault_.set("task \"", task.name(), "\" ", wrong);
    } else if (tasks.weights[i] != 1.0) {
      level.rows(first).weigh(tasks.weights[i]);
    }
  }
  if (fault_.is_set()) {
    level.clear();
    level.add(1, 0).set_equal(0, kNaN);
  } else if (tasks.damping > 0.0) {
    solver::add_damping(level, tasks.damping, no_motion_, tasks.num_ids);
  }
}

std::vector<std::string> TaskStack::units() const {
  std::vector<std::string> units;
  for (const LevelTasks& level : levels_) {
    std::vector<std::string_view> of_tasks;
    for (const auto& task : level.tasks) {
      const std::string_view unit = tasks::task_info(task->name(), own_tasks_).unit;
      if (std::ranges::find(of_tasks, unit) == of_tasks.end()) of_tasks.push_back(unit);
    }
    std::string& text = units.emplace_back();
    if (level.damping > 0.0 ||
        std::ranges::any_of(level.weights, [](double w) { return w != 1.0; }))
      continue;
    for (const std::string_view unit : of_tasks)
      text += (text.empty() ? "" : " and ") + std::string(unit);
  }
  return units;
}

std::string TaskStack::row_name(int level, int id) const {
  if (level < 0 || level >= static_cast<int>(levels_.size())) return "?";
  const LevelTasks& tasks = levels_[static_cast<std::size_t>(level)];
  if (tasks.damping > 0.0 && id >= tasks.num_ids) return "damping";
  for (const auto& task : tasks.tasks) {
    if (id >= task->first_id() && id < task->first_id() + task->num_ids()) {
      return task->row_name(id - task->first_id());
    }
  }
  return "?";
}

std::vector<std::vector<std::string>> TaskStack::row_names() const {
  std::vector<std::vector<std::string>> names(levels_.size());
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    const LevelTasks& tasks = levels_[level];
    const int count =
        tasks.num_ids + (tasks.damping > 0.0 ? static_cast<int>(no_motion_.size()) : 0);
    for (int id = 0; id < count; ++id)
      names[level].push_back(row_name(static_cast<int>(level), id));
  }
  return names;
}

}  // namespace surefoot::control
