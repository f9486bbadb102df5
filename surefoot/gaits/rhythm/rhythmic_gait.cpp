#include "surefoot/gaits/rhythm/rhythmic_gait.hpp"

#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {

void RhythmicGait::begin(Situation& now, Body& body, const std::optional<Action>& first) {
  clock_.start(body.options.force.ramp_down);
  com_.start(now.dynamics.com.p.head<2>(), now.dynamics.com.v.head<2>());
  waited_ = 0.0;
  stops_ = false;
  if (first) act(*first, now, body);
}

double RhythmicGait::stride_duration(double) const {
  return options_.period * *std::ranges::max_element(options_.duty);
}

// A foot without ground goes on searching until its next lift-off.
std::optional<Action> RhythmicGait::answer(LegEvent event, const Situation& now, Leg k) const {
  switch (event) {
    case LegEvent::touchdown:
      return Action{.events = now.event_list(PlanEvent::touchdown, k), .lands = k};
    case LegEvent::lost:
    case LegEvent::airborne: {
      Action action{.events = now.event_list(PlanEvent::lost_contact, k)};
      if (event == LegEvent::airborne) action.forgets_print = k;
      action.searches[index(k)] = true;
      return action;
    }
    default:
      return {};
  }
}

void RhythmicGait::follow(const Action& action, const Situation&, Body& body) {
  if (action.lands) ++body.steps_taken;
}

GaitOutcome RhythmicGait::go_on(Situation& now, Body& body) {
  drive_com(now);
  stops_ = !now.user.walk && (stops_ || is_slow(now));
  if (stops_ && body.legs.all_down()) return {.hands_over = true};
  advance_clock(body);
  for (const Leg k : body.legs.all()) move_leg(k, now, body);
  return {.begins_step =
              std::ranges::any_of(body.legs.all(), [&](Leg k) { return clock_.lifts(k); })};
}

void RhythmicGait::drive_com(const Situation& now) {
  const Mat2 R = rotation_about_z(now.yaw).topLeftCorner<2, 2>();
  const Vec2 velocity = now.user.walk ? Vec2(R * now.user.velocity) : Vec2::Zero();
  const double yaw_rate = now.user.walk ? now.user.yaw_rate : 0.0;
  com_.update(velocity, yaw_rate, options_.acceleration, options_.leash,
              now.dynamics.com.p.head<2>(), now.body.period);
}

bool RhythmicGait::is_slow(const Situation& now) const {
  return com_.plan().v.norm() < options_.stop_speed &&
         now.dynamics.com.v.head<2>().norm() < 2.0 * options_.stop_speed;
}

bool RhythmicGait::misses_foot(const Body& body) const {
  const double ramp = body.options.force.ramp_down + body.period;
  double next = kNever;  // lift-off, where one is near
  for (const Leg k : body.legs.all()) {
    const double lifts = clock_.until_lift_off(k);
    if (body.legs[k].down() && lifts <= ramp) next = std::min(next, lifts);
  }
  return std::ranges::any_of(body.legs.all(), [&](Leg k) {
    return !body.legs[k].down() && next < kNever && clock_.until_landing(k) <= next;
  });
}

void RhythmicGait::advance_clock(const Body& body) {
  const bool misses = misses_foot(body), waits = misses && waited_ < options_.wait;
  waited_ = misses ? waited_ + body.period : 0.0;
  clock_.advance(waits ? 0.0 : body.period);
}

void RhythmicGait::move_leg(Leg k, const Situation& now, Body& body) {
  LegMotion& leg = body.legs[k];
  const double until_lift_off = clock_.until_lift_off(k);
  if (clock_.lifts(k) && !stops_) {
    lift(k, now, body);
  } else if (leg.down() && !clock_.swings(k) && !stops_ &&
             until_lift_off < body.options.force.ramp_down) {
    leg.unload(now.time + until_lift_off);
  } else if (leg.phase() == LegPhase::unloading && stops_) {
    leg.reload(now.time);
  } else if (leg.phase() == LegPhase::swing) {
    leg.aim(now.time, foothold(k, leg.target().duration - leg.since(now.time), now));
  }
}

void RhythmicGait::lift(Leg k, const Situation& now, Body& body) {
  const double duration = clock_.swing_duration(k);
  body.events.add(now.event(PlanEvent::lift_off, k));
  body.legs[k].lift(now.time, {.start = now.foot(k),
                               .goal = foothold(k, duration, now),
                               .normal = body.plane.normal,
                               .duration = duration,
                               .apex = body.options.swing.apex});
}

// A pendulum over its feet goes slowest in the middle of a stance of duration T:
//
//     v(t) = v_cmd (ω T/2) / sinh(ω T/2) cosh(ω (T/2 − t))        t before the next landing
//
// and the middle of its next stance is v_cmd T/2 ahead of where it is then. What it is faster than
// this moves the foothold on, and so does the centripetal acceleration a of a turn:
//
//     p = c + t v + v_cmd T/2 + R(ψ) offset + capture (v − v(t)) / ω − a / ω²
//
// with ω² = g / h and the heading ψ in the middle of the next stance.
Vec3 RhythmicGait::foothold(Leg k, double until_landing, const Situation& now) const {
  const Body& body = now.body;
  const double w = std::sqrt(kGravity / body.com_height(now.dynamics));
  const double half = 0.5 * clock_.stance_duration(k);
  const double t = std::clamp(until_landing, 0.0, 2.0 * half);
  const double pace = w * half / std::sinh(w * half) * std::cosh(w * (half - t));
  const double yaw_rate = now.user.walk ? now.user.yaw_rate : 0.0;
  const Mat2 R = rotation_about_z(now.yaw + yaw_rate * (t + half)).topLeftCorner<2, 2>();
  const Vec2 v = now.dynamics.com.v.head<2>(), wanted = com_.plan().v;
  const Vec2 centripetal = yaw_rate * Vec2(-wanted.y(), wanted.x());
  const Vec2 place = now.dynamics.com.p.head<2>() + t * v + half * wanted +
                     R * nominal_offset(body.options.stance, k, now.num_legs()) +
                     options_.capture / w * (v - pace * wanted) - centripetal / (w * w);
  Vec3 result;
  result << place, body.plane.height(place);
  return result;
}

}  // namespace surefoot::gaits
