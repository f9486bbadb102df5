#pragma once

#include "surefoot/control/level_switch.hpp"
#include "surefoot/control/stack_options.hpp"
#include "surefoot/signals/hierarchy_report.hpp"
#include "surefoot/solver/soft_levels.hpp"

#include <cstddef>
#include <vector>

namespace surefoot::control {

/// A transition from one set of levels to another; at rest both are the same.
struct LevelTransition {
  solver::LevelSet before, after;
  double share = 1.0;  ///< of `after`, 0 … 1

  [[nodiscard]] bool is_going_on() const { return before != after; }
};

/// Throws Error on a switch that the stack can't make: with unknown levels, levels that keep the
/// physics, no level at all, or an invalid time or duration.
void check_level_switch(const StackOptions& stack, const LevelSwitch& change);

/// Throws Error unless the new stack has the levels of the present one, in any order, and the
/// duration is valid.
void check_stack_change(const StackOptions& stack, const StackOptions& next, double duration);

/// Decides at each tick which levels are present. One transition at a time.
class LevelSwitcher {
 public:
  /// All levels are present until the first switch. Throws Error on an invalid switch, or one that
  /// begins before the end of its predecessor.
  LevelSwitcher(const StackOptions& stack, const std::vector<LevelSwitch>& schedule);

  /// Starts a switch at the next tick, whatever its time; the schedule waits for it. Returns false
  /// without effect during another switch. Throws Error on an invalid switch, and allocates in that
  /// case only.
  [[nodiscard]] bool start(const LevelSwitch& change);

  /// One tick at its time [s]. Does not allocate.
  const LevelTransition& update(double time) noexcept;

  /// Restarts, as the clock has changed. A switch requested by `start` begins again, too.
  void restart() noexcept;

  /// The same schedule and levels for another stack, with the same levels in any order. Throws
  /// Error if it can't make a switch of the schedule.
  [[nodiscard]] LevelSwitcher for_stack(const StackOptions& stack) const;

  [[nodiscard]] const StackOptions& stack() const { return stack_; }
  /// No switch is in progress or requested.
  [[nodiscard]] bool is_idle() const { return !is_requested_ && !transition_.is_going_on(); }
  [[nodiscard]] const LevelTransition& transition() const { return transition_; }
  /// The switch requested by `start` that began at the last update, for the log.
  [[nodiscard]] const LevelSwitchReport& begun() const { return begun_; }

 private:
  struct Change {
    double time, duration;
    solver::LevelSet add, remove;
  };

  [[nodiscard]] static LevelSwitchReport report(const Change& change);
  [[nodiscard]] Change compiled(const LevelSwitch& change) const;
  void begin(const Change& change, double time);

  StackOptions stack_;
  std::vector<LevelSwitch> given_;  // the schedule
  std::vector<Change> schedule_;    // with the levels' indices
  std::size_t next_ = 0;
  bool is_requested_ = false, has_begun_request_ = false;
  Change requested_{};
  LevelSwitchReport begun_;
  LevelTransition transition_;
  double begin_ = 0.0, duration_ = 0.0;  // of the transition [s]
};

}  // namespace surefoot::control
