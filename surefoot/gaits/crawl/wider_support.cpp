#include "surefoot/gaits/crawl/wider_support.hpp"

#include "surefoot/gaits/parts/support_region.hpp"

#include <algorithm>

namespace surefoot {
namespace {

constexpr double kWider = 0.01;  // a support that is worth another leg's step, by [m]

}  // namespace

std::optional<Leg> leg_for_wider_support(const GaitTick& tick, const Body& body,
                                         const StepSequence& steps) {
  const double enough = body.options.com.rest_margin;
  const Leg next = steps.next();
  const PerLeg<Vec3> feet = body.legs.footholds();
  PerLeg<Vec2> places;
  for (const Leg k : kLegs) places[index(k)] = feet[index(k)].head<2>();
  double widest = inradius_without(next, places);
  if (widest > enough) return {};
  widest += kWider;
  const double cycle = steps.cycle_duration(body.pace());
  std::optional<Leg> first;
  for (const Leg k : kLegs) {
    if (k == next || inradius_without(k, places) < enough) continue;
    PerLeg<Vec2> after = places;
    after[index(k)] =
        body.footholds.foothold(k, feet, body.plane, tick.yaw, tick.user, cycle).head<2>();
    const double width = inradius_without(next, after);
    if (width > widest) first = k;
    widest = std::max(widest, width);
  }
  return first;
}

}  // namespace surefoot
