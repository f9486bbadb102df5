#pragma once

#include "surefoot/config/robot_fields.hpp"
#include "surefoot/config/section.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/model/urdf.hpp"

#include <string>

namespace surefoot::config {

// What a robot file leaves out. Each throws Error, with the file's line, where it can't be known.

/// Joints and links of a leg: those between the base and the foot. `key` is the leg's in the file.
void complete_leg(const Section& top, const model::Urdf& urdf, const std::string& base,
                  const std::string& key, model::LegDescription& leg);

/// Limits of each joint from the URDF, and drives that can do what the limits allow.
void complete_limits(const Section& top, const model::Urdf& urdf, const RobotInFile& given,
                     model::RobotDescription& robot);

/// The nominal posture of each leg: its own, else from that of a front leg, else from the limits.
void complete_posture(const Section& top, const RobotInFile& given, const model::RobotModel& model,
                      model::RobotDescription& robot);

/// Gains of the safety stage: ANYmal B's, for a robot of this size.
void complete_gains(model::RobotDescription& robot);

}  // namespace surefoot::config
