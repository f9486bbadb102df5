#pragma once

#include "surefoot/model/description.hpp"

#include <string>

namespace surefoot::test {

/// robots/hexapod.urdf, with a posture of all knees backward.
[[nodiscard]] model::RobotDescription hexapod();

/// The same URDF with a YAW ahead of each HAA, and an ANKLE that turns the foot's link: legs of
/// five joints.
[[nodiscard]] std::string hexapod_urdf_with_further_joints();

}  // namespace surefoot::test
