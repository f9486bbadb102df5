#include "surefoot/gaits/reactions/push_reactions.hpp"

#include "surefoot/gaits/parts/capture_step.hpp"

#include <utility>

namespace surefoot::gaits {
namespace {

constexpr double kMinGain = 0.01;          // of the balance margin by a step [m]
constexpr double kMaxAcceleration = 45.0;  // of a swing foot, by its drives [m/s²]
constexpr double kRestSpeed = 0.06;        // of the COM [m/s]
constexpr double kFootRoom = 0.12;         // least distance between two feet [m]
constexpr double kSlowDownFactor = 1.1;    // per iteration, on a swing's duration
constexpr double kMaxSlowDown = 2.0;       // about the largest factor on a swing's duration

/// Region of all feet at their present places, in contact or not, except one.
SupportRegion region_of_feet(const Situation& now, std::optional<Leg> without = {}) {
  PerLeg<double> share = per_leg(1.0, now.num_legs());
  if (without) share[index(*without)] = 0.0;
  return SupportRegion(now.feet(), share);
}

/// Margin of the capture point in the region of all feet [m].
double balance_margin(const Situation& now) {
  return region_of_feet(now).margin(now.body.balance.capture_point());
}

/// Capture step of a foot that lands after `duration` [s].
CaptureStep capture_step(const Situation& now, Leg k, double duration) {
  const Body& body = now.body;
  CaptureProblem problem;
  problem.heading = now.yaw;
  problem.foot_room = body.scale.length * kFootRoom;
  problem.feet = now.feet();
  if (!body.legs[k].down())  // prefers goals near where a foot in the air would come to rest
    problem.feet[index(k)] += 0.5 * duration * now.before.feet[index(k)].v_WF.head<2>();
  problem.capture_point = body.balance.capture_point_after(region_of_feet(now, k), duration);
  problem.hip = (now.dynamics.hip[index(k)].p + duration * now.dynamics.com.v).head<2>();
  problem.reach = horizontal_reach(body.options.swing, hip_height(body.options.stance, body.scale));
  return find_capture_step(problem, k, body.options.push);
}

/// Extends a swing until the drives can follow it. `aim` sets its goal.
template <typename Aim>
void slow_down(SwingTarget& target, const Body& body, const Aim& aim) {
  const double longest = kMaxSlowDown * target.duration;
  const auto is_feasible = [&] {
    return SwingCurve(target, body.options.swing, body.scale).peak_acceleration() <
           kMaxAcceleration;
  };
  for (aim(); !is_feasible() && target.duration < longest; aim())
    target.duration *= kSlowDownFactor;
}

/// An event of a leg, with the horizontal external force.
GaitEvent push_event(const Situation& now, PlanEvent kind, Leg k) {
  GaitEvent event = now.event(kind, k);
  event.force = now.state.external_force.head<2>().norm();
  return event;
}

/// Will the balance be lost before the planned touchdown of the swing foot?
bool tips_before_landing(const Situation& now, Leg swings) {
  const PushOptions& push = now.body.options.push;
  if (now.body.legs[swings].target().straight) return false;  // it already comes down
  const double left = now.gait.lands_at - now.time;
  if (left < push.foot_down_duration) return false;  // it lands as soon as it can
  const PushBalance& balance = now.body.balance;
  const Vec2 out = balance.excess(region_of_feet(now, swings));
  return out.norm() * balance.growth(left) > push.foot_down_excess;
}

/// The capture step with the best margin, and its leg; none while a foot's force ramps up.
std::optional<std::pair<Leg, CaptureStep>> best_step(const Situation& now) {
  std::pair<Leg, CaptureStep> best{Leg::LF, {}};
  for (const Leg k : now.body.legs.all()) {
    if (now.body.legs[k].since(now.time) < now.body.options.force.ramp_up) return {};
    const CaptureStep found = capture_step(now, k, now.body.options.push.step_duration);
    if (found.margin > best.second.margin) best = {k, found};
  }
  return best;
}

/// Puts the swing foot down at once, at its capture step. Adds no event.
Action put_foot_down(const Situation& now, Leg k) {
  const Body& body = now.body;
  const FootPlan& plan = now.before.feet[index(k)];  // continues this motion
  SwingTarget target{.start = plan.p_WF + body.period * plan.v_WF,
                     .normal = body.plane.normal,
                     .duration = body.options.push.foot_down_duration,
                     .straight = true,
                     .velocity = plan.v_WF};
  slow_down(target, body, [&] {
    target.goal.head<2>() = capture_step(now, k, target.duration).goal;
    target.goal.z() = body.plane.height(target.goal.head<2>());
  });
  Action action{.memory = body.swing, .swing = SwingOrder{k, target}, .recovers = true};
  action.memory->probes = false;
  action.memory->lands_anywhere = true;
  return action;
}

}  // namespace

bool is_balanced_without(Leg leg, const Situation& now) {
  const PushBalance& balance = now.body.balance;
  const double margin = region_of_feet(now, leg).margin(balance.capture_point());
  return margin > now.body.options.push.lift_off_margin && balance.is_steady();
}

std::optional<Action> land_if_tipping(const Situation& now) {
  if (!now.gait.swings || now.body.legs[*now.gait.swings].phase() != LegPhase::swing) return {};
  if (!tips_before_landing(now, *now.gait.swings)) return {};
  Action action = put_foot_down(now, *now.gait.swings);
  action.events.add(push_event(now, PlanEvent::push_foot_down, *now.gait.swings));
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
  const Body& body = now.body;
  const PushOptions& push = body.options.push;
  const PushBalance& balance = body.balance;
  if (!push.steps || !balance.is_pushed() || !body.legs.all_down()) return {};
  const double margin = balance_margin(now);
  if (margin > push.step_margin) return {};
  const auto best = best_step(now);
  if (!best) return {};
  const auto& [k, step] = *best;
  const double without = margin < 0.0 ? balance.growth(push.step_duration) * margin : margin;
  if (step.margin < without + body.scale.length * kMinGain) return {};
  SwingTarget target{now.foot(k), Vec3::Zero(), body.plane.normal, push.step_duration,
                     push.step_apex};
  target.goal << step.goal, body.plane.height(step.goal);
  slow_down(target, body, [] {});
  Action action{.memory = body.swing.for_new_swing(),
                .swing = SwingOrder{k, target},
                .steps_out_of_turn = true,
                .recovers = true};
  action.memory->lands_anywhere = true;
  action.events.add(push_event(now, PlanEvent::push_step, k));
  if (now.gait.unloads && now.gait.unloads != k) action.reloads = now.gait.unloads;
  return action;
}

std::optional<Action> go_on_if_calm(const Situation& now) {
  const Body& body = now.body;
  const bool is_calm = body.legs.all_down() && body.balance.is_steady() &&
                       now.dynamics.com.v.head<2>().norm() < body.scale.speed() * kRestSpeed &&
                       balance_margin(now) > body.options.push.calm_margin;
  if (!is_calm) return {};
  return Action{.support = body.options.gait.switch_duration, .recovers = false, .replans = true};
}

// The foothold has moved, and a sliding foot gives little support.
std::optional<Action> on_slip(const Situation& now) {
  Action action;
  if (now.body.grip.began() && now.gait.unloads) {
    action.reloads = now.gait.unloads;
    action.support = now.gait.support_duration;
  } else if (now.body.grip.began() && now.gait.swings) {
    const Leg k = *now.gait.swings;
    const bool flies = now.body.legs[k].phase() == LegPhase::swing;
    if (flies && !is_balanced_without(k, now)) action = put_foot_down(now, k);
  }
  for (const Leg k : now.body.legs.all()) {
    if (now.body.grip.began(k)) action.events.add(now.event(PlanEvent::slip, k));
  }
  action.replans = true;
  return action;
}

}  // namespace surefoot::gaits
