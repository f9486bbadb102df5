#include "surefoot/gaits/com_horizon.hpp"

#include "surefoot/gaits/parts/reach.hpp"
#include "surefoot/math/numbers.hpp"

namespace surefoot {
namespace {}  // namespace

ComHorizon::ComHorizon(const GaitTick& tick, Body& body, bool recovers)
    : tick_(tick),
      body_(body),
      ground_(body.plane.height(tick.dynamics.com.p.head<2>())),
      feet_(body.legs.footholds()) {
  const Vec2 com = tick.dynamics.com.p.head<2>();
  phase_.lifts_in.fill(kInfinity);
  if (recovers || body.balance.is_pushed()) phase_.zmp_margin_max = body.options.push.zmp_margin;
  for (const Leg k : kLegs) {
    const std::size_t i = index(k);
    const LegMotion& leg = body.legs[k];
    const Vec3& hip = tick.dynamics.hip[i].p;
    phase_.feet[i] = feet_[i].head<2>();
    phase_.heights[i] = feet_[i].z() - ground_;
    phase_.down[i] = leg.down();
    phase_.loaded_for[i] = leg.down() ? leg.since(tick.time) : 0.0;
    phase_.hips[i] = hip.head<2>() - com;
    phase_.reach[i] = horizontal_reach(body.options.swing, hip.z() - feet_[i].z());
  }
  body.com.weigh(kGravity * tick.dynamics.mass);
  body.com.bear(body.balance.load());
  body.com.stand_on(body.grip.mean_friction(body.legs.down()), tick.yaw);
  body.balance.planned(tick.time);
  body.com.clear();
}

void ComHorizon::add(double duration, bool must_rest) {
  phase_.duration = duration;
  phase_.must_rest = must_rest;
  body_.com.add(phase_);
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
  phase_.lifts_in[i] = kInfinity;
}

void ComHorizon::plan(const Vec2& end_velocity, bool comes_to_rest) {
  const Motion<Vec2> begin{tick_.dynamics.com.p.head<2>(), tick_.dynamics.com.v.head<2>(),
                           tick_.before.com.a};
  body_.com.plan(tick_.time, begin, body_.com_height(tick_.dynamics), end_velocity, comes_to_rest);
}

}  // namespace surefoot
