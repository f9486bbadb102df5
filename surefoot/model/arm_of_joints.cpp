#include "surefoot/model/arm_of_joints.hpp"

namespace surefoot::model {

std::vector<int> arm_of_joints(const RobotDescription& robot) {
  std::vector<int> arm_of(static_cast<std::size_t>(robot.num_leg_joints()), -1);
  for (std::size_t arm = 0; arm < robot.arms.size(); ++arm)
    arm_of.insert(arm_of.end(), robot.arms[arm].joints.size(), static_cast<int>(arm));
  return arm_of;
}

}  // namespace surefoot::model
