#include "surefoot/simulation/plant_elements.hpp"

#include "surefoot/signals/leg.hpp"

#include <array>
#include <string_view>

namespace surefoot::simulation {
namespace {

std::vector<std::string> of_each_leg(const std::array<std::string_view, kJointsPerLeg>& parts) {
  std::vector<std::string> names;
  for (const std::string_view leg : kLegNames) {
    for (const std::string_view part : parts) {
      names.push_back(std::string(leg) + "_" + std::string(part));
    }
  }
  return names;
}

}  // namespace

const std::vector<std::string>& joint_elements() {
  static const std::vector<std::string> kNames = of_each_leg(kJointNames);
  return kNames;
}

const std::vector<std::string>& link_elements() {
  static const std::vector<std::string> kNames = of_each_leg({"HIP", "THIGH", "SHANK"});
  return kNames;
}

const std::vector<std::string>& leg_elements() {
  static const std::vector<std::string> kNames(kLegNames.begin(), kLegNames.end());
  return kNames;
}

const std::vector<std::string>& angle_elements() {
  static const std::vector<std::string> kNames{"roll", "pitch", "yaw"};
  return kNames;
}

const std::vector<std::string>& axis_elements() {
  static const std::vector<std::string> kNames{"x", "y", "z"};
  return kNames;
}

}  // namespace surefoot::simulation
