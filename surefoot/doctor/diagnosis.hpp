#pragma once

#include "surefoot/doctor/anatomy.hpp"
#include "surefoot/model/description.hpp"
#include "surefoot/model/proportions.hpp"

#include <optional>
#include <string>

namespace surefoot::doctor {

/// All that was found of a robot.
struct Diagnosis {
  std::string name;
  std::string given;  ///< the URDF as it was asked for: a path or a package:// name
  model::Urdf urdf;   ///< masses and inertias as written, even impossible ones
  Anatomy anatomy;
  /// As the program itself reads the robot file, guesses included; none: it refuses the robot.
  std::optional<model::RobotDescription> robot;
  std::optional<model::Proportions> proportions;
  JointVector standing_torque =
      JointVector::Constant(kNumLegJoints, kNaN);  ///< in the nominal posture [N·m]
  Findings findings;                               ///< worst first
};

/// Is this a name for a robot: letters, digits, "_", "-" and ".", a letter or digit first?
[[nodiscard]] bool is_robot_name(const std::string& name);

/// Examines a URDF: its parts, units, limits, symmetry, signs, and whether it can stand. `name`:
/// of the robot; empty: the URDF file's, "_" for what is not valid. Throws FileError, with file and
/// line, if it can't be read.
[[nodiscard]] Diagnosis examine(const std::string& urdf, const std::string& name = "");

}  // namespace surefoot::doctor
