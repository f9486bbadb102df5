#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/math/numbers.hpp"
#include "surefoot/model/description.hpp"

namespace surefoot::config {

/// HAA, HFE, KFE of all legs; NaN: not given.
struct LegJoints : Vec3 {
  LegJoints() : Vec3(Vec3::Constant(kNaN)) {}
};

/// What a robot file says; what it leaves out follows from the URDF or MJCF.
struct RobotInFile {
  model::RobotDescription robot;  ///< its URDF by name
  std::string mjcf;               ///< by name
  PerLeg<std::vector<std::string>> joints;
  LegJoints torque, velocity, position_min, position_max, stall_torque, no_load_speed, nominal;
};

/// All keys of a robot file.
[[nodiscard]] Group fields(RobotInFile& o);

}  // namespace surefoot::config
