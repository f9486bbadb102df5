#include "server/live_view.hpp"

#include "server/view_tasks.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/closed_loop/change_log.hpp"
#include "surefoot/config/stack_text.hpp"
#include "surefoot/logging/hierarchy_status.hpp"

#include <algorithm>
#include <thread>
#include <utility>

namespace surefoot::server {
namespace {

constexpr std::chrono::milliseconds kNap{4};       // while paused or waiting
constexpr std::chrono::milliseconds kLongest{20};  // sleep before the wishes are checked again
constexpr double kFade = 0.3;                      // blend between stacks [s]

/// After a refused state the calibration is unknown and taken to continue.
bool calibrates(const TickRecord& tick) {
  const bool is_refused =
      !logging::was_solved(tick.hierarchy) && tick.command.mode == CommandMode::hold;
  return is_refused || tick.plan.calibration != CalibrationStage::none;
}

bool is_same(const std::optional<UserCommand>& a, const std::optional<UserCommand>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->walk == b->walk && a->velocity == b->velocity && a->yaw_rate == b->yaw_rate &&
         a->height == b->height && a->gait == b->gait;
}

}  // namespace

LiveView::LiveView(LiveOperator& wishes, LiveFeed& feed, std::function<bool()> interrupted,
                   bool waits_for_page)
    : operator_(wishes),
      feed_(feed),
      interrupted_(std::move(interrupted)),
      waits_for_page_(waits_for_page) {}

void LiveView::begin(const closed_loop::RunParts& parts) {
  parts_.emplace(parts);
  operator_.begin(parts.plant.bodies());
  while (!operator_.take(wishes_)) std::this_thread::yield();
  present_ = wishes_.control;
  walk_.reset();
  steps_ = wishes_.paused ? 1 : 0;  // for a first picture
  booked_.clear();
  pushes_.clear();
  reset_ = is_pending_ = false;
  hurries_ = waits_for_page_;
  tick_ = 0;
  pace_.begin(0.0, wishes_.speed, Clock::now());
  feed_.begin(parts, present_.stack, present_.friction);
  feed_.set_pace(wishes_.paused, wishes_.speed);
}

closed_loop::RunOrder LiveView::before_tick(double time) {
  while (true) {
    if (interrupted_()) return closed_loop::RunOrder::stop;
    take(time);
    if (reset_) return closed_loop::RunOrder::reset;
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
  begin_pushes();
  take_control(time);
  take_walk(time);
  return closed_loop::RunOrder::tick;
}

bool LiveView::is_held() const {
  if (wishes_.paused) return steps_ == 0;
  return hurries_ ? !feed_.has_room() : waits_for_page_ && !feed_.is_seen();
}

void LiveView::take(double time) {
  if (!operator_.take(wishes_)) return;
  if (wishes_.halt || !wishes_.paused) steps_ = 0;
  if (wishes_.paused) steps_ = std::min(steps_ + wishes_.steps, kMostStepsWaiting);
  reset_ = reset_ || wishes_.reset;
  for (const simulation::Push& wanted : wishes_.pushes) book(wanted, time);
  wishes_.pushes.clear();
  is_pending_ = true;
  feed_.set_pace(wishes_.paused, wishes_.speed);
}

// A booked push counts for the limit from now on, and is shown once it acts.
void LiveView::book(const simulation::Push& wanted, double time) {
  std::erase_if(pushes_,
                [&](const simulation::Push& push) { return push.time + push.duration <= time; });
  double acting = 0.0;
  for (const simulation::Push& push : pushes_) acting += push.force.norm();
  const double force = wanted.force.norm(), most = operator_.limits().push_force;
  if (acting + force > most * (1.0 + 1e-9)) {
    return feed_.notify(formatted(
        "the push of %.3g N is left out: pushes of %.3g N act already or wait for the next tick; "
        "valid is up to %.3g N at one time",
        force, acting, most));
  }
  booked_.push_back(wanted);
  booked_.back().time = time;
  pushes_.push_back(booked_.back());
}

void LiveView::begin_pushes() {
  for (const simulation::Push& push : booked_) {
    parts_->plant.push(push);
    keep(closed_loop::push_change(push));
  }
  booked_.clear();
}

void LiveView::take_control(double time) {
  if (!is_pending_) return;
  if (wishes_.control.friction != present_.friction) {
    parts_->controller.set_friction(wishes_.control.friction);
    keep({.time = time,
          .kind = "friction",
          .text = "friction " + change_text(present_.friction, wishes_.control.friction),
          .stack = {},
          .friction = wishes_.control.friction,
          .body = {}});
    present_.friction = wishes_.control.friction;
    feed_.set_control(present_.stack, present_.friction, tick_);
  }
  const std::string text = change_text(present_.stack, wishes_.control.stack);
  is_pending_ = !text.empty() && !change_stack(text, time);
}

// False during another blend: try again later.
bool LiveView::change_stack(const std::string& text, double time) {
  try {
    if (!parts_->controller.set_stack(wishes_.control.stack, kFade)) return false;
  } catch (const Error& error) {
    feed_.notify(error.what());
    wishes_.control = present_;
    operator_.give_up(present_);
    return true;
  }
  present_.stack = wishes_.control.stack;
  feed_.set_control(present_.stack, present_.friction, tick_);
  keep({.time = time,
        .kind = "stack",
        .text = text,
        .stack = config::stack_yaml(present_.stack),
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
        "height %+.3g m, gait %s",
        walk_->walk ? "walk" : "stand", walk_->velocity.x(), walk_->velocity.y(), walk_->yaw_rate,
        walk_->height, operator_.gait_name(walk_->gait).c_str());
  }
  keep({.time = time, .kind = "walk", .text = text, .stack = {}, .body = {}});
}

void LiveView::keep(logged::Change change) {
  parts_->log_change(change);
  feed_.show(change);
}

// Only the scenario decides about calibration.
UserCommand LiveView::user(const UserCommand& planned) {
  UserCommand command = walk_.value_or(planned);
  command.calibrate = planned.calibrate;
  return command;
}

void LiveView::after_tick(const TickRecord& tick, const simulation::GroundTruth& truth,
                          const TickTiming& timing) {
  feed_.put(tick_++, tick, truth, timing);
  if (!hurries_) return;
  is_off_pace_ = true;
  hurries_ = calibrates(tick);
}

bool LiveView::wait_for_reset(const std::string& reason) {
  operator_.set_ended(reason);
  feed_.set_ended(reason);
  while (!interrupted_() && !reset_) {
    if (operator_.take(wishes_)) {
      reset_ = wishes_.reset;
      feed_.set_pace(wishes_.paused, wishes_.speed);
    }
    std::this_thread::sleep_for(kNap);
  }
  return reset_;
}

}  // namespace surefoot::server
