#pragma once

#include "surefoot/config/robot_fields.hpp"
#include "surefoot/config/section.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/model/urdf.hpp"

#include <string>

namespace surefoot::config {

// Completes a robot file. Each function throws Error, with the file's line, if a value is unknown.

/// Joints and links of a leg, between base and foot. `key`: of the leg in the file. Where more than
/// three joints lie there and the file does not name HAA, HFE and KFE, these are the first that
/// turns about x of the base and the first two behind it that turn about y.
void complete_leg(const Section& top, const model::Urdf& urdf, const std::string& base,
                  const std::string& key, const LegInFile& given, model::LegDescription& leg);

/// A robot has no more than kMaxJoints. `key`: of the limb that was added last.
void check_num_joints(const Section& top, const std::string& key,
                      const model::RobotDescription& robot);

/// Joints of one of two legs, any number of them.
void complete_standing_leg(const Section& top, const model::Urdf& urdf, const std::string& base,
                           const std::string& key, const LegInFile& given,
                           model::LegDescription& leg);

/// Joints of an arm: those between its tip and the base, or a joint of an arm before it.
void complete_arm(const Section& top, const model::Urdf& urdf, const ArmInFile& given,
                  model::RobotDescription& robot);

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
