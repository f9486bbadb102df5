#include "surefoot/gaits/body.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr double kMinHeight = 0.1;  // of the COM over the plane [m]
constexpr double kOffPlan = 0.01;   // the COM from its plan: that one can't be followed [m]

}  // namespace

Body::Body(const PlannerOptions& given, double weight, double control_period)
    : options(given),
      period(control_period),
      legs(given, control_period),
      footholds(given.stance, given.foothold),
      grip(given.grip, given.force.friction, control_period),
      balance(given.push, control_period),
      com(given.com, given.force, weight) {}

void Body::fit_plane() { plane = fit_terrain_plane(legs.footholds(), options.torso.max_tilt); }

void Body::learn_ground() {
  footholds.forget();
  for (const Leg k : kLegs) footholds.remember(k, legs[k].foothold());
  fit_plane();
}

bool Body::observe_grip(const GaitTick& tick) {
  PerLeg<Vec3> normals = tick.last.pyramid_normal;
  for (Vec3& normal : normals) {
    if (!normal.allFinite()) normal = plane.normal;
  }
  if (!grip.update(tick.state, normals)) return false;
  fit_plane();
  return true;
}

// Accelerations fall with the square of the durations.
double Body::pace() const { return std::sqrt(grip.caution()); }

double Body::com_height(const Dynamics& dynamics) const {
  const Vec3& p = dynamics.com.p;
  return std::max(kMinHeight, p.z() - plane.height(p.head<2>()));
}

bool Body::wants_plan(const GaitTick& tick) const {
  const bool off = (tick.dynamics.com.p.head<2>() - tick.before.com.p).norm() > kOffPlan;
  return balance.wants_plan(tick.time) || (off && balance.may_plan(tick.time));
}

}  // namespace surefoot
