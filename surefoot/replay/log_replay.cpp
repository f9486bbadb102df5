#include "surefoot/replay/log_replay.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/logging/message_decoder.hpp"
#include "surefoot/replay/logged_scenario.hpp"
#include "surefoot/replay/playback.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>
#include <string_view>

namespace surefoot::replay {
namespace {

void check_attachments(const std::string& path, const logging::LogReader& log) {
  for (const char* name : {"resolved_stack.yaml", "robot.yaml", "robot.urdf"}) {
    if (log.header().attachment(name) != nullptr) continue;
    throw FileError(path + ": the log has no attachment " + name +
                    ", so its controller can't be made again; record the run anew" +
                    (log.problem().empty() ? "" : "; " + log.problem()));
  }
}

bool gave_plans(const std::string& own_part) {
  return own_part == "planner" || own_part.starts_with("gait ");
}

constexpr const char* kHowToGive =
    "a task of your own can be given: in Python own_tasks=[…], in C++ tasks::OwnTasks";

/// States and plans are in the log; what a task asked for is not.
void check_tasks(const std::string& path, const logging::LogHeader& header,
                 const tasks::OwnTasks& own) {
  constexpr std::string_view kTask = "task ";
  for (const std::string& part : header.own_parts) {
    if (!part.starts_with(kTask) || own.find(part.substr(kTask.size())) != nullptr) continue;
    throw Error(path + ": the run's " + part +
                " is the user's own and was not given, so the run's controller can't be made "
                "again; " +
                kHowToGive);
  }
}

/// Changes are in the log before the first tick that has them.
void keep_change(const logging::McapMessage& message, std::vector<logged::Change>& changes) {
  if (message.channel->topic != "/changes") return;
  logged::Decoder::decode(message.data, changes.emplace_back());
}

}  // namespace

LogReplay::LogReplay(const std::string& path, const ReplayOptions& options)
    : path_(path),
      log_(path,
           [this, observer = options.observer](const logging::McapMessage& message) {
             keep_change(message, changes_);
             if (observer) observer(message);
           }),
      own_tasks_(options.own_tasks) {
  check_attachments(path, log_);
  check_tasks(path, log_.header(), own_tasks_);
  config::Scenario scenario = logged_scenario(log_.header(), folder_, own_tasks_);
  const std::vector<std::string>& own_parts = log_.header().own_parts;
  const bool had_own_estimator = std::ranges::count(own_parts, "estimator") > 0;
  estimates_ = options.state == ReplayedState::estimated &&
               scenario.estimation == estimation::Estimation::sensors && !had_own_estimator;
  std::unique_ptr<estimation::StateEstimator> estimator;
  if (estimates_) {
    estimator = std::make_unique<estimation::LegInertialEstimator>(
        scenario.robot, scenario.estimator, scenario.controller.period);
  } else {
    estimator = std::make_unique<PlaybackEstimator>(tick_.state);
  }
  std::unique_ptr<gaits::MotionPlanner> planner;
  if (options.make_planner) {
    planner = options.make_planner(scenario.robot);
  } else {
    std::ranges::copy_if(own_parts, std::back_inserter(played_back_), gave_plans);
    if (!played_back_.empty()) planner = std::make_unique<PlaybackPlanner>(tick_);
  }
  if (had_own_estimator && !estimates_) played_back_.emplace_back("estimator");
  controller_ = std::make_unique<control::Controller>(scenario.robot, scenario.controller,
                                                      std::move(estimator), std::move(planner));
  explain_levels(true);
  options_ = std::move(scenario.controller);
  robot_ = std::move(scenario.robot);
}

bool LogReplay::step() {
  if (gap_ || !log_.next(tick_)) return false;
  if (!log_.follows()) {
    count_rest();
    return false;
  }
  last_time_ = tick_.reading.time;
  apply_changes();
  switch_levels(tick_.hierarchy.level_switch);
  controller_->step(tick_.reading, tick_.user);
  return true;
}

void LogReplay::count_rest() {
  gap_ = {.from = last_time_, .to = tick_.reading.time};
  do {
    ++gap_->ticks_behind;
    changes_.clear();
  } while (log_.next(tick_));
}

// As the run did.
void LogReplay::apply_changes() {
  for (const logged::Change& change : changes_) {
    if (change.kind == "friction") controller_->set_friction(change.friction);
    if (change.kind != "stack") continue;
    const control::StackOptions stack = changed_stack(change);
    // Refused only if the log is of another version; then `is_same` is false.
    (void)controller_->set_stack(stack, change.duration);
  }
  changes_.clear();
}

control::StackOptions LogReplay::changed_stack(const logged::Change& change) const {
  try {
    return config::parse_stack(change.stack, "/changes", {}, own_tasks_);
  } catch (const Error& error) {
    const std::string why = error.what();
    const bool lacks_task = why.find(": unknown task ") != std::string::npos;
    throw Error(path_ + formatted(": from %.4f s on", tick_.reading.time) +
                " the run has a stack that can't be read: " + why +
                (lacks_task ? std::string("; ") + kHowToGive : ""));
  }
}

void LogReplay::switch_levels(const LevelSwitchReport& logged) {
  if (!logged.begins) return;
  control::LevelSwitch change{.duration = logged.duration};
  const std::vector<std::string>& names = log_.header().level_names;
  for (std::size_t k = 0; k < std::min(names.size(), logged.change.size()); ++k) {
    if (logged.change[k] == LevelChange::comes) change.add.push_back(names[k]);
    if (logged.change[k] == LevelChange::goes) change.remove.push_back(names[k]);
  }
  // Refused only if the log is of another version; then `is_same` is false.
  (void)controller_->switch_levels(change);
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool LogReplay::is_same() const {
  const JointCommand& command = controller_->record().command;
  return command.mode == tick_.command.mode &&
         std::equal(command.torque.begin(), command.torque.end(), tick_.command.torque.begin(),
                    same_bits);
}

}  // namespace surefoot::replay
