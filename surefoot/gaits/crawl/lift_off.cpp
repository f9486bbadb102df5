#include "surefoot/gaits/crawl/lift_off.hpp"

#include "surefoot/gaits/parts/reach.hpp"
#include "surefoot/math/disc.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr double kMinStep = 0.02;  // a step that is shorter has no direction [m]

/// A foothold, not further from the hip than the leg reaches when the foot lands: nearly straight,
/// a leg neither feels the ground nor stands on it. Above lower ground the hip comes down with the
/// torso.
Vec2 within_reach(Leg k, const Vec3& goal, double duration, const GaitTick& tick,
                  const Body& body) {
  const Vec2 shift = body.com.at(tick.time + duration).p - tick.dynamics.com.p.head<2>();
  const Vec3& hip = tick.dynamics.hip[index(k)].p;
  const double height = std::min(hip.z() - goal.z(), body.options.stance.height);
  return nearest_within(goal.head<2>(), hip.head<2>() + shift,
                        horizontal_reach(body.options.swing, height));
}

}  // namespace

LiftOff plan_lift_off(Leg k, const GaitTick& tick, const Body& body, double cycle_duration) {
  const PlannerOptions& options = body.options;
  const PerLeg<Vec3> feet = body.legs.footholds();
  const Vec3& p_WF = tick.dynamics.foot[index(k)].p;
  SwingMemory memory = body.swing.begun();
  memory.foothold =
      body.footholds.foothold(k, feet, body.plane, tick.yaw, tick.user, cycle_duration);
  memory.probes = probes(options.probe, k);
  Vec3 goal = memory.foothold;
  if (memory.probes) {
    const Vec2 heading(std::cos(tick.yaw), std::sin(tick.yaw));
    const Vec2 step = (goal - p_WF).head<2>();
    memory.direction = step.norm() > kMinStep ? step.normalized() : heading;
    goal.head<2>() += options.probe.ahead * memory.direction;
    goal.z() = body.footholds.expected_height(k, goal.head<2>(), feet, body.plane);
  }
  const double duration = body.pace() * options.gait.swing_duration;
  goal.head<2>() = within_reach(k, goal, duration, tick, body);
  const double apex = knows_ground(options, k) ? options.swing.apex_known : options.swing.apex;
  return {{p_WF, goal, body.plane.normal, duration, apex}, memory};
}

}  // namespace surefoot
