#include "app/live_view.hpp"

#include "app/stack_text.hpp"
#include "app/view_tasks.hpp"
#include "surefoot/base/error.hpp"

#include <cstdio>
#include <thread>
#include <utility>

namespace surefoot {
namespace {

constexpr std::chrono::milliseconds kNap{4};       // while it is paused
constexpr std::chrono::milliseconds kLongest{20};  // sleep before the operator is asked again
constexpr int kMostSteps = 4000;                   // that wait while it is paused
constexpr double kPullInterval = 0.25;             // between a pull's changes in the log [s]
constexpr double kFade = 0.3;                      // from a stack to the next [s]

std::string text_of(const char* format, auto... values) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

std::string vector_text(const Vec3& v) {
  return text_of("(%.3g, %.3g, %.3g)", v.x(), v.y(), v.z());
}

bool is_same(const std::optional<UserCommand>& a, const std::optional<UserCommand>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->walk == b->walk && a->velocity == b->velocity && a->yaw_rate == b->yaw_rate &&
         a->height == b->height;
}

}  // namespace

LiveView::LiveView(LiveOperator& wishes, LiveFeed& feed, std::function<bool()> interrupted)
    : operator_(wishes), feed_(feed), interrupted_(std::move(interrupted)) {}

void LiveView::begin(const RunParts& parts) {
  parts_.emplace(parts);
  operator_.begin(parts.plant.bodies());
  while (!operator_.take(wishes_)) std::this_thread::yield();
  present_ = wishes_.control;
  walk_.reset();
  steps_ = 0;
  pulled_ = Pull();
  pulled_until_ = 0.0;
  reset_ = is_pending_ = false;
  pull_kept_ = -kPullInterval;
  tick_ = 0;
  pace_.begin(0.0, wishes_.speed, Clock::now());
  feed_.begin(parts, present_.stack, present_.friction);
  feed_.set_pace(wishes_.paused, wishes_.speed);
}

RunOrder LiveView::before_tick(double time) {
  while (true) {
    if (interrupted_()) return RunOrder::stop;
    take(time);
    if (reset_) return RunOrder::reset;
    const Clock::time_point now = Clock::now();
    if (wishes_.paused && steps_ == 0) {
      was_paused_ = true;
      std::this_thread::sleep_for(kNap);
      continue;
    }
    if (wishes_.paused) break;
    if (was_paused_ || wishes_.speed != speed_) {
      pace_.begin(time, wishes_.speed, now);
      was_paused_ = false;
      speed_ = wishes_.speed;
    }
    const Clock::time_point due = pace_.due(time, now);
    if (due <= now) break;
    std::this_thread::sleep_until(std::min(due, now + kLongest));
  }
  if (steps_ > 0) --steps_;
  take_control(time);
  take_walk(time);
  take_pull(time);
  return RunOrder::tick;
}

void LiveView::take(double time) {
  if (!operator_.take(wishes_)) return;
  if (wishes_.halt || !wishes_.paused) steps_ = 0;
  if (wishes_.paused) steps_ = std::min(steps_ + wishes_.steps, kMostSteps);
  reset_ = reset_ || wishes_.reset;
  for (const Push& wanted : wishes_.pushes) push(wanted, time);
  wishes_.pushes.clear();
  is_pending_ = true;
  feed_.set_pace(wishes_.paused, wishes_.speed);
}

void LiveView::push(const Push& wanted, double time) {
  Push push = wanted;
  push.time = time;
  parts_->plant.push(push);
  feed_.show_push({.force = push.force,
                   .body = push.body,
                   .until = time + push.duration,
                   .impulse = push.force.norm() * push.duration});
  keep({.time = time,
        .kind = "push",
        .text = text_of("push of %.3g N·s at ", push.force.norm() * push.duration) + push.body +
                ", force " + vector_text(push.force) + text_of(" N for %.3g s", push.duration),
        .stack = {},
        .duration = push.duration,
        .body = push.body,
        .force = push.force});
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
  const std::string text = change_text(present_.stack, wishes_.control.stack);
  is_pending_ = !text.empty() && !change_stack(wishes_.reason + text, time);
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
    text = text_of(
        "the operator commands: %s, velocity (%.3g, %.3g) m/s, yaw rate %.3g rad/s, "
        "height %+.3g m",
        walk_->walk ? "walk" : "stand", walk_->velocity.x(), walk_->velocity.y(), walk_->yaw_rate,
        walk_->height);
  }
  keep({.time = time, .kind = "walk", .text = text, .stack = {}, .body = {}});
}

void LiveView::take_pull(double time) {
  pull_impulse_ += (time - std::exchange(pulled_until_, time)) * pulled_.force;
  const bool wanted =
      wishes_.pull && Clock::now() < wishes_.pull_ends && !wishes_.pull->force.isZero();
  if (!wanted && pulled_.force.isZero()) return;
  Pull pull = wanted ? *wishes_.pull : pulled_;
  if (!wanted) pull.force.setZero();
  if (pull.body == pulled_.body && pull.point == pulled_.point && pull.force == pulled_.force) {
    return;
  }
  const bool goes_on = wanted && !pulled_.force.isZero() && pull.body == pulled_.body;
  if (wanted && !goes_on) pull_impulse_.setZero();
  pulled_ = pull;
  parts_->plant.pull(pull);
  feed_.show_push({.force = pull.force,
                   .body = pull.body,
                   .until = wanted ? kNaN : time,
                   .impulse = pull_impulse_.norm(),
                   .since = time});
  if (goes_on && time < pull_kept_ + kPullInterval) return;  // what follows the mouse is too much
  pull_kept_ = time;
  keep({.time = time,
        .kind = "pull",
        .text = wanted ? "pull at " + pull.body + ", force " + vector_text(pull.force) + " N"
                       : text_of("the pull ends after %.3g N·s", pull_impulse_.norm()),
        .stack = {},
        .body = pull.body,
        .point = pull.point,
        .force = pull.force});
}

void LiveView::keep(logged::Change change) {
  parts_->log_change(change);
  feed_.show(change);
}

UserCommand LiveView::user(const UserCommand& planned) { return walk_.value_or(planned); }

void LiveView::after_tick(const TickRecord& tick, const GroundTruth& truth,
                          const TickTiming& timing) {
  feed_.put(tick_++, tick, truth, timing);
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

}  // namespace surefoot
