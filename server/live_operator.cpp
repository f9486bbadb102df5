#include "server/live_operator.hpp"

#include "server/view_tasks.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/config/loaded_gaits.hpp"
#include "surefoot/config/stack_text.hpp"
#include "surefoot/tasks/catalog.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace surefoot::server {
namespace {

using Type = ViewCommandType;

template <typename... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream stream;
  (stream << ... << parts);
  return stream.str();
}

void check(const char* what, double value, double min, double max, const char* unit) {
  if (value >= min && value <= max) return;
  const std::string in = *unit == '\0' ? "" : " " + std::string(unit);
  throw Error(text(what, " is ", value, in, "; valid is ", min, " to ", max, in));
}

control::LevelSpec& find_level(control::StackOptions& stack, const std::string& name) {
  const auto found = std::ranges::find(stack.levels, name, &control::LevelSpec::name);
  if (found != stack.levels.end()) return *found;
  throw Error("unknown level \"" + name + "\"; " + valid_names(name, config::level_names(stack)));
}

control::TaskSpec& find_task(control::LevelSpec& level, const std::string& name) {
  const auto found = std::ranges::find(level.tasks, name, &control::TaskSpec::task);
  if (found != level.tasks.end()) return *found;
  std::vector<std::string> names;
  for (const control::TaskSpec& task : level.tasks) names.push_back(task.task);
  throw Error("the level \"" + level.name + "\" has no task \"" + name + "\"; " +
              valid_names(name, names));
}

/// Levels that keep the physics stay above all others; otherwise torques would mean nothing.
void check_order(const control::StackOptions& stack) {
  bool free = false;
  for (const control::LevelSpec& level : stack.levels) {
    if (free && control::keeps_physics(level)) {
      throw Error(
          "the level \"" + level.name +
          "\" keeps the physics; valid is an order in which it stands above all levels that "
          "don't");
    }
    free = free || !control::keeps_physics(level);
  }
}

/// Rounds up to milliseconds, except for the rounding error of a double.
double whole_milliseconds(double seconds) { return std::ceil(1e3 * seconds - 1e-9) / 1e3; }

}  // namespace

LiveOperator::LiveOperator(const config::Scenario& scenario, ViewLimits limits)
    : scenario_control_{config::with_defaults(scenario.controller.stack),
                        scenario.controller.planner.force.friction},
      limits_(limits),
      reach_(control::reach_of(model::RobotModel(scenario.robot))),
      first_gait_(scenario.controller.first_gait) {
  wishes_.control = scenario_control_;
  gaits_ = config::gait_names(scenario.controller.gaits);
}

std::string LiveOperator::gait_name(int gait) const {
  if (gait == UserCommand::kOwnGait) gait = first_gait_;
  if (gait == UserCommand::kAutoGait) return config::kAutoGait;
  return gait < 0 ? "" : gaits_[static_cast<std::size_t>(gait)];
}

int LiveOperator::gait(const std::string& name) const {
  if (name.empty()) return wishes_.walk ? wishes_.walk->gait : UserCommand::kOwnGait;
  return config::gait_place(name, gaits_);
}

std::string LiveOperator::command(const ViewCommand& command) {
  const std::lock_guard lock(mutex_);
  const bool always = command.type == Type::reset || command.type == Type::speed ||
                      command.type == Type::pause || command.type == Type::resume;
  if (!ended_.empty() && !always) {
    return "the run has ended (" + ended_ + "); reset begins it again";
  }
  try {
    switch (command.type) {
      case Type::pause:
        wishes_.paused = wishes_.halt = true;
        wishes_.steps = 0;
        break;
      case Type::resume:
        wishes_.paused = false;
        break;
      case Type::step:
        wishes_.paused = true;
        step(command.ticks);
        break;
      case Type::speed:
        check("speed", command.factor, limits_.slowest, limits_.fastest, "times real time");
        wishes_.speed = command.factor;
        break;
      case Type::reset:
        wishes_.reset = true;
        break;
      case Type::push:
        push(command);
        break;
      case Type::walk:
        walk(command);
        break;
      case Type::gain:
        gain(command);
        break;
      case Type::order:
        order(command);
        break;
      case Type::friction:
        friction(command);
        break;
    }
  } catch (const Error& error) {
    return error.what();
  }
  changes_.fetch_add(1, std::memory_order_release);
  return "";
}

void LiveOperator::step(int ticks) {
  if (ticks > kMostStepsWaiting - wishes_.steps) {
    throw Error(text(ticks, " ticks more; valid is up to ", kMostStepsWaiting, " that wait"));
  }
  wishes_.steps += ticks;
}

std::optional<UserCommand> LiveOperator::walk_wanted() {
  const std::lock_guard lock(mutex_);
  return wishes_.walk;
}

void LiveOperator::check_body(const std::string& body) const {
  if (std::ranges::find(bodies_, body) != bodies_.end()) return;
  throw Error("there is no body \"" + body + "\" to push; " + valid_names(body, bodies_));
}

void LiveOperator::push(const ViewCommand& command) {
  check_body(command.body);
  check("duration", command.duration, 0.001, limits_.push_duration, "s");
  const double size = command.impulse.norm();
  if (!(size > 0.0 && size <= limits_.push_impulse)) {
    throw Error(text("the impulse's size is ", size, " N·s; valid is more than 0, up to ",
                     limits_.push_impulse, " N·s"));
  }
  const Vec3 force = command.impulse / command.duration;
  if (force.norm() > limits_.push_force * (1.0 + 1e-9)) {
    throw Error(text("an impulse of ", size, " N·s in ", command.duration, " s is a force of ",
                     force.norm(), " N; valid is up to ", limits_.push_force,
                     " N, so a duration of at least ",
                     whole_milliseconds(size / limits_.push_force), " s"));
  }
  wishes_.pushes.push_back(
      {.body = command.body, .time = 0.0, .duration = command.duration, .force = force});
}

void LiveOperator::walk(const ViewCommand& command) {
  if (command.by_scenario) {
    wishes_.walk.reset();
    return;
  }
  const double v = limits_.walk_velocity;
  check("velocity forward", command.velocity.x(), -v, v, "m/s");
  check("velocity sideways", command.velocity.y(), -v, v, "m/s");
  check("yaw rate", command.yaw_rate, -limits_.walk_yaw_rate, limits_.walk_yaw_rate, "rad/s");
  check("height", command.height, -limits_.walk_height, limits_.walk_height, "m");
  wishes_.walk = {.walk = command.walk,
                  .velocity = command.velocity,
                  .yaw_rate = command.yaw_rate,
                  .height = command.height,
                  .gait = gait(command.gait)};
}

void LiveOperator::gain(const ViewCommand& command) {
  WantedControl control = wishes_.control;
  control::LevelSpec& level = find_level(control.stack, command.level);
  control::TaskSpec& task = find_task(level, command.task);
  const auto number = task.numbers.find(command.name);
  if (number == task.numbers.end()) {
    std::vector<std::string> names;
    for (const auto& [name, value] : task.numbers) names.push_back(name);
    throw Error("the task " + command.task + " has no number \"" + command.name + "\"; " +
                valid_names(command.name, names));
  }
  const ViewNumber range = view_number(task.task, command.name, number->second, reach_);
  check((task_title(level, task) + " " + command.name).c_str(), command.value, range.min, range.max,
        range.unit == "–" ? "" : range.unit.c_str());
  number->second = command.value;
  (void)tasks::make_task(task.task, {task.numbers, task.choices});
  wishes_.control = std::move(control);
}

void LiveOperator::order(const ViewCommand& command) {
  WantedControl control = wishes_.control;
  std::vector<control::LevelSpec> levels;
  for (const std::string& name : command.levels) {
    levels.push_back(find_level(control.stack, name));
  }
  std::vector<std::string> given = command.levels, all = config::level_names(control.stack);
  std::ranges::sort(given);
  std::ranges::sort(all);
  if (given != all) {
    throw Error(text("an order of ", command.levels.size(), " levels; valid is one of all ",
                     control.stack.levels.size(), ", each once"));
  }
  control.stack.levels = std::move(levels);
  check_order(control.stack);
  wishes_.control = std::move(control);
}

void LiveOperator::friction(const ViewCommand& command) {
  check("friction", command.value, limits_.friction_min, limits_.friction_max, "");
  wishes_.control.friction = command.value;
}

bool LiveOperator::take(OperatorWishes& wishes) {
  const std::uint64_t changes = changes_.load(std::memory_order_acquire);
  if (changes == taken_) return false;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return false;
  taken_ = changes_.load(std::memory_order_acquire);
  if (given_up_) wishes_.control = *std::exchange(given_up_, std::nullopt);
  wishes = wishes_;
  wishes_.halt = false;
  wishes_.steps = 0;
  wishes_.reset = false;
  wishes_.pushes.clear();
  return true;
}

void LiveOperator::begin(std::vector<std::string> bodies) {
  const std::lock_guard lock(mutex_);
  wishes_ = {.paused = wishes_.paused,
             .halt = true,
             .steps = 0,
             .speed = wishes_.speed,
             .reset = false,
             .pushes = {},
             .walk = {},
             .control = scenario_control_};
  ended_.clear();
  given_up_.reset();
  bodies_ = std::move(bodies);
  changes_.fetch_add(1, std::memory_order_release);
}

void LiveOperator::set_ended(std::string reason) {
  const std::lock_guard lock(mutex_);
  ended_ = std::move(reason);
}

void LiveOperator::give_up(const WantedControl& present) {
  given_up_ = present;
  changes_.fetch_add(1, std::memory_order_release);
}

}  // namespace surefoot::server
