#include "surefoot/gaits/reactions/push_reactions.hpp"

#include "surefoot/gaits/parts/capture_step.hpp"
#include "surefoot/gaits/parts/reach.hpp"
#include "surefoot/gaits/reactions/balance_margin.hpp"

#include <cmath>
#include <tuple>
#include <utility>

namespace surefoot {
namespace {

constexpr double kWorthAStep = 0.01;  // better balanced with it than without by [m]
constexpr double kAgility = 45.0;     // that drives give a foot in the air [m/s²]
constexpr double kAtRest = 0.06;      // a COM that is slower has been caught [m/s]
constexpr double kLonger = 1.1;       // a hasty swing takes so many times as long …
constexpr double kLongest = 2.0;      // … and again, up to about so many times, for its drives

/// Can the drives move a foot like that?
bool is_agile(const SwingTarget& target, const SwingOptions& options) {
  return SwingCurve(target, options).peak_acceleration() < kAgility;
}

/// Where a foot that lands after a time catches the robot.
CaptureStep capture_step(const Situation& now, Leg k, double duration) {
  const auto& [tick, body, gait] = now;
  const SupportRegion others = region_without(k, tick.dynamics);
  CaptureProblem problem;
  problem.heading = tick.yaw;
  for (const Leg other : kLegs) problem.feet[index(other)] = now.foot(other).head<2>();
  if (!body.legs[k].down())  // its speed takes it on: the least turn is from where it would rest
    problem.feet[index(k)] += 0.5 * duration * tick.before.feet[index(k)].v_WF.head<2>();
  problem.capture_point = body.balance.capture_point_after(others, duration);
  problem.hip = (tick.dynamics.hip[index(k)].p + duration * tick.dynamics.com.v).head<2>();
  problem.reach = horizontal_reach(body.options.swing, body.options.stance.height);
  return find_capture_step(problem, k, body.options.push);
}

/// Of a leg and the robot that it is to catch: where it is pushed to, and how hard.
GaitEvent push_event(const Situation& now, PlanEvent kind, Leg k) {
  GaitEvent event = now.event(kind, k);
  event.force = now.tick.state.external_force.head<2>().norm();
  return event;
}

/// Will the balance be lost before the swinging foot lands by itself?
bool tips_before_landing(const Situation& now, Leg swings) {
  const PushOptions& push = now.body.options.push;
  if (now.body.legs[swings].target().straight) return false;  // it is on its way down
  const double left = now.gait.lands_at - now.tick.time;
  if (left < push.foot_down_duration) return false;  // it lands as soon as it can
  const PushBalance& balance = now.body.balance;
  const Vec2 out = balance.excess(region_without(swings, now.tick.dynamics));
  return out.norm() * balance.growth(left) > push.foot_down_excess;
}

/// The foot after which the robot is balanced best, and its step; none if one has only just come
/// down.
std::optional<std::pair<Leg, CaptureStep>> best_step(const Situation& now) {
  std::pair<Leg, CaptureStep> best{Leg::LF, {}};
  for (const Leg k : kLegs) {
    if (now.body.legs[k].since(now.tick.time) < now.body.options.force.ramp_up) return {};
    const CaptureStep found = capture_step(now, k, now.body.options.push.step_duration);
    if (found.margin > best.second.margin) best = {k, found};
  }
  return best;
}

}  // namespace

std::optional<Action> land_if_tipping(const Situation& now) {
  if (!now.gait.swings || now.body.legs[*now.gait.swings].phase() != LegPhase::swing) return {};
  if (!tips_before_landing(now, *now.gait.swings)) return {};
  Action action = put_foot_down(now, *now.gait.swings);
  action.events.add(push_event(now, PlanEvent::push_foot_down, *now.gait.swings));
  return action;
}

Action put_foot_down(const Situation& now, Leg k) {
  const auto& [tick, body, gait] = now;
  Action action{.memory = body.swing, .recovers = true};
  action.memory->probes = false;
  action.memory->lands_anywhere = true;
  const FootPlan& plan = tick.before.feet[index(k)];  // goes on from here: the foot has its speed
  SwingTarget target{.start = plan.p_WF + body.period * plan.v_WF,
                     .normal = body.plane.normal,
                     .duration = body.options.push.foot_down_duration,
                     .straight = true,
                     .velocity = plan.v_WF};
  const auto aim = [&] {
    target.goal.head<2>() = capture_step(now, k, target.duration).goal;
    target.goal.z() = body.plane.height(target.goal.head<2>());
  };
  const double longest = kLongest * target.duration;
  const SwingOptions& swing = body.options.swing;
  for (aim(); !is_agile(target, swing) && target.duration < longest; aim())
    target.duration *= kLonger;
  action.swing = {.leg = k, .target = target};
  return action;
}

std::optional<Action> reload_if_pushed(const Situation& now) {
  if (!now.gait.unloads || now.body.balance.is_steady()) return {};
  Action action{.reloads = now.gait.unloads,
                .support = now.body.options.gait.switch_duration,
                .recovers = true,
                .replans = true};
  action.events.add(push_event(now, PlanEvent::push_reloaded, *now.gait.unloads));
  return action;
}

std::optional<Action> step_to_recover(const Situation& now) {
  const auto& [tick, body, gait] = now;
  const PushOptions& push = body.options.push;
  const PushBalance& balance = body.balance;
  if (!push.steps || !balance.is_pushed() || !body.legs.all_down()) return {};
  const double margin = balance_margin(body, tick.dynamics);
  if (margin > push.step_margin) return {};
  const auto best = best_step(now);
  if (!best) return {};
  const auto& [k, step] = *best;
  const double without = margin < 0.0 ? balance.growth(push.step_duration) * margin : margin;
  if (step.margin < without + kWorthAStep) return {};
  Action action{.memory = body.swing.begun(), .steps_out_of_turn = true, .recovers = true};
  action.memory->lands_anywhere = true;
  action.events.add(push_event(now, PlanEvent::push_step, k));
  if (gait.unloads && gait.unloads != k) action.reloads = gait.unloads;
  Vec3 goal;
  goal << step.goal, body.plane.height(step.goal);
  SwingTarget target{now.foot(k), goal, body.plane.normal, push.step_duration, push.step_apex};
  const double longest = kLongest * target.duration;
  while (!is_agile(target, body.options.swing) && target.duration < longest)
    target.duration *= kLonger;
  action.swing = {.leg = k, .target = target};
  return action;
}

std::optional<Action> go_on_if_calm(const Situation& now) {
  const auto& [tick, body, gait] = now;
  const bool is_calm = body.legs.all_down() && body.balance.is_steady() &&
                       tick.dynamics.com.v.head<2>().norm() < kAtRest &&
                       balance_margin(body, tick.dynamics) > body.options.push.calm_margin;
  if (!is_calm) return {};
  return Action{.support = body.options.gait.switch_duration, .recovers = false, .replans = true};
}

// A foot that slid stands elsewhere, and while it slides the others must do without it.
Action on_slip(const Situation& now) {
  Action action;
  if (now.body.grip.began() && now.gait.unloads) {
    action.reloads = now.gait.unloads;
    action.support = now.gait.support_duration;
  } else if (now.body.grip.began() && now.gait.swings) {
    const Leg k = *now.gait.swings;
    const bool flies = now.body.legs[k].phase() == LegPhase::swing;
    if (flies && !is_balanced_without(k, now.body, now.tick.dynamics))
      action = put_foot_down(now, k);
  }
  for (const Leg k : kLegs) {
    if (now.body.grip.began(k)) action.events.add(now.event(PlanEvent::slip, k));
  }
  action.replans = true;
  return action;
}

}  // namespace surefoot
