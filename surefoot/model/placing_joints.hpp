#pragma once

#include "surefoot/model/urdf.hpp"

#include <string>
#include <vector>

namespace surefoot::model {

/// Of the chain of joints from the base to a foot those that place it: HAA, the first that turns
/// about x of the base, then HFE and KFE, the first two behind it that turn about y, all with the
/// joints at 0. Fewer where such a joint is missing.
[[nodiscard]] std::vector<const UrdfJoint*> placing_joints(
    const Urdf& urdf, const std::string& base, const std::vector<const UrdfJoint*>& chain);

}  // namespace surefoot::model
