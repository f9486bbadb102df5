#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/math/numbers.hpp"
#include "surefoot/model/description.hpp"

namespace surefoot::config {

/// HAA, HFE, KFE of all legs; NaN: not given.
struct LegJoints : Vec3 {
  LegJoints() : Vec3(Vec3::Constant(kNaN)) {}
};

/// Limits of joints as a robot file says them; NaN: not given.
struct LimitsInFile {
  LegJoints torque, velocity, position_min, position_max;
};

/// What a robot file says of one leg alone; NaN: as it says of all legs.
struct LegInFile {
  std::vector<std::string> joints;
  LimitsInFile limits;
  LegJoints nominal;
};

/// What a robot file says; what it leaves out follows from the URDF.
struct RobotInFile {
  model::RobotDescription robot;  ///< its URDF by name
  PerLeg<LegInFile> legs;
  LimitsInFile limits;
  LegJoints stall_torque, no_load_speed, nominal;
};

/// All keys of a robot file.
[[nodiscard]] Group fields(RobotInFile& o);

}  // namespace surefoot::config
