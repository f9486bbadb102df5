#pragma once

#include "surefoot/model/description.hpp"

namespace surefoot::test {

/// robots/hexapod.urdf, with a posture of all knees backward.
[[nodiscard]] model::RobotDescription hexapod();

}  // namespace surefoot::test
