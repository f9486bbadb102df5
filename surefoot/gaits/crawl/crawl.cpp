#include "surefoot/gaits/crawl/crawl.hpp"

#include "surefoot/gaits/com_horizon.hpp"
#include "surefoot/gaits/reactions/leg_reactions.hpp"
#include "surefoot/gaits/reactions/push_reactions.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cassert>

namespace surefoot::gaits {
namespace {

constexpr double kTouchdownTolerance = 0.04;  // a touchdown this late needs no new plan [s]
constexpr double kReportedLateness = 0.10;    // of a touchdown, whose detection takes 50 ms [s]
constexpr double kWaitDuration = 0.8;         // assumed rest of a search, for the COM plan [s]
constexpr double kLiftOffTolerance = 0.05;    // a lift-off this late needs no new plan [s]
constexpr double kLiftOffTimeout = 0.3;       // until a lift-off is aborted [s]
constexpr double kMaxShortfallRise = 20.0;    // of the tilt since all feet were loaded [rad/s²]
constexpr double kMinReplanTime = 0.08;       // left in a phase for a new plan [s]
constexpr double kRecoveryDuration = 0.6;     // of a COM plan to rest after a push [s]

}  // namespace

void Crawl::transition(CrawlCause cause) {
  const CrawlTransition* row = find_transition(state_, cause);
  assert(row != nullptr);
  if (row != nullptr) state_ = row->to;
}

void Crawl::begin(Situation& now, Body& body, const std::optional<Action>& first) {
  if (first) return act(*first, now, body);
  transition(CrawlCause::walks);
  begin_support(now, body.options.gait.start_duration);
  plan_com(now, body);
}

bool Crawl::waits(const Body& body) const {
  return state_ != CrawlState::swing && (!body.legs.all_down() || recovers_);
}

bool Crawl::has_lost_contact(const Body& body) const {
  return std::ranges::any_of(body.legs.all(), [&](Leg k) {
    const bool swings = state_ == CrawlState::swing && k == steps_.next();
    return !swings && !body.legs[k].down();
  });
}

GaitStatus Crawl::status(const Body& body) const {
  GaitStatus result{.lands_at = deadline_,
                    .support_duration = steps_.support_duration(body.pace())};
  if (state_ == CrawlState::swing) result.swings = steps_.next();
  if (state_ == CrawlState::unload) result.unloads = steps_.next();
  return result;
}

void Crawl::follow(const Action& action, const Situation& now, Body& body) {
  if (action.recovers) recovers_ = *action.recovers;
  change_state(action, now, body);
  if (action.support) begin_support(now, *action.support);
  if (action.swing && !action.swing->keeps_deadline)
    expect_touchdown(now, action.swing->target.duration);
}

void Crawl::change_state(const Action& action, const Situation& now, Body& body) {
  const Leg next = steps_.next();
  if (action.steps_out_of_turn) {
    transition(CrawlCause::steps_to_recover);
    steps_.go_on_with(action.swing->leg);
  } else if (state_ == CrawlState::swing && action.lands == next) {
    transition(CrawlCause::lands);
    ++body.steps_taken;
    steps_.advance();
    begin_support(now, steps_.support_duration(body.pace()));
  } else if (state_ == CrawlState::swing && action.swing && action.swing->leg == next) {
    transition(CrawlCause::goes_on_swinging);
  } else if (state_ == CrawlState::unload && body.legs[next].phase() != LegPhase::unloading) {
    transition(CrawlCause::reloads);
  } else if (action.recovers == false) {
    transition(CrawlCause::goes_on);
  }
}

void Crawl::begin_support(const Situation& now, double duration) {
  steps_.set_backward(now.user.velocity.x() < 0.0);
  lift_time_ = now.time + duration;
}

void Crawl::expect_touchdown(const Situation& now, double duration) {
  deadline_ = now.time + duration;
  late_time_ = deadline_ + now.body.scale.time() * kReportedLateness;
}

GaitOutcome Crawl::go_on(Situation& now, Body& body) {
  react_to_push(now, body);
  switch (state_) {
    case CrawlState::stand:
      return {};
    case CrawlState::shift:
      return go_on_shifting(now, body);
    case CrawlState::unload:
      return go_on_unloading(now, body);
    case CrawlState::swing:
      return go_on_swinging(now, body);
  }
  return {};
}

void Crawl::react_to_push(Situation& now, Body& body) {
  if (recovers_ && state_ != CrawlState::swing) react(go_on_if_calm, now, body);
  if (!body.options.push.enabled) return;
  if (state_ == CrawlState::swing) {
    react(land_if_tipping, now, body);
  } else {
    react(reload_if_pushed, now, body);
    react(step_to_recover, now, body);
  }
  const double left = (state_ == CrawlState::swing ? deadline_ : lift_time_) - now.time;
  if (wants_plan(now) && left > body.scale.time() * kMinReplanTime) plan_com(now, body);
}

GaitOutcome Crawl::go_on_shifting(const Situation& now, Body& body) {
  if (waits(body)) {
    lift_time_ = std::max(lift_time_, now.time + steps_.support_duration(body.pace()));
    return {};
  }
  if (!now.user.walk || now.yields) {
    transition(CrawlCause::stops);
    return {.hands_over = true};
  }
  if (now.time < lift_time_ - body.options.force.ramp_down) return {};
  if (const std::optional<Leg> first = leg_for_wider_support(now, steps_)) {
    body.events.add({.kind = PlanEvent::support_widened, .leg = first});
    transition(CrawlCause::another_goes_first);
    begin_support(now, body.pace() * body.options.gait.start_duration);
    steps_.go_on_with(*first);
    plan_com(now, body);
    return {};
  }
  initial_tilt_shortfall_ = now.last.tilt_shortfall;
  transition(CrawlCause::unloads);
  body.legs[steps_.next()].unload(lift_time_);
  return {};
}

GaitOutcome Crawl::go_on_unloading(Situation& now, Body& body) {
  const Leg next = steps_.next();
  const double most = initial_tilt_shortfall_ + kMaxShortfallRise / body.scale.length;
  const bool holds = !(now.last.tilt_shortfall > most);  // nor if NaN
  if (holds && now.time < lift_time_) return {};
  const bool unloaded = body.legs[next].unloaded() || !body.options.force.ramps;
  if (holds && unloaded && is_balanced_without(next, now)) {
    lift_off(now, body);
    return {.begins_step = true};
  }
  if (!holds || now.time > lift_time_ + body.scale.time() * kLiftOffTimeout)
    react(abort_lift_off, now, body);
  return {};
}

GaitOutcome Crawl::go_on_swinging(Situation& now, Body& body) {
  react(reach_beyond_edge, now, body);
  if (now.time >= late_time_) {
    body.events.add(now.event(PlanEvent::late, steps_.next()));
    late_time_ = kNever;
  }
  if (now.time >= deadline_ + body.scale.time() * kTouchdownTolerance) {
    deadline_ = now.time + body.scale.time() * kWaitDuration;
    plan_com(now, body);
  }
  return {};
}

void Crawl::lift_off(const Situation& now, Body& body) {
  const Leg k = steps_.next();
  transition(CrawlCause::lifts_off);
  begin_swing(k, now, body, steps_.cycle_duration(body.pace()));
  const bool on_time = now.time - lift_time_ < body.scale.time() * kLiftOffTolerance;
  expect_touchdown(now, steps_.swing_duration(body.pace(), k));
  if (!on_time) plan_com(now, body);
}

// Phases: the rest of the present one, then support and swing alternate over the horizon.
void Crawl::plan_com(const Situation& now, Body& body) {
  ComHorizon ahead(now, recovers_);
  const bool swings = state_ == CrawlState::swing;
  if (swings) ahead.add(std::max(deadline_ - now.time, body.period), true);
  for (const Leg k : body.legs.all()) {
    const bool is_next = swings && k == steps_.next();
    if (!ahead.is_down(k)) ahead.land(k, is_next ? body.legs[k].target().goal : now.foot(k));
  }
  if (recovers_) return ahead.come_to_rest(body, kRecoveryDuration, true);
  if (!now.user.walk || has_lost_contact(body)) return ahead.come_to_rest(body);
  const double pace = body.pace(), cycle = steps_.cycle_duration(pace);
  for (int step = swings ? 1 : 0; step < body.options.com.horizon_steps; ++step) {
    const Leg k = steps_.next(step);
    const double support = step == 0 ? std::max(lift_time_ - now.time, body.period)
                                     : steps_.support_duration(pace, step);
    ahead.add_support_until_lift_off(k, support);
    ahead.add(steps_.swing_duration(pace, k), true);
    ahead.land(k, body.footholds.foothold(k, ahead.feet(), body.plane, now.yaw, now.user, cycle));
  }
  ahead.add(steps_.support_duration(pace, body.options.com.horizon_steps), false);
  ahead.plan(body, rotation_about_z(now.yaw).topLeftCorner<2, 2>() * now.user.velocity);
}

}  // namespace surefoot::gaits
