#include "surefoot/gaits/com_horizon.hpp"

namespace surefoot::gaits {

ComHorizon::ComHorizon(const Situation& now, bool recovers)
    : ground_(now.body.plane.height(now.dynamics.com.p.head<2>())),
      feet_(now.body.legs.footholds()) {
  const Body& body = now.body;
  const Vec2 com = now.dynamics.com.p.head<2>();
  if (recovers || body.balance.is_pushed()) phase_.zmp_margin_max = body.options.push.zmp_margin;
  for (const Leg k : feet_.legs()) {
    const std::size_t i = index(k);
    const LegMotion& leg = body.legs[k];
    const Vec3& hip = now.dynamics.hip[i].p;
    phase_.feet[i] = feet_[i].head<2>();
    phase_.heights[i] = feet_[i].z() - ground_;
    phase_.down[i] = leg.down();
    phase_.loaded_for[i] = leg.down() ? leg.since(now.time) : 0.0;
    phase_.hips[i] = hip.head<2>() - com;
    phase_.reach[i] = horizontal_reach(body.options.swing, hip.z() - feet_[i].z());
  }
  problem_.time = now.time;
  problem_.begin = {com, now.dynamics.com.v.head<2>(), now.before.com.a};
  problem_.height = body.com_height(now.dynamics);
  problem_.weight = kGravity * now.dynamics.mass;
  problem_.load = body.balance.load();
  problem_.friction = body.grip.mean_friction(body.legs.down());
  problem_.heading = now.yaw;
}

void ComHorizon::add(double duration, bool must_rest) {
  phase_.duration = duration;
  phase_.must_rest = must_rest;
  problem_.add(phase_);
  for (double& loaded : phase_.loaded_for) loaded += duration;
  for (double& lifts : phase_.lifts_in) lifts -= duration;
}

void ComHorizon::add_support_until_lift_off(Leg leg, double duration) {
  phase_.lifts_in[index(leg)] = duration;
  add(duration, false);
  phase_.down[index(leg)] = false;
}

void ComHorizon::land(Leg leg, const Vec3& foothold) {
  const std::size_t i = index(leg);
  feet_[i] = foothold;
  phase_.feet[i] = foothold.head<2>();
  phase_.heights[i] = foothold.z() - ground_;
  phase_.down[i] = true;
  phase_.loaded_for[i] = 0.0;
  phase_.lifts_in[i] = kNever;
}

void ComHorizon::plan(Body& body, const Vec2& end_velocity) {
  problem_.end_velocity = end_velocity;
  body.balance.planned(problem_.time);
  body.com.plan(problem_);
}

void ComHorizon::come_to_rest(Body& body, double duration, bool must_rest) {
  add(body.scale.time() * duration, must_rest);
  problem_.comes_to_rest = true;
  plan(body, Vec2::Zero());
}

}  // namespace surefoot::gaits
