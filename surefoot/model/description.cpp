#include "surefoot/model/description.hpp"

#include "surefoot/signals/joint_name.hpp"

namespace surefoot::model {

JointRange RobotDescription::leg_joints(Leg leg) const {
  JointRange range;
  for (std::size_t k = 0; k <= index(leg); ++k) {
    range.first += range.count;
    range.count = static_cast<int>(legs[k].joints.size());
  }
  return range;
}

int RobotDescription::num_leg_joints() const {
  std::size_t count = 0;
  for (const LegDescription& leg : legs) count += leg.joints.size();
  return static_cast<int>(count);
}

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
  return told_joints(joint_names(), num_legs())[static_cast<std::size_t>(joint)];
}

}  // namespace surefoot::model
