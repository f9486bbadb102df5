#pragma once

#include "surefoot/doctor/anatomy.hpp"

namespace surefoot::doctor {

/// Sign of the change of the foot's x (HFE, KFE) or y (HAA) with a joint's angle, at q = 0.
[[nodiscard]] Vec3 turning_signs(const FoundLeg& leg);

/// To which sides a knee's limits let it bend by at least 0.5 rad.
struct KneeSides {
  bool backward = false, forward = false;
};
[[nodiscard]] KneeSides knee_sides(const FoundLeg& leg);

/// "backward", "forward", "both ways" or "not at all".
[[nodiscard]] const char* name(const KneeSides& sides);

}  // namespace surefoot::doctor
