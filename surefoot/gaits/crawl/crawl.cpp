#include "surefoot/gaits/crawl/crawl.hpp"

#include "surefoot/gaits/crawl/lift_off.hpp"
#include "surefoot/gaits/crawl/wider_support.hpp"
#include "surefoot/gaits/reactions/balance_margin.hpp"
#include "surefoot/gaits/reactions/leg_reactions.hpp"
#include "surefoot/gaits/reactions/push_reactions.hpp"
#include "surefoot/math/numbers.hpp"

#include <algorithm>
#include <cassert>

namespace surefoot {
namespace {

constexpr double kGrace = 0.04;  // a touchdown this late is still on time [s]
constexpr double kLate = 0.10;   // … and this late worth telling: noticing one takes 50 ms [s]
constexpr double kWaitDuration = 0.8;  // how far ahead the COM is planned while a foot searches [s]
constexpr double kOnTime = 0.05;       // a lift-off later than this needs a new COM plan [s]
constexpr double kLiftOffPatience = 0.3;  // before a lift-off is given up [s]
constexpr double kTiltGivenUp = 20.0;     // more of a shortfall than on all feet [rad/s²]
constexpr double kShortestPlan = 0.08;    // left of a phase that a new plan can use [s]

}  // namespace

Crawl::Crawl(const PlannerOptions& options) : steps_(options.gait, options.probe) {}

void Crawl::go(CrawlCause cause) {
  const CrawlTransition* way = find_transition(state_, cause);
  assert(way != nullptr);
  if (way != nullptr) state_ = way->to;
}

void Crawl::begin(const GaitTick& tick, Body& body, const std::optional<Action>& first) noexcept {
  if (first) return act(first, tick, body);
  go(CrawlCause::walks);
  begin_support(tick, body.options.gait.start_duration);
  plan_com(tick, body);
}

void Crawl::observe(const GaitTick& tick, Body& body) noexcept {
  for (const Leg k : kLegs) {
    const LegEvent event = look_at(k, tick, body);
    act(react_to_leg(event, see(tick, body), k), tick, body);
  }
}

GaitOutcome Crawl::advance(const GaitTick& tick, Body& body) noexcept {
  if (body.observe_grip(tick)) act(on_slip(see(tick, body)), tick, body);
  react_to_push(tick, body);
  switch (state_) {
    case CrawlState::stand:
      return {};
    case CrawlState::shift:
      return advance_shift(tick, body);
    case CrawlState::unload:
      return advance_unload(tick, body);
    case CrawlState::swing:
      return advance_swing(tick, body);
  }
  return {};
}

bool Crawl::waits(const Body& body) const {
  return state_ != CrawlState::swing && (!body.legs.all_down() || recovers_);
}

bool Crawl::has_lost(const Body& body) const {
  return std::ranges::any_of(kLegs, [&](Leg k) {
    const bool swings = state_ == CrawlState::swing && k == steps_.next();
    return !swings && !body.legs[k].down();
  });
}

Situation Crawl::see(const GaitTick& tick, const Body& body) const {
  Situation now{tick, body, {}};
  if (state_ == CrawlState::swing) now.gait.swings = steps_.next();
  if (state_ == CrawlState::unload) now.gait.unloads = steps_.next();
  now.gait.lands_at = deadline_;
  now.gait.support_duration = steps_.support_duration(body.pace());
  return now;
}

void Crawl::act(const std::optional<Action>& action, const GaitTick& tick, Body& body) {
  if (!action) return;
  carry_out(*action, tick, body);
  if (action->recovers) recovers_ = *action->recovers;
  change_state(*action, tick, body);
  if (action->support) begin_support(tick, *action->support);
  if (action->swing && !action->swing->keeps_deadline) {
    expect_touchdown(tick.time, action->swing->target.duration);
    plan_com(tick, body);
  }
  if (action->replans) plan_com(tick, body);
}

void Crawl::change_state(const Action& action, const GaitTick& tick, Body& body) {
  const Leg next = steps_.next();
  if (action.steps_out_of_turn) {
    go(CrawlCause::steps_to_recover);
    steps_.go_on_with(action.swing->leg);
  } else if (state_ == CrawlState::swing && action.lands == next) {
    go(CrawlCause::lands);
    ++body.steps_taken;
    steps_.advance();
    begin_support(tick, steps_.support_duration(body.pace()));
  } else if (state_ == CrawlState::swing && action.swing && action.swing->leg == next) {
    go(CrawlCause::goes_on_swinging);
  } else if (state_ == CrawlState::unload && body.legs[next].phase() != LegPhase::unloading) {
    go(CrawlCause::reloads);
  } else if (action.recovers == false) {
    go(CrawlCause::goes_on);
  }
}

void Crawl::begin_support(const GaitTick& tick, double duration) {
  steps_.set_backward(tick.user.velocity.x() < 0.0);
  lift_time_ = tick.time + duration;
}

void Crawl::expect_touchdown(double time, double duration) {
  deadline_ = time + duration;
  late_time_ = deadline_ + kLate;
}

void Crawl::react_to_push(const GaitTick& tick, Body& body) {
  body.balance.update(tick.state, tick.dynamics, body.com_height(tick.dynamics));
  if (recovers_ && state_ != CrawlState::swing) act(go_on_if_calm(see(tick, body)), tick, body);
  if (!body.options.push.enabled) return;
  if (state_ == CrawlState::swing) {
    act(land_if_tipping(see(tick, body)), tick, body);
  } else {
    act(reload_if_pushed(see(tick, body)), tick, body);
    act(step_to_recover(see(tick, body)), tick, body);
  }
  const double left = (state_ == CrawlState::swing ? deadline_ : lift_time_) - tick.time;
  if (body.wants_plan(tick) && left > kShortestPlan) plan_com(tick, body);
}

GaitOutcome Crawl::advance_shift(const GaitTick& tick, Body& body) {
  if (waits(body)) {
    lift_time_ = std::max(lift_time_, tick.time + steps_.support_duration(body.pace()));
    return {};
  }
  if (!tick.user.walk) {
    go(CrawlCause::stops);
    return {.hands_over = true};
  }
  if (tick.time < lift_time_ - body.options.force.ramp_down) return {};
  if (const std::optional<Leg> first = leg_for_wider_support(tick, body, steps_)) {
    body.events.add({.kind = PlanEvent::support_widened, .leg = first});
    go(CrawlCause::another_goes_first);
    begin_support(tick, body.pace() * body.options.gait.start_duration);
    steps_.go_on_with(*first);
    plan_com(tick, body);
    return {};
  }
  tilt_shortfall_on_four_ = tick.last.tilt_shortfall;
  go(CrawlCause::unloads);
  body.legs[steps_.next()].unload(lift_time_);
  return {};
}

GaitOutcome Crawl::advance_unload(const GaitTick& tick, Body& body) {
  const Leg next = steps_.next();
  const bool holds =
      !(tick.last.tilt_shortfall > tilt_shortfall_on_four_ + kTiltGivenUp);  // nor if NaN
  if (holds && tick.time < lift_time_) return {};
  const bool unloaded = body.legs[next].unloaded() || !body.options.force.ramps;
  if (holds && unloaded && is_balanced_without(next, body, tick.dynamics)) {
    lift_off(tick, body);
    return {.begins_step = true};
  }
  if (!holds || tick.time > lift_time_ + kLiftOffPatience) abort_lift_off(tick, body);
  return {};
}

GaitOutcome Crawl::advance_swing(const GaitTick& tick, Body& body) {
  const Leg leg = steps_.next();
  act(reach_beyond_edge(see(tick, body), leg), tick, body);
  if (tick.time >= late_time_) {
    body.events.add(see(tick, body).event(PlanEvent::late, leg));
    late_time_ = kInfinity;
  }
  if (tick.time >= deadline_ + kGrace) {
    deadline_ = tick.time + kWaitDuration;
    plan_com(tick, body);
  }
  return {};
}

void Crawl::lift_off(const GaitTick& tick, Body& body) {
  const Leg k = steps_.next();
  body.events.add(see(tick, body).event(PlanEvent::lift_off, k));
  go(CrawlCause::lifts_off);
  const LiftOff begun = plan_lift_off(k, tick, body, steps_.cycle_duration(body.pace()));
  body.swing = begun.memory;
  body.legs[k].lift(tick.time, begun.target);
  const bool on_time = tick.time - lift_time_ < kOnTime;
  expect_touchdown(tick.time, steps_.swing_duration(body.pace(), k));
  if (!on_time) plan_com(tick, body);
}

void Crawl::abort_lift_off(const GaitTick& tick, Body& body) {
  Action action{
      .reloads = steps_.next(), .support = body.options.gait.switch_duration, .replans = true};
  action.events.add(see(tick, body).event(PlanEvent::lift_off_aborted, steps_.next()));
  act(action, tick, body);
}

}  // namespace surefoot
