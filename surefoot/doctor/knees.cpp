#include "surefoot/doctor/knees.hpp"

#include "surefoot/config/initial_posture.hpp"

#include <cmath>

namespace surefoot::doctor {

Vec3 turning_signs(const FoundLeg& leg) {
  Mat3 jacobian;
  (void)leg.chain.foot_in_base(Vec3::Zero(), &jacobian);
  return {std::copysign(1.0, jacobian(1, 0)), std::copysign(1.0, jacobian(0, 1)),
          std::copysign(1.0, jacobian(0, 2))};
}

/// A knee that moves its foot forward is bent backward.
KneeSides knee_sides(const FoundLeg& leg) {
  const model::UrdfJoint& knee = leg.joints[2];
  const bool up = !(knee.upper <= config::kSideBend), down = !(knee.lower >= -config::kSideBend);
  return turning_signs(leg).z() > 0.0 ? KneeSides{up, down} : KneeSides{down, up};
}

const char* name(const KneeSides& sides) {
  if (sides.backward && sides.forward) return "both ways";
  if (sides.backward) return "backward";
  return sides.forward ? "forward" : "not at all";
}

}  // namespace surefoot::doctor
