#pragma once

#include "surefoot/config/robot_fields.hpp"
#include "surefoot/config/section.hpp"
#include "surefoot/model/urdf.hpp"

#include <string>

namespace surefoot::config {

/// The arm that a joint is of; null: it is a leg's.
[[nodiscard]] const model::ArmDescription* arm_of(const model::RobotDescription& robot,
                                                  Eigen::Index joint);
/// The leg that it is of, if it is not an arm's.
[[nodiscard]] Leg leg_of(const model::RobotDescription& robot, Eigen::Index joint);
/// Either, as in messages: "leg LF", "arm \"kinova\"".
[[nodiscard]] std::string limb_of(const model::RobotDescription& robot, Eigen::Index joint);

// Finds the joints of a robot file's limbs in its URDF. Each function throws Error, with the file's
// line, if they are none.

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

}  // namespace surefoot::config
