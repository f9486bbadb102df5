#include "surefoot/gaits/gait.hpp"

#include "surefoot/gaits/reactions/leg_reactions.hpp"
#include "surefoot/gaits/reactions/push_reactions.hpp"
#include "surefoot/model/leg_jacobian.hpp"

namespace surefoot::gaits {
namespace {

constexpr double kMaxComError = 0.01;  // of the COM from its plan [m]

LegEvent observe_leg(Leg k, const Situation& now, Body& body) {
  const model::PointKinematics& foot = now.dynamics.foot[index(k)];
  const Vec3& normal = body.plane.normal;
  // |n · (Jᵀ)⁻¹|: normal force per joint torque.
  const double force_per_torque =
      (model::damped_inverse(model::leg_jacobian(foot, k), body.scale) * normal).norm();
  return body.legs[k].observe(now.time, {now.dynamics.hip[index(k)], foot,
                                         now.state.foot_force[index(k)], normal, force_per_torque});
}

/// Applies an action to legs, ground and swing memory, and adds its events.
void carry_out(const Action& action, const Situation& now, Body& body) {
  body.events.add(action.events);
  if (action.memory) body.swing = *action.memory;
  if (action.forgets_print) {
    body.footholds.forget_last(*action.forgets_print);
    body.fit_plane();
  }
  if (action.avoids) body.footholds.avoid(*action.avoids);
  if (action.lands) {
    body.legs[*action.lands].plant(now.time, now.foot(*action.lands));
    body.footholds.remember(*action.lands, now.foot(*action.lands));
    body.fit_plane();
  }
  if (action.reloads) body.legs[*action.reloads].reload(now.time);
  for (const Leg k : body.legs.all()) {
    const Vec3& v_WF = now.dynamics.foot[index(k)].v;
    if (action.searches[index(k)])
      body.legs[k].search(now.time, now.foot(k), v_WF, body.plane.normal);
  }
  if (action.swing) body.legs[action.swing->leg].lift(now.time, action.swing->target);
}

/// One tick of the friction estimates. True if a foot began or stopped sliding.
bool observe_grip(const Situation& now, Body& body) {
  PerLeg<Vec3> normals = now.last.pyramid_normal;
  for (Vec3& normal : normals) {
    if (!normal.allFinite()) normal = body.plane.normal;
  }
  if (!body.grip.update(now.state, normals)) return false;
  body.fit_plane();
  return true;
}

}  // namespace

void Gait::observe(Situation& now, Body& body) {
  for (const Leg k : body.legs.all()) {
    const LegEvent event = observe_leg(k, now, body);
    now.gait = status(body);
    if (const auto action = answer(event, now, k)) act(*action, now, body);
  }
}

std::optional<Action> Gait::answer(LegEvent event, const Situation& now, Leg leg) const {
  return react_to_leg(event, now, leg);
}

GaitOutcome Gait::advance(Situation& now, Body& body) {
  if (observe_grip(now, body)) react(on_slip, now, body);
  body.balance.update(now.state, now.dynamics, body.com_height(now.dynamics));
  return go_on(now, body);
}

void Gait::react(Reaction reaction, Situation& now, Body& body) {
  now.gait = status(body);
  if (const auto action = reaction(now)) act(*action, now, body);
}

void Gait::act(const Action& action, Situation& now, Body& body) {
  carry_out(action, now, body);
  follow(action, now, body);
  if (action.swing && !action.swing->keeps_deadline) plan_com(now, body);
  if (action.replans) plan_com(now, body);
}

bool Gait::wants_plan(const Situation& now) {
  const PushBalance& balance = now.body.balance;
  const double far = now.body.scale.length * kMaxComError;
  const bool off = (now.dynamics.com.p.head<2>() - now.before.com.p).norm() > far;
  return balance.wants_plan(now.time) || (off && balance.may_plan(now.time));
}

}  // namespace surefoot::gaits
