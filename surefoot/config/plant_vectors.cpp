#include "surefoot/config/plant_vectors.hpp"

#include "surefoot/signals/leg.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

namespace surefoot {
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

std::vector<std::string> elements_of(const std::string& path) {
  static const std::vector<std::string> kAxes{"x", "y", "z"};
  static const std::map<std::string, std::vector<std::string>> kVectors{
      {"actuators.joint_torque_gain", joint_elements()},
      {"sensors.encoders.offset", joint_elements()},
      {"sensors.imu.tilt", angle_elements()},
      {"disturbances.base_com_offset", kAxes},
      {"disturbances.payload.position", kAxes},
      {"disturbances.link_mass_scale", link_elements()},
      {"disturbances.thigh_length_offset", leg_elements()},
      {"disturbances.shank_length_offset", leg_elements()},
  };
  const auto found = kVectors.find(path);
  return found == kVectors.end() ? std::vector<std::string>{} : found->second;
}

bool is_whole_number(const std::string& path) {
  constexpr std::array<std::string_view, 3> kKeys{"delay_ticks", "seed", "count"};
  const std::string key = path.substr(path.rfind('.') + 1);
  return std::ranges::find(kKeys, key) != kKeys.end();
}

}  // namespace surefoot
