#pragma once

#include "surefoot/config/section.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/model/urdf.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::config {

/// Refuses what no walking robot has, with the leg's line in the robot file: lengths or masses in
/// other units, a foot at its knee, a knee that turns across its hip. `legs`: of the robot file.
void check_plausible(const ConfigNode& legs, const model::Urdf& urdf,
                     const model::RobotDescription& robot);

// Limits that look like numbers that were never filled in.

/// Above what standing needs at any joint [N·m], by a factor that no drive has.
[[nodiscard]] bool is_effort_placeholder(double effort, double most_standing_torque);
inline constexpr double kFastestJoint = 100.0;  ///< [rad/s]
[[nodiscard]] bool is_velocity_placeholder(double velocity);
/// A whole turn or more, or none.
[[nodiscard]] bool is_position_placeholder(double lower, double upper);

/// Ends the notes on them.
inline constexpr std::string_view kPlaceholder = ": a placeholder?";
/// What a run tells of such limits of its robot's joints, that the controller then never meets.
[[nodiscard]] std::vector<std::string> placeholder_notes(const model::RobotDescription& robot,
                                                         const JointVector& standing_torque);

}  // namespace surefoot::config
