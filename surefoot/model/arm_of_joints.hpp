#pragma once

#include "surefoot/model/description.hpp"

#include <vector>

namespace surefoot::model {

/// The arm that each joint belongs to, by its place in `robot.arms`; −1: a leg's.
[[nodiscard]] std::vector<int> arm_of_joints(const RobotDescription& robot);

}  // namespace surefoot::model
