#include "surefoot/model/description.hpp"

namespace surefoot::model {

int RobotDescription::num_joints() const {
  auto count = static_cast<std::size_t>(num_leg_joints());
  for (const ArmDescription& arm : arms) count += arm.joints.size();
  return static_cast<int>(count);
}

std::vector<std::string> RobotDescription::joint_names() const {
  std::vector<std::string> names;
  for (const LegDescription& leg : legs)
    names.insert(names.end(), leg.joints.begin(), leg.joints.end());
  for (const ArmDescription& arm : arms)
    names.insert(names.end(), arm.joints.begin(), arm.joints.end());
  return names;
}

std::string RobotDescription::joint_name(int joint) const {
  return joint < num_leg_joints() ? leg_joint_name(joint, num_legs())
                                  : joint_names()[static_cast<std::size_t>(joint)];
}

}  // namespace surefoot::model
