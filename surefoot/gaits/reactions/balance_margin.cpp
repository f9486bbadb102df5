#include "surefoot/gaits/reactions/balance_margin.hpp"

namespace surefoot {
namespace {

SupportRegion region(const PerLeg<double>& share, const Dynamics& dynamics) {
  PerLeg<Vec2> feet;
  for (const Leg k : kLegs) feet[index(k)] = dynamics.foot[index(k)].p.head<2>();
  return SupportRegion(feet, share);
}

}  // namespace

SupportRegion region_without(Leg leg, const Dynamics& dynamics) {
  PerLeg<double> share{1.0, 1.0, 1.0, 1.0};
  share[index(leg)] = 0.0;
  return region(share, dynamics);
}

double balance_margin(const Body& body, const Dynamics& dynamics) {
  return region({1.0, 1.0, 1.0, 1.0}, dynamics).margin(body.balance.capture_point());
}

bool is_balanced_without(Leg leg, const Body& body, const Dynamics& dynamics) {
  const double margin = region_without(leg, dynamics).margin(body.balance.capture_point());
  return margin > body.options.push.lift_off_margin && body.balance.is_steady();
}

}  // namespace surefoot
