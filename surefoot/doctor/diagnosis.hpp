#pragma once

#include "surefoot/doctor/anatomy.hpp"
#include "surefoot/model/description.hpp"
#include "surefoot/model/proportions.hpp"

#include <optional>
#include <string>

namespace surefoot::doctor {

/// How a stance uses the legs, at its worst.
struct Reach {
  double longest = 0.0;    ///< hip to foot, the knee as straight as its limits allow [m]
  double stretched = 0.0;  ///< of that, in the stance
  double from_haa = 0.0;   ///< of that, from the foot to the HAA axis; at 0 HAA moves it nowhere
  Leg leg = Leg::LF;       ///< the most stretched one
};

/// All that was found of a robot.
struct Diagnosis {
  std::string name;
  std::string given;       ///< the description as it was asked for: a path or a package:// name
  std::string robot_file;  ///< whose numbers count; empty: none, so that guesses fill its gaps
  model::Urdf urdf;        ///< masses and inertias as written, even impossible ones
  Anatomy anatomy;
  /// As the program itself reads the robot file, guesses included; none: it refuses the robot.
  std::optional<model::RobotDescription> robot;
  std::optional<model::Proportions> proportions;
  JointVector standing_torque =
      JointVector::Constant(kNumLegJoints, kNaN);  ///< in the nominal posture [N·m]
  Findings findings;                               ///< worst first
  std::optional<Reach> reach;                      ///< of the stance that a walk begins in
};

/// Is this a name for a robot: letters, digits, "_", "-" and ".", a letter or digit first?
[[nodiscard]] bool is_robot_name(const std::string& name);

/// Examines a URDF or MJCF: its parts, units, limits, symmetry, signs, and whether it can stand. Of
/// a robot file, or the name of a robot that ships, the description that it names, with the file's
/// limits, feet and postures. `name`: of the robot; empty: the file's, "_" for what is not valid.
/// Throws FileError, with file and line, if it can't be read.
[[nodiscard]] Diagnosis examine(const std::string& given, const std::string& name = "");

}  // namespace surefoot::doctor
