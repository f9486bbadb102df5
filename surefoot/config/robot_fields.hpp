#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/math/numbers.hpp"
#include "surefoot/model/description.hpp"

namespace surefoot::config {

/// HAA, HFE, KFE of all legs; NaN: not given.
struct LegJoints : Vec3 {
  LegJoints() : Vec3(Vec3::Constant(kNaN)) {}
};

/// Content of a robot file; the rest follows from the URDF.
struct RobotInFile {
  model::RobotDescription robot;  ///< with the URDF as named in the file
  PerLeg<std::vector<std::string>> joints;
  LegJoints torque, velocity, position_min, position_max, stall_torque, no_load_speed, nominal;
};

/// All keys of a robot file.
[[nodiscard]] Group fields(RobotInFile& o);

}  // namespace surefoot::config
