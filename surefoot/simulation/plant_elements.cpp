#include "surefoot/simulation/plant_elements.hpp"

#include <array>
#include <string_view>

namespace surefoot::simulation {
namespace {

std::vector<std::string> of_each_leg(const std::array<std::string_view, kJointsPerLeg>& parts,
                                     int num_legs) {
  std::vector<std::string> names;
  for (const std::string_view leg : leg_names(num_legs)) {
    for (const std::string_view part : parts) {
      names.push_back(std::string(leg) + "_" + std::string(part));
    }
  }
  return names;
}

}  // namespace

std::vector<std::string> joint_elements(int num_legs) { return of_each_leg(kJointNames, num_legs); }

std::vector<std::string> link_elements(int num_legs) {
  return of_each_leg({"HIP", "THIGH", "SHANK"}, num_legs);
}

std::vector<std::string> leg_elements(int num_legs) {
  const auto names = leg_names(num_legs);
  return {names.begin(), names.end()};
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
