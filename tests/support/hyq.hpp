#pragma once

#include "surefoot/model/description.hpp"

namespace surefoot::test {

/// HyQ of example-robot-data, whose URDF has what ANYmal's has not: inertias that are of no body,
/// collision meshes in Collada, friction in its joints, other limits at its hind legs.
[[nodiscard]] model::RobotDescription hyq();

}  // namespace surefoot::test
