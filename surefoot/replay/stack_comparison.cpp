#include "surefoot/replay/stack_comparison.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/control/asked_stack.hpp"
#include "surefoot/logging/hierarchy_status.hpp"
#include "surefoot/logging/stop_text.hpp"
#include "surefoot/replay/logged_scenario.hpp"
#include "surefoot/solver/solution.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace surefoot::replay {
namespace {

/// Index of a level in a report; empty if it is not there.
std::optional<std::size_t> place(const HierarchyReport& report,
                                 const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  const auto level = found - names.begin();
  if (found == names.end() || level >= report.num_levels) return std::nullopt;
  return static_cast<std::size_t>(level);
}

bool is_optimal(const JointCommand& command, const HierarchyReport& hierarchy) {
  return command.mode == CommandMode::optimal &&
         hierarchy.status == static_cast<std::int32_t>(solver::SolveStatus::optimal);
}

bool is_answered(const TickRecord& tick) {
  return tick.command.mode == CommandMode::optimal || tick.command.mode == CommandMode::degraded;
}

/// Sums up differences tick by tick.
class Comparison {
 public:
  Comparison(const logging::LogHeader& header, const control::AskedStack& other,
             StackComparison& result)
      : joints_(header.robot.joints()),
        names_(header.level_names),
        other_names_(other.level_names()),
        other_(other),
        result_(result) {
    for (std::ptrdiff_t k = 0; k < std::ssize(names_); ++k)
      add_level(header.level_name(k), header.level_unit(k));
    const std::vector<std::string> other_units = other.level_units();
    for (std::size_t k = 0; k < other_names_.size(); ++k) {
      other_levels_.push_back({other_names_[k], other_units[k]});
      if (std::ranges::find(names_, other_names_[k]) == names_.end())
        add_level(other_names_[k], other_units[k]);
    }
    solved_.resize(result_.levels.size());
  }

  /// `other` is null if it was not asked.
  void add(const TickRecord& logged, const control::StackAnswer* other) {
    const double time = logged.reading.time;
    if (result_.ticks++ == 0) result_.first_time = time;
    result_.last_time = time;
    add_logged(logged);
    if (other == nullptr) result_.not_asked.add(time);
    if (other == nullptr) return;
    add_answer(time, *other);
    if (!is_answered(logged) || !other->is_usable()) return;
    ++result_.compared;
    add_torques(logged, *other);
    add_residuals(logged, *other);
  }

  void finish() {
    const auto ticks = static_cast<double>(std::max(1L, result_.compared));
    for (JointComparison& joint : result_.joints) joint.rms = std::sqrt(joint.rms / ticks);
    for (std::size_t k = 0; k < result_.levels.size(); ++k) {
      LevelComparison& level = result_.levels[k];
      const auto solved = static_cast<double>(std::max(1L, solved_[k]));
      level.logged_rms = std::sqrt(level.logged_rms / solved);
      level.other_rms = std::sqrt(level.other_rms / solved);
    }
  }

  [[nodiscard]] const std::vector<OtherLevel>& other_levels() const { return other_levels_; }

 private:
  void add_level(const std::string& name, const std::string& unit) {
    const auto is_in = [&](const std::vector<std::string>& names) {
      return std::ranges::find(names, name) != names.end();
    };
    result_.levels.push_back(
        {.name = name, .unit = unit, .in_log = is_in(names_), .in_other = is_in(other_names_)});
  }

  void add_logged(const TickRecord& logged) {
    const double time = logged.reading.time;
    if (!is_optimal(logged.command, logged.hierarchy)) result_.logged_not_optimal.add(time);
    if (!is_answered(logged)) result_.logged_unanswered.add(time);
    const bool is_changing = logged.hierarchy.transition_share < 1.0;
    if (logged.hierarchy.level_switch.begins || (is_changing && !was_changing_))
      ++result_.logged_switches;
    was_changing_ = is_changing;
  }

  void add_answer(double time, const control::StackAnswer& other) {
    if (!is_optimal(other.command, other.hierarchy)) result_.other_not_optimal.add(time);
    if (other.is_usable()) return;
    result_.other_unanswered.add(time, why_unanswered(other));
    const JointCommand& command = other.command;
    if (command.cause != StopCause::none)
      result_.other_stopped.add(
          time, logging::text_of_stop(command.cause, command.fault, command.joint, joints_));
  }

  [[nodiscard]] std::string why_unanswered(const control::StackAnswer& other) const {
    const auto status = static_cast<solver::SolveStatus>(other.hierarchy.status);
    const StopCause cause = other.command.cause;
    const bool is_by_posture = cause != StopCause::none && cause != StopCause::failures;
    if (status == solver::SolveStatus::optimal || is_by_posture)
      return logging::text_of_stop(cause, SampleFault::none, -1, joints_);
    if (const std::string fault = other_.fault(); !fault.empty()) return fault;
    const auto level = static_cast<std::size_t>(other.hierarchy.failed_level);
    const std::string where = level < other_names_.size() ? " in " + other_names_[level] : "";
    return status == solver::SolveStatus::iteration_cap
               ? "its solve was cut off" + where + ", before all that keeps the physics was solved"
               : "its rows were no valid input" + where;
  }

  void add_torques(const TickRecord& logged, const control::StackAnswer& other) {
    result_.joints.resize(static_cast<std::size_t>(logged.command.torque.size()));
    for (std::size_t i = 0; i < result_.joints.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      const double difference = other.command.torque[at] - logged.command.torque[at];
      JointComparison& joint = result_.joints[i];
      joint.rms += difference * difference;
      if (std::abs(difference) <= std::abs(joint.largest)) continue;
      joint.largest = difference;
      joint.time = logged.reading.time;
    }
  }

  void add_residuals(const TickRecord& logged, const control::StackAnswer& other) {
    for (std::size_t k = 0; k < result_.levels.size(); ++k) {
      LevelComparison& level = result_.levels[k];
      const auto in_log = place(logged.hierarchy, names_, level.name);
      const auto in_other = place(other.hierarchy, other_names_, level.name);
      const double before = in_log ? logged.hierarchy.levels[*in_log].residual : 0.0;
      const double now = in_other ? logging::computed_residual(other.hierarchy, *in_other) : 0.0;
      if (std::isnan(before) || std::isnan(now)) continue;
      ++solved_[k];
      level.logged_rms += before * before;
      level.other_rms += now * now;
      see(before, logged.reading.time, level.logged_max, level.logged_time);
      see(now, logged.reading.time, level.other_max, level.other_time);
    }
  }

  static void see(double residual, double time, double& largest, double& at) {
    if (residual <= largest) return;
    largest = residual;
    at = time;
  }

  const std::vector<std::string> joints_, names_, other_names_;
  const control::AskedStack& other_;
  std::vector<OtherLevel> other_levels_;
  StackComparison& result_;
  std::vector<long> solved_;  // ticks, of each level
  bool was_changing_ = false;
};

void check_has_ticks(const std::string& path, const StackComparison& result) {
  if (result.ticks > 0) return;
  if (result.gap)
    throw FileError(path +
                    ": its first ticks are lost, and behind them no controller can be asked; " +
                    result.problem);
  throw FileError(path + ": the log holds no tick, so there is nothing to ask" +
                  (result.problem.empty() ? "" : "; " + result.problem));
}

}  // namespace

StackComparison compare_stack(const std::string& path, const std::string& stack,
                              const StackObserver& observer, const tasks::OwnTasks& own,
                              const std::function<bool()>& stops) {
  const auto by_name = [&](const LogReplay& run) {
    const logging::ScratchFolder folder;
    return logged_scenario(run.header(), folder, stack, own).controller.stack;
  };
  StackComparison result = compare_stack(path, MakeStack(by_name), observer, own, stops);
  result.other = stack;
  return result;
}

// The log's own controller is computed again, because its model depends on all ticks before. Its
// torques are those of the logged readings; a controller with the other stack would contradict
// them.
StackComparison compare_stack(const std::string& path, const MakeStack& make_stack,
                              const StackObserver& observer, const tasks::OwnTasks& own,
                              const std::function<bool()>& stops) {
  WalkEndWatch walk;
  LogReplay replay(path,
                   {.state = ReplayedState::logged,
                    .observer = [&walk](const logging::McapMessage& message) { walk.see(message); },
                    .own_tasks = own});
  replay.explain_levels(false);
  const control::StackOptions stack = make_stack(replay);
  control::AskedStack other(stack, replay.options().solver, replay.options().safety,
                            replay.robot());
  StackComparison result;
  result.header = replay.header();
  result.header.attachments.clear();
  result.other = stack.name;
  Comparison comparison(replay.header(), other, result);
  while (replay.step()) {
    if (stops()) throw Error("interrupted: nothing is said of the other stack");
    const TickRecord& logged = replay.logged();
    const control::Controller& controller = replay.controller();
    const model::Dynamics* dynamics = controller.dynamics();
    const control::StackAnswer* answer =
        dynamics == nullptr ? nullptr
                            : &other.ask(controller.record().state, *dynamics, logged.plan);
    if (!replay.is_same()) result.not_reproduced.add(logged.reading.time);
    comparison.add(logged, answer);
    walk.see(logged, replay.header().robot.joints());
    if (observer) observer(logged, answer, comparison.other_levels());
  }
  comparison.finish();
  result.walk_end = walk.end();
  result.problem = replay.problem();
  result.gap = replay.gap();
  check_has_ticks(path, result);
  return result;
}

}  // namespace surefoot::replay
