#include "app/stack_comparison.hpp"

#include "app/hierarchy_status.hpp"
#include "app/interrupt.hpp"
#include "app/log_replay.hpp"
#include "app/stop_text.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/logging/message_codec.hpp"
#include "surefoot/solver/solution.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace surefoot {
namespace {

/// Where a level's numbers are in a report; none where it has none.
std::optional<std::size_t> place(const TickRecord& tick, const std::vector<std::string>& names,
                                 const std::string& name) {
  const auto found = std::ranges::find(names, name);
  const auto level = found - names.begin();
  if (found == names.end() || level >= tick.hierarchy.num_levels) return std::nullopt;
  return static_cast<std::size_t>(level);
}

bool is_optimal(const TickRecord& tick) {
  return tick.command.mode == CommandMode::optimal &&
         tick.hierarchy.status == static_cast<std::int32_t>(SolveStatus::optimal);
}

std::string plan_text(const MotionPlan& plan) {
  std::string text;
  logged::encode(plan, text);
  return text;
}

/// Sums up, tick by tick.
class Comparison {
 public:
  Comparison(const LogReplay& replay, StackComparison& result)
      : names_(replay.header().level_names),
        other_names_(replay.controller().level_names()),
        result_(result) {
    for (std::ptrdiff_t k = 0; k < std::ssize(names_); ++k)
      add_level(replay.header().level_name(k), replay.header().level_unit(k));
    const std::vector<std::string> other_units = replay.controller().level_units();
    for (std::size_t k = 0; k < other_names_.size(); ++k) {
      other_levels_.push_back({other_names_[k], other_units[k]});
      if (std::ranges::find(names_, other_names_[k]) == names_.end())
        add_level(other_names_[k], other_units[k]);
    }
    solved_.resize(result_.levels.size());
  }

  void add(const TickRecord& logged, const TickRecord& other) {
    if (result_.ticks++ == 0) result_.first_time = logged.reading.time;
    result_.last_time = logged.reading.time;
    add_torques(logged, other);
    if (was_used(logged) && was_used(other)) add_residuals(logged, other);
    add_modes(logged, other);
    result_.same_plan = result_.same_plan && plan_text(logged.plan) == plan_text(other.plan);
    if (logged.hierarchy.level_switch.begins) ++result_.logged_switches;
  }

  void finish() {
    const auto ticks = static_cast<double>(std::max(1L, result_.ticks));
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

  void add_torques(const TickRecord& logged, const TickRecord& other) {
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

  void add_residuals(const TickRecord& logged, const TickRecord& other) {
    for (std::size_t k = 0; k < result_.levels.size(); ++k) {
      LevelComparison& level = result_.levels[k];
      const auto in_log = place(logged, names_, level.name);
      const auto in_other = place(other, other_names_, level.name);
      const double before = in_log ? logged.hierarchy.levels[*in_log].residual : 0.0;
      const double now = in_other ? computed_residual(other.hierarchy, *in_other) : 0.0;
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

  void add_modes(const TickRecord& logged, const TickRecord& other) {
    if (!is_optimal(logged)) ++result_.logged_not_optimal;
    if (!result_.walk_end && logged.command.cause != StopCause::none)
      result_.walk_end = {logged.reading.time,
                          "its controller stopped for safety: " + text_of_stop(logged)};
    if (!is_optimal(other) && result_.other_not_optimal++ == 0)
      result_.other_first_not_optimal = logged.reading.time;
    if (result_.other_stopped || other.command.cause == StopCause::none) return;
    result_.other_stopped = true;
    result_.other_stopped_at = logged.reading.time;
  }

  const std::vector<std::string> names_, other_names_;
  std::vector<OtherLevel> other_levels_;
  StackComparison& result_;
  std::vector<long> solved_;  // ticks, of each level
};

}  // namespace

StackComparison compare_stack(const std::string& path, const std::string& stack,
                              const StackObserver& observer) {
  LogReplay replay(path, {.state = ReplayedState::logged, .stack = stack});
  StackComparison result;
  result.header = replay.header();
  result.header.attachments.clear();
  result.other = stack;
  Comparison comparison(replay, result);
  while (replay.step()) {
    if (interrupted()) throw Error("interrupted: nothing is said of the other stack");
    const TickRecord& other = replay.controller().record();
    comparison.add(replay.logged(), other);
    if (observer) observer(replay.logged(), other, comparison.other_levels());
  }
  comparison.finish();
  const auto ends = [&result](const std::optional<double>& time, const char* why) {
    if (time && !(result.walk_end && result.walk_end->time <= *time))
      result.walk_end = {*time, why};
  };
  ends(replay.torso_down(), "its torso came to the ground");
  ends(replay.feet_up(), "no foot touched the ground any more");
  result.problem = replay.problem();
  result.gap = replay.gap();
  if (result.ticks == 0 && result.gap)
    throw FileError(path +
                    ": its first ticks are lost, and behind them no controller can be asked; " +
                    result.problem);
  if (result.ticks == 0)
    throw FileError(path + ": the log holds no tick, so there is nothing to ask" +
                    (result.problem.empty() ? "" : "; " + result.problem));
  return result;
}

}  // namespace surefoot
