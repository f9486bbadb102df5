#include "surefoot/gaits/reactions/leg_reactions.hpp"

#include "surefoot/model/leg_jacobian.hpp"

namespace surefoot {
namespace {

constexpr double kRetreatSpeed = 0.5;  // of a foot that found no ground [m/s]
constexpr double kSamePlace = 1e-3;    // [m]

/// |n · (Jᵀ)⁻¹|: of the normal force by the leg's torques.
double force_per_torque(const PointKinematics& foot, Leg leg, const Vec3& normal) {
  return (damped_inverse(leg_jacobian(foot, leg)) * normal).norm();
}

}  // namespace

LegEvent look_at(Leg k, const GaitTick& tick, Body& body) {
  const PointKinematics& foot = tick.dynamics.foot[index(k)];
  const PointKinematics& hip = tick.dynamics.hip[index(k)];
  const Vec3& normal = body.plane.normal;
  return body.legs[k].observe(tick.time, {.hip = {hip.p, hip.v, Vec3::Zero()},
                                          .foot = {foot.p, foot.v, Vec3::Zero()},
                                          .force = tick.state.foot_force[index(k)],
                                          .normal = normal,
                                          .force_per_torque = force_per_torque(foot, k, normal)});
}

std::optional<Action> react_to_leg(LegEvent event, const Situation& now, Leg k) {
  switch (event) {
    case LegEvent::none:
      return {};
    case LegEvent::touchdown:
      return on_touchdown(now, k);
    case LegEvent::caught:
      return on_caught(now, k);
    case LegEvent::unreachable:
      return on_no_ground(now, k);
    case LegEvent::lost:
      return on_lost(now, k);
    case LegEvent::flew:
      return on_flight(now, k);
  }
  return {};
}

Action on_touchdown(const Situation& now, Leg k) {
  if (now.gait.swings == k && !now.body.swing.lands_anywhere) {
    if (touches_the_edge(now, k)) return on_caught(now, k).value();
    if (now.body.swing.probes) return on_first_touch(now, k);
    if (const std::optional<Action> collision = on_collision(now, k)) return *collision;
  }
  Action action{.lands = k, .replans = true};
  action.events.add(now.event(PlanEvent::touchdown, k));
  return action;
}

// There was ground. The next step goes to another place. (A foot whose own ground is gone has no
// other: it looks for it there again.)
Action on_no_ground(const Situation& now, Leg k) {
  const Body& body = now.body;
  const Vec3& p_WF = now.foot(k);
  const Vec3& last = body.legs[k].foothold();
  const SwingTarget& target = body.legs[k].target();
  Action action{.memory = body.swing};
  action.events.add(now.event(PlanEvent::no_ground, k));
  action.memory->probes = false;
  const bool is_own_ground = target.straight && (target.start - last).norm() < kSamePlace;
  if (!is_own_ground && (target.goal - last).norm() > kSamePlace) action.avoids = target.goal;
  const double duration = body.options.gait.swing_duration + (p_WF - last).norm() / kRetreatSpeed;
  const double apex = body.options.swing.apex;
  action.swing = {.leg = k, .target = {p_WF, last, body.plane.normal, duration, apex}};
  return action;
}

Action on_lost(const Situation& now, Leg k) {
  Action action{.replans = true};
  action.events.add(now.event(PlanEvent::lost_contact, k));
  action.searches[index(k)] = true;
  if (now.gait.swings) {
    action.memory = now.body.swing;
    action.memory->probes = false;
    action.searches[index(*now.gait.swings)] = true;
  }
  if (now.gait.unloads && now.gait.unloads != k) action.reloads = now.gait.unloads;
  return action;
}

// The plane, and those that follow in its prints, must do without.
Action on_flight(const Situation& now, Leg k) {
  Action action = on_lost(now, k);
  action.forgets_print = k;
  return action;
}

}  // namespace surefoot
