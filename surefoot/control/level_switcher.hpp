#pragma once

#include "surefoot/control/level_switch.hpp"
#include "surefoot/control/stack_options.hpp"
#include "surefoot/signals/hierarchy_report.hpp"
#include "surefoot/solver/soft_levels.hpp"

#include <cstddef>
#include <vector>

namespace surefoot::control {

/// On the way from one set of levels to another; at rest the two are the same.
struct LevelTransition {
  solver::LevelSet before, after;
  double share = 1.0;  ///< of `after`, 0 … 1

  [[nodiscard]] bool is_going_on() const { return before != after; }
};

/// Throws Error on a switch that the stack can't make: levels that it does not have, levels that
/// keep the physics, none at all, a time or duration that is none.
void check_level_switch(const StackOptions& stack, const LevelSwitch& change);

/// Throws Error unless the new stack has the levels of the present one, in any order, and the
/// duration is one.
void check_stack_change(const StackOptions& stack, const StackOptions& next, double duration);

/// Says at each tick which levels of the stack are there. One transition at a time.
class LevelSwitcher {
 public:
  /// All levels are there until the first switch. Throws Error on a switch that can't be made, or
  /// begins before the one above it has ended.
  LevelSwitcher(const StackOptions& stack, const std::vector<LevelSwitch>& schedule);

  /// Begins at the next tick, whatever its time. False, and nothing happens, while another is going
  /// on; one of the schedule then waits. Throws Error on a switch that can't be made, and does not
  /// allocate otherwise.
  [[nodiscard]] bool start(const LevelSwitch& change);

  /// Once a tick, with its time [s]. Does not allocate.
  const LevelTransition& update(double time) noexcept;

  /// By another clock: as if no tick had been. What was asked for begins at the next one, too.
  void begin_anew() noexcept;

  /// The same for a stack that has the same levels in another order or with other parameters, in
  /// the place of the present one. Throws Error where a switch of the schedule can't be made there.
  [[nodiscard]] LevelSwitcher for_stack(const StackOptions& stack) const;

  [[nodiscard]] const StackOptions& stack() const { return stack_; }
  /// Nothing is going on, and nothing was asked for.
  [[nodiscard]] bool is_idle() const { return !is_requested_ && !transition_.is_going_on(); }
  [[nodiscard]] const LevelTransition& transition() const { return transition_; }
  /// The switch by `start` that has begun at the last update, so that a log can have it.
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
  std::vector<Change> schedule_;    // … and with the levels' numbers
  std::size_t next_ = 0;
  bool is_requested_ = false, has_begun_request_ = false;
  Change requested_{};
  LevelSwitchReport begun_;
  LevelTransition transition_;
  double begin_ = 0.0, duration_ = 0.0;  // of the transition [s]
};

}  // namespace surefoot::control
