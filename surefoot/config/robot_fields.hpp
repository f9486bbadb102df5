#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/math/numbers.hpp"
#include "surefoot/model/description.hpp"

namespace surefoot::config {

/// HAA, HFE, KFE of all legs; NaN: not given.
struct LegJoints : Vec3 {
  LegJoints() : Vec3(Vec3::Constant(kNaN)) {}
};

/// Limits of joints in a robot file; NaN: not given.
struct LimitsInFile {
  LegJoints torque, velocity, position_min, position_max;
};

/// Gains of the safety ladder in a robot file; NaN: not given.
struct GainsInFile {
  LegJoints kp, kd, damping;
};

/// A number for each joint of a limb, or none.
struct JointLists {
  std::vector<double> posture, torque, velocity, position_min, position_max;
};

/// What a robot file says of one leg alone; NaN: as of all legs.
struct LegInFile {
  std::vector<std::string> joints;
  LimitsInFile limits;
  LegJoints nominal;
  GainsInFile gains;
  double foot_radius = kNaN;
  Vec3 foot_center = Vec3::Constant(kNaN);
  JointLists lists;  ///< of further joints; of one of two legs instead of limits and nominal
};

/// An arm as a file gives it.
struct ArmInFile {
  model::ArmDescription names;  ///< without joints: those between base, or arm before it, and tip
  JointLists lists;
};

/// All keys of an arm.
[[nodiscard]] Group fields(ArmInFile& o);

/// Content of a robot file; the rest follows from the URDF or MJCF.
struct RobotInFile {
  model::RobotDescription robot;     ///< with the URDF as named in the file
  std::string mjcf;                  ///< instead of a URDF
  std::vector<std::string> guessed;  ///< numbers of the file that are not measured
  PerLeg<LegInFile> legs;
  std::vector<ArmInFile> arms;
  LimitsInFile limits;
  LegJoints stall_torque, no_load_speed, nominal;
  GainsInFile gains;
  double foot_radius = kNaN;  ///< of every leg that has none of its own
  Vec3 foot_center = Vec3::Zero();
};

void set_num_legs(RobotInFile& robot, int num_legs);

/// All keys of a robot file, by its number of legs; LM and RM are not required.
[[nodiscard]] Group fields(RobotInFile& o);

}  // namespace surefoot::config
