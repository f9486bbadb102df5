#include "surefoot/base/error.hpp"
#include "surefoot/gaits/planner.hpp"

#include <cmath>
#include <string>

namespace surefoot {

// A foot that slid stands elsewhere: the plane and the way of the COM are those of other footholds.
// While it slides the others must do without it, so no foot leaves the ground, and one in the air
// comes down if the balance is lost without it.
void Planner::observe_grip(const UserCommand& user, const RobotState& state,
                           const Dynamics& dynamics) {
  PerLeg<Vec3> normals = last_.pyramid_normal;
  for (Vec3& normal : normals) {
    if (!normal.allFinite()) normal = plane_.normal;
  }
  if (!grip_.update(state, normals)) return;
  plane_ = fit_terrain_plane(footholds(), options_.torso.max_tilt);
  if (grip_.began()) {
    event_ = PlanEvent::slip;
    const Leg next = next_leg();
    if (mode_ == Mode::support && leg(next).phase() == LegPhase::unloading) {
      leg(next).reload(time_);
      begin_support(user, support_duration());
    } else if (mode_ == Mode::swing && leg(next).phase() == LegPhase::swing &&
               !balanced_without(next, dynamics)) {
      put_foot_down(next, user, dynamics);
      event_ = PlanEvent::slip;
    }
  }
  replan_com(user, dynamics);
}

void Planner::set_friction(double friction) {
  if (!(friction > 0.0) || !std::isfinite(friction)) {
    throw Error("friction is " + std::to_string(friction) + "; valid is a number above 0");
  }
  options_.force.friction = friction;
  grip_.expect(friction);
}

double Planner::mean_friction() const {
  double sum = 0.0;
  int standing = 0;
  for (const Leg k : kLegs) {
    if (!leg(k).down()) continue;
    sum += grip_.friction(k);
    ++standing;
  }
  return standing == 0 ? options_.force.friction : sum / standing;
}

// Accelerations fall with the square of the durations.
double Planner::pace() const { return std::sqrt(grip_.caution()); }

}  // namespace surefoot
