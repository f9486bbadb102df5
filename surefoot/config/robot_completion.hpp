#pragma once

#include "surefoot/config/robot_fields.hpp"
#include "surefoot/config/section.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/model/urdf.hpp"

#include <string>

namespace surefoot::config {

// Completes the numbers of a robot file. Each function throws Error, with the file's line, if a
// value is unknown.

/// Limits of each joint from the URDF, and drives from the limits.
void complete_limits(const Section& top, const model::Urdf& urdf, const RobotInFile& given,
                     model::RobotDescription& robot);

/// The nominal posture of each leg: its own, else from that of a front leg, else from the limits.
void complete_posture(const Section& top, const RobotInFile& given, const model::RobotModel& model,
                      model::RobotDescription& robot);

/// Gains of the safety stage: those of the file, else ANYmal B's, scaled to the robot.
void complete_gains(const RobotInFile& given, model::RobotDescription& robot);

/// Radius and centre of each foot: the leg's own, else those of all.
void complete_feet(const RobotInFile& given, model::RobotDescription& robot);

}  // namespace surefoot::config
