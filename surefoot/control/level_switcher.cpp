#include "surefoot/control/level_switcher.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/smoothstep.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace surefoot::control {
namespace {

std::string text(double number) {
  std::ostringstream stream;
  stream << number;
  return stream.str();
}

/// For error messages.
std::string free_levels(const StackOptions& stack) {
  std::string list;
  for (const LevelSpec& level : stack.levels) {
    if (!keeps_physics(level)) list += (list.empty() ? "" : " ") + level.name;
  }
  return "the stack \"" + stack.name + "\" can switch: " + list;
}

void check_level(const StackOptions& stack, const std::string& name) {
  const auto found = std::ranges::find(stack.levels, name, &LevelSpec::name);
  if (found == stack.levels.end()) {
    throw Error("unknown level \"" + name + "\"; " + free_levels(stack));
  }
  if (keeps_physics(*found)) {
    throw Error("the level \"" + name + "\" keeps the physics and is always there; " +
                free_levels(stack));
  }
}

void check_time(const char* what, double value) {
  if (value >= 0.0 && std::isfinite(value)) return;
  throw Error(std::string(what) + " of a level switch is " + text(value) +
              "; valid is a time of at least 0 s");
}

solver::LevelSet levels_of(const StackOptions& stack, const std::vector<std::string>& names) {
  solver::LevelSet set;
  for (std::size_t k = 0; k < std::min(stack.levels.size(), set.size()); ++k) {
    set[k] = std::ranges::find(names, stack.levels[k].name) != names.end();
  }
  return set;
}

std::vector<std::string> sorted_names(const StackOptions& stack) {
  std::vector<std::string> names;
  for (const LevelSpec& level : stack.levels) names.push_back(level.name);
  std::ranges::sort(names);
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

void check_level_switch(const StackOptions& stack, const LevelSwitch& change) {
  check_time("time", change.time);
  check_time("duration", change.duration);
  if (change.add.empty() && change.remove.empty()) {
    throw Error("a level switch that adds and removes nothing; " + free_levels(stack));
  }
  for (const std::string& name : change.add) check_level(stack, name);
  for (const std::string& name : change.remove) {
    check_level(stack, name);
    if (std::ranges::find(change.add, name) != change.add.end())
      throw Error("the level \"" + name + "\" is to be added and removed at once");
  }
}

void check_stack_change(const StackOptions& stack, const StackOptions& next, double duration) {
  check_time("duration", duration);
  const std::vector<std::string> present = sorted_names(stack), given = sorted_names(next);
  if (given == present) return;
  throw Error("the new stack \"" + next.name + "\" has the levels: " + listed(given) +
              "; valid are those of the present one, each once, in any order: " + listed(present));
}

LevelSwitcher::LevelSwitcher(const StackOptions& stack, const std::vector<LevelSwitch>& schedule)
    : stack_(stack), given_(schedule) {
  double end = 0.0;
  for (const LevelSwitch& change : schedule) {
    schedule_.push_back(compiled(change));
    if (change.time < end) {
      throw Error("the level switch at " + text(change.time) +
                  " s begins before the one above it has ended, at " + text(end) + " s");
    }
    end = change.time + change.duration;
  }
  transition_.before.set();
  transition_.after.set();
}

LevelSwitcher LevelSwitcher::for_stack(const StackOptions& stack) const {
  LevelSwitcher result(stack, given_);
  result.next_ = next_;
  for (std::size_t k = 0; k < std::min(stack.levels.size(), result.transition_.after.size()); ++k) {
    const auto old = std::ranges::find(stack_.levels, stack.levels[k].name, &LevelSpec::name);
    if (old == stack_.levels.end()) continue;
    result.transition_.after[k] =
        transition_.after[static_cast<std::size_t>(old - stack_.levels.begin())];
  }
  result.transition_.before = result.transition_.after;
  return result;
}

bool LevelSwitcher::start(const LevelSwitch& change) {
  const Change valid = compiled(change);
  if (is_requested_ || transition_.is_going_on()) return false;
  requested_ = valid;
  is_requested_ = true;
  return true;
}

const LevelTransition& LevelSwitcher::update(double time) noexcept {
  begun_.begins = false;
  // At the first ticks the clock may be unknown, and set back.
  if (!std::isfinite(time)) return transition_;
  begin_ = std::min(begin_, time);
  if (transition_.is_going_on()) transition_.share = smooth_ramp(time - begin_, duration_);
  if (transition_.share >= 1.0) transition_.before = transition_.after;
  begun_.begins = is_requested_ && !transition_.is_going_on();
  if (begun_.begins) {
    begin(requested_, time);
    begun_ = report(requested_);
    is_requested_ = false;
    has_begun_request_ = true;
  }
  while (!transition_.is_going_on() && next_ < schedule_.size() && schedule_[next_].time <= time) {
    begin(schedule_[next_++], time);
  }
  return transition_;
}

void LevelSwitcher::restart() noexcept {
  transition_.before.set();
  transition_.after.set();
  transition_.share = 1.0;
  next_ = 0;
  is_requested_ = is_requested_ || has_begun_request_;
}

void LevelSwitcher::begin(const Change& change, double time) {
  begin_ = time;
  duration_ = change.duration;
  transition_.after = (transition_.before | change.add) & ~change.remove;
  transition_.share = duration_ > 0.0 ? 0.0 : 1.0;
  if (transition_.share >= 1.0) transition_.before = transition_.after;
}

LevelSwitchReport LevelSwitcher::report(const Change& change) {
  LevelSwitchReport report{.begins = true, .duration = change.duration, .change = {}};
  for (std::size_t k = 0; k < report.change.size(); ++k) {
    if (change.add[k]) report.change[k] = LevelChange::comes;
    if (change.remove[k]) report.change[k] = LevelChange::goes;
  }
  return report;
}

LevelSwitcher::Change LevelSwitcher::compiled(const LevelSwitch& change) const {
  check_level_switch(stack_, change);
  return {change.time, change.duration, levels_of(stack_, change.add),
          levels_of(stack_, change.remove)};
}

}  // namespace surefoot::control
