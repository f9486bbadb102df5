#include "surefoot/model/description.hpp"

#include "surefoot/signals/joint_name.hpp"

namespace surefoot::model {
namespace {

using Names = std::vector<std::string>;

int num_joints_of(const PerLeg<LegDescription>& legs, Names LegDescription::* joints) {
  std::size_t count = 0;
  for (const LegDescription& leg : legs) count += (leg.*joints).size();
  return static_cast<int>(count);
}

/// Of one leg's joints among those of all legs, which begin at `first`.
JointRange range_of(const PerLeg<LegDescription>& legs, Leg leg, Names LegDescription::* joints,
                    int first = 0) {
  JointRange range{.first = first, .count = 0};
  for (std::size_t k = 0; k <= index(leg); ++k) {
    range.first += range.count;
    range.count = static_cast<int>((legs[k].*joints).size());
  }
  return range;
}

}  // namespace

JointRange RobotDescription::leg_joints(Leg leg) const {
  return range_of(legs, leg, &LegDescription::joints);
}

JointRange RobotDescription::further_joints(Leg leg) const {
  return range_of(legs, leg, &LegDescription::further,
                  num_joints_of(legs, &LegDescription::joints));
}

int RobotDescription::num_leg_joints() const {
  return num_joints_of(legs, &LegDescription::joints) +
         num_joints_of(legs, &LegDescription::further);
}

int RobotDescription::num_joints() const {
  auto count = static_cast<std::size_t>(num_leg_joints());
  for (const ArmDescription& arm : arms) count += arm.joints.size();
  return static_cast<int>(count);
}

std::vector<std::string> RobotDescription::joint_names() const {
  Names names;
  const auto add = [&names](const Names& more) {
    names.insert(names.end(), more.begin(), more.end());
  };
  for (const LegDescription& leg : legs) add(leg.joints);
  for (const LegDescription& leg : legs) add(leg.further);
  for (const ArmDescription& arm : arms) add(arm.joints);
  return names;
}

std::string RobotDescription::joint_name(int joint) const {
  return told_joints(joint_names(), num_legs())[static_cast<std::size_t>(joint)];
}

}  // namespace surefoot::model
