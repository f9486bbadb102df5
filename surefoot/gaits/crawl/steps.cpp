#include "surefoot/gaits/crawl/steps.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/disc.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace surefoot::gaits {
namespace {

constexpr double kMinStep = 0.02;      // a shorter step has no direction [m]
constexpr double kMinWidening = 0.01;  // of the support, by another leg's step [m]

/// Throws Error unless the order has each leg once: a search for a missing leg would not end.
const GaitOptions& checked(const GaitOptions& gait) {
  for (const Leg k : gait.order.legs()) {
    const auto count = std::ranges::count(gait.order, k);
    if (count == 1) continue;
    throw Error("gait.order has " + std::string(leg_name(k, gait.num_legs())) + " " +
                std::to_string(count) + " times; it must have each leg once");
  }
  return gait;
}

/// The goal, limited to the leg's reach from the hip at landing: a nearly straight leg can't detect
/// contact. Over lower ground the hip comes down with the torso.
Vec2 within_reach(Leg k, const Vec3& goal, double duration, const Situation& now) {
  const Body& body = now.body;
  const Vec2 shift = body.com.at(now.time + duration).p - now.dynamics.com.p.head<2>();
  const Vec3& hip = now.dynamics.hip[index(k)].p;
  const double stance = hip_height(body.options.stance, body.scale);
  const double height = std::min(hip.z() - goal.z(), stance);
  return nearest_within(goal.head<2>(), hip.head<2>() + shift,
                        horizontal_reach(body.options.swing, height));
}

}  // namespace

StepSequence::StepSequence(const GaitOptions& gait, const ProbeOptions& probe)
    : gait_(checked(gait)), probe_(probe) {}

Leg StepSequence::next(int ahead) const {
  const Leg k = gait_.order[static_cast<std::size_t>((cursor_ + ahead) % gait_.num_legs())];
  return backward_ ? same_side(k, gait_.num_legs()) : k;
}

double StepSequence::support_duration(double pace, int ahead) const {
  const bool same_side = is_left(next(ahead)) == is_left(next(ahead + gait_.num_legs() - 1));
  return pace * (same_side ? gait_.same_side_duration : gait_.switch_duration);
}

double StepSequence::cycle_duration(double pace) const {
  double sum = 0.0;
  for (int i = 0; i < gait_.num_legs(); ++i)
    sum += support_duration(pace, i) + swing_duration(pace, next(i));
  return sum;
}

std::optional<Leg> leg_for_wider_support(const Situation& now, const StepSequence& steps) {
  const Body& body = now.body;
  const double enough = body.options.com.rest_margin;
  const Leg next = steps.next();
  const PerLeg<Vec3> feet = body.legs.footholds();
  const PerLeg<Vec2> places = on_the_ground(feet);
  double widest = inradius_without(next, places);
  if (widest > enough) return {};
  widest += body.scale.length * kMinWidening;
  const double cycle = steps.cycle_duration(body.pace());
  std::optional<Leg> first;
  for (const Leg k : feet.legs()) {
    if (k == next || inradius_without(k, places) < enough) continue;
    PerLeg<Vec2> after = places;
    after[index(k)] =
        body.footholds.foothold(k, feet, body.plane, now.yaw, now.user, cycle).head<2>();
    const double width = inradius_without(next, after);
    if (width > widest) first = k;
    widest = std::max(widest, width);
  }
  return first;
}

void begin_swing(Leg k, const Situation& now, Body& body, double cycle_duration) {
  const PlannerOptions& options = body.options;
  const PerLeg<Vec3> feet = body.legs.footholds();
  SwingMemory& memory = body.swing;
  memory = memory.for_new_swing();
  memory.foothold = body.footholds.foothold(k, feet, body.plane, now.yaw, now.user, cycle_duration);
  memory.probes = probes(options.probe, k);
  Vec3 goal = memory.foothold;
  if (memory.probes) {
    const Vec2 heading(std::cos(now.yaw), std::sin(now.yaw));
    const Vec2 step = (goal - now.foot(k)).head<2>();
    const bool is_long = step.norm() > body.scale.length * kMinStep;
    memory.direction = is_long ? step.normalized() : heading;
    goal.head<2>() += options.probe.ahead * memory.direction;
    goal.z() = body.footholds.expected_height(k, goal.head<2>(), feet, body.plane);
  }
  const double duration = body.pace() * options.gait.swing_duration;
  goal.head<2>() = within_reach(k, goal, duration, now);
  const double apex = knows_ground(options, k) ? options.swing.apex_known : options.swing.apex;
  body.events.add(now.event(PlanEvent::lift_off, k));
  body.legs[k].lift(now.time, {now.foot(k), goal, body.plane.normal, duration, apex});
}

}  // namespace surefoot::gaits
