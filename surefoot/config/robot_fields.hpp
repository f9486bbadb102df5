#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/model/description.hpp"

namespace surefoot::config {

/// What a robot file says, with the joints of all legs alike: HAA, HFE, KFE.
struct RobotInFile {
  model::RobotDescription robot;  ///< its URDF by name
  PerLeg<std::vector<std::string>> joints;
  Vec3 torque = Vec3::Zero(), velocity = Vec3::Zero();
  Vec3 position_min = Vec3::Zero(), position_max = Vec3::Zero();
  Vec3 nominal = Vec3::Zero();
};

/// All keys of a robot file.
[[nodiscard]] Group fields(RobotInFile& o);

}  // namespace surefoot::config
