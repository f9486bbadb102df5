#include "app/live_view.hpp"

#include "app/stack_text.hpp"
#include "app/view_tasks.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"

#include <cstdio>
#include <thread>
#include <utility>

namespace surefoot {
namespace {

constexpr std::chrono::milliseconds kNap{4};       // while it is paused or waits
constexpr std::chrono::milliseconds kLongest{20};  // sleep before the operator is asked again
constexpr double kPullInterval = 0.05;             // that a pull stays as it is, at least [s]
constexpr double kFade = 0.3;                      // from a stack to the next [s]

std::string vector_text(const Vec3& v) {
  return formatted("(%.3g, %.3g, %.3g)", v.x(), v.y(), v.z());
}

std::string push_text(const Push& push) {
  return formatted("push of %.3g N·s at ", push.force.norm() * push.duration) + push.body;
}

std::string pushes_text(const std::vector<Push>& pushes) {
  if (pushes.empty()) return "";
  if (pushes.size() == 1) return push_text(pushes.front());
  double sum = 0.0;
  for (const Push& push : pushes) sum += push.force.norm() * push.duration;
  return std::to_string(pushes.size()) + formatted(" pushes, %.3g N·s together", sum);
}

bool is_same(const std::optional<UserCommand>& a, const std::optional<UserCommand>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->walk == b->walk && a->velocity == b->velocity && a->yaw_rate == b->yaw_rate &&
         a->height == b->height;
}

}  // namespace

LiveView::LiveView(LiveOperator& wishes, LiveFeed& feed, std::function<bool()> interrupted,
                   bool waits_for_page)
    : operator_(wishes),
      feed_(feed),
      interrupted_(std::move(interrupted)),
      waits_for_page_(waits_for_page) {}

void LiveView::begin(const RunParts& parts) {
  parts_.emplace(parts);
  operator_.begin(parts.plant.bodies());
  while (!operator_.take(wishes_)) std::this_thread::yield();
  present_ = wishes_.control;
  walk_.reset();
  steps_ = 0;
  forces_.emplace(operator_.limits(), parts.plant.bodies());
  booked_.clear();
  pulled_ = Pull();
  reset_ = is_pending_ = false;
  hurries_ = waits_for_page_;
  pending_.clear();
  tick_ = 0;
  pace_.begin(0.0, wishes_.speed, Clock::now());
  feed_.begin(parts, present_.stack, present_.friction);
  feed_.set_pace(wishes_.paused, wishes_.speed);
}

RunOrder LiveView::before_tick(double time) {
  while (true) {
    if (interrupted_()) return RunOrder::stop;
    forces_->advance(time);
    take(time);
    if (reset_) return RunOrder::reset;
    const Clock::time_point now = Clock::now();
    if (is_held()) {
      is_off_pace_ = true;
      std::this_thread::sleep_for(kNap);
      continue;
    }
    if (wishes_.paused || hurries_) break;
    if (is_off_pace_ || wishes_.speed != speed_) {
      pace_.begin(time, wishes_.speed, now);
      is_off_pace_ = false;
      speed_ = wishes_.speed;
    }
    const Clock::time_point due = pace_.due(time, now);
    if (due <= now) break;
    std::this_thread::sleep_until(std::min(due, now + kLongest));
  }
  if (steps_ > 0) --steps_;
  begin_pushes(time);
  take_control(time);
  take_walk(time);
  take_pull(time);
  return RunOrder::tick;
}

bool LiveView::is_held() const {
  if (wishes_.paused) return steps_ == 0;
  return hurries_ ? !feed_.has_room() : waits_for_page_ && !feed_.is_seen();
}

bool LiveView::has(const WantedControl& control) const {
  return control.friction == present_.friction &&
         change_text(present_.stack, control.stack).empty();
}

void LiveView::take(double time) {
  const bool is_change_waiting = is_pending_ && wishes_.reason.empty() && !has(wishes_.control);
  if (!operator_.take(wishes_)) return;
  if (is_change_waiting) wishes_.reason.clear();  // it comes with what an undo undoes
  if (wishes_.halt || !wishes_.paused) steps_ = 0;
  if (wishes_.paused) steps_ = std::min(steps_ + wishes_.steps, kMostStepsWaiting);
  reset_ = reset_ || wishes_.reset;
  for (const Push& wanted : wishes_.pushes) book(wanted, time);
  wishes_.pushes.clear();
  is_pending_ = true;
  if (wishes_.paused) {
    tell_pending(pending_text());
    feed_.set_forces(forces_->now());  // no tick comes to tell them
  }
  feed_.set_pace(wishes_.paused, wishes_.speed);
}

// It counts from now on, and is told once it acts.
void LiveView::book(const Push& wanted, double time) {
  Push push = wanted;
  push.time = time;
  if (const std::string problem = forces_->push(push); !problem.empty()) return feed_.tell(problem);
  booked_.push_back(push);
}

void LiveView::begin_pushes(double time) {
  for (const Push& push : booked_) {
    parts_->plant.push(push);
    keep({.time = time,
          .kind = "push",
          .text = push_text(push) + ", force " + vector_text(push.force) +
                  formatted(" N for %.3g s", push.duration),
          .stack = {},
          .duration = push.duration,
          .body = push.body,
          .force = push.force});
  }
  booked_.clear();
}

void LiveView::take_control(double time) {
  if (!is_pending_) return;
  if (wishes_.control.friction != present_.friction) {
    parts_->controller.set_friction(wishes_.control.friction);
    keep({.time = time,
          .kind = "friction",
          .text = wishes_.reason + "friction " +
                  change_text(present_.friction, wishes_.control.friction),
          .stack = {},
          .friction = wishes_.control.friction,
          .body = {}});
    present_.friction = wishes_.control.friction;
    feed_.set_control(present_.stack, present_.friction, tick_);
  }
  const std::string text = change_text(present_.stack, wishes_.control.stack, wishes_.moved);
  is_pending_ = !text.empty() && !change_stack(wishes_.reason + text, time);
  tell_pending(is_pending_ ? wishes_.reason + text : "");
}

// What the next tick will take.
std::string LiveView::pending_text() const {
  const std::string control = control_text(), pushes = pushes_text(booked_);
  return control + (control.empty() || pushes.empty() ? "" : "; ") + pushes;
}

// What take_control will do.
std::string LiveView::control_text() const {
  std::string text;
  if (wishes_.control.friction != present_.friction)
    text = "friction " + change_text(present_.friction, wishes_.control.friction);
  const std::string stack = change_text(present_.stack, wishes_.control.stack, wishes_.moved);
  if (!text.empty() && !stack.empty()) text += "; ";
  text += stack;
  return text.empty() ? "" : wishes_.reason + text;
}

void LiveView::tell_pending(const std::string& text) {
  if (text != pending_) feed_.set_pending(pending_ = text);
}

// False while another change goes on: then it comes later.
bool LiveView::change_stack(const std::string& text, double time) {
  try {
    if (!parts_->controller.set_stack(wishes_.control.stack, kFade)) return false;
  } catch (const Error& error) {
    feed_.tell(error.what());
    wishes_.control = present_;
    operator_.give_up(present_);
    return true;
  }
  present_.stack = wishes_.control.stack;
  feed_.set_control(present_.stack, present_.friction, tick_);
  keep({.time = time,
        .kind = "stack",
        .text = text,
        .stack = stack_yaml(present_.stack),
        .duration = kFade,
        .body = {}});
  return true;
}

void LiveView::take_walk(double time) {
  if (is_same(walk_, wishes_.walk)) return;
  walk_ = wishes_.walk;
  std::string text = "the scenario commands the walk";
  if (walk_) {
    text = formatted(
        "the operator commands: %s, velocity (%.3g, %.3g) m/s, yaw rate %.3g rad/s, "
        "height %+.3g m",
        walk_->walk ? "walk" : "stand", walk_->velocity.x(), walk_->velocity.y(), walk_->yaw_rate,
        walk_->height);
  }
  keep({.time = time, .kind = "walk", .text = text, .stack = {}, .body = {}});
}

void LiveView::take_pull(double time) {
  const bool goes_on = !pulled_.force.isZero();
  if (!wishes_.pull || Clock::now() >= wishes_.pull_ends || wishes_.pull->force.isZero()) {
    if (goes_on) end_pull(time);
    return;
  }
  const double left = pull_taken_ + kPullInterval - time;
  const bool is_same_body = goes_on && wishes_.pull->body == pulled_.body;
  if (is_same_body && left > 0.0 && !forces_->is_too_much(left)) return;
  if (goes_on && !is_same_body) end_pull(time);
  Pull wanted = *wishes_.pull;
  wanted.force = forces_->bounded(wanted.force);
  const bool is_weaker = wanted.force != wishes_.pull->force;
  if (wanted.force.isZero()) return end_pull(time);
  if (wanted.body == pulled_.body && wanted.point == pulled_.point &&
      wanted.force == pulled_.force) {
    return;
  }
  pull(wanted, is_weaker, time);
}

void LiveView::pull(const Pull& wanted, bool is_weaker, double time) {
  pulled_ = wanted;
  pull_taken_ = time;
  parts_->plant.pull(wanted);
  forces_->pull(wanted, is_weaker);
  keep({.time = time,
        .kind = "pull",
        .text = "pull at " + wanted.body + ", force " + vector_text(wanted.force) + " N",
        .stack = {},
        .body = wanted.body,
        .point = wanted.point,
        .force = wanted.force});
}

void LiveView::end_pull(double time) {
  if (pulled_.force.isZero()) return;
  pulled_.force.setZero();
  parts_->plant.pull(pulled_);
  keep({.time = time,
        .kind = "pull",
        .text = formatted("the pull ends after %.1f N·s", forces_->now().pull.given),
        .stack = {},
        .body = pulled_.body,
        .point = pulled_.point,
        .force = pulled_.force});
  forces_->pull(pulled_, false);
}

void LiveView::keep(logged::Change change) {
  parts_->log_change(change);
  feed_.show(change);
}

// Who gives the robot back to its scenario does not ask for a calibration by it.
UserCommand LiveView::user(const UserCommand& planned) {
  UserCommand command = walk_.value_or(planned);
  command.calibrate = planned.calibrate;
  return command;
}

void LiveView::after_tick(const TickRecord& tick, const GroundTruth& truth,
                          const TickTiming& timing) {
  feed_.put(tick_++, tick, truth, timing, forces_->now());
  if (!hurries_) return;
  is_off_pace_ = true;
  hurries_ = tick.plan.calibration != CalibrationStage::none;
}

void LiveView::end(double time) {
  forces_->advance(time);
  end_pull(time);
}

bool LiveView::wait_for_reset(const std::string& reason) {
  operator_.set_ended(reason);
  feed_.set_ended(reason);
  tell_pending("");
  while (!interrupted_() && !reset_) {
    if (operator_.take(wishes_)) {
      reset_ = wishes_.reset;
      feed_.set_pace(wishes_.paused, wishes_.speed);
    }
    std::this_thread::sleep_for(kNap);
  }
  return reset_;
}

}  // namespace surefoot
