#include "surefoot/config/robot_completion.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/config/limb_chains.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace surefoot::config {
namespace {

/// Key of a leg, with the dot behind it.
std::string key_of(Leg leg, int num_legs) {
  return "legs." + std::string(leg_name(leg, num_legs)) + ".";
}

/// Joints that a file gives by HAA, HFE and KFE; those behind them have lists.
int num_walking_joints(const model::RobotDescription& robot) {
  return robot.can_walk() ? kJointsPerLeg * robot.num_legs() : 0;
}

/// Key of a joint's limits.
std::string key_of(const model::RobotDescription& robot, Eigen::Index joint) {
  const model::ArmDescription* arm = arm_of(robot, joint);
  if (arm != nullptr) return "arms." + arm->name;
  if (joint < num_walking_joints(robot)) return "limits";
  return "legs." + std::string(leg_name(leg_of(robot, joint), robot.num_legs())) +
         (robot.can_walk() ? ".further" : "");
}

/// Is a leg's posture within the limits? `bad` gets the index of the first joint that is not.
bool is_within_limits(const model::RobotDescription& robot, Leg leg, const Vec3& q,
                      Eigen::Index& bad) {
  const Eigen::Index first = first_joint(leg);
  for (bad = 0; bad < kJointsPerLeg; ++bad) {
    if (q[bad] < robot.q_min[first + bad] || q[bad] > robot.q_max[first + bad]) return false;
  }
  return true;
}

/// Fails where the posture lies outside the limits; `key` told it.
void set_leg(const Section& top, const std::string& key, Leg leg, const Vec3& q,
             model::RobotDescription& robot) {
  Eigen::Index bad = 0;
  robot.q_nominal.segment<3>(first_joint(leg)) = q;
  if (is_within_limits(robot, leg, q, bad)) return;
  const Eigen::Index joint = first_joint(leg) + bad;
  top.fail(key, std::string(kJointNames[static_cast<std::size_t>(bad)]) +
                    formatted(" at %g rad lies outside limits.position_min and position_max, "
                              "%g to %g rad",
                              q[bad], robot.q_min[joint], robot.q_max[joint]));
}

/// Hind legs mirror HFE and KFE of a front leg (X-configuration), or copy them if limits forbid
/// that; middle legs copy them, or mirror them if limits forbid that.
void set_posture(const Section& top, const Vec3& front, Leg leg, model::RobotDescription& robot) {
  const Vec3 mirrored(front.x(), -front.y(), -front.z());
  Eigen::Index bad = 0;
  const bool copies = is_front(leg) ||
                      (!is_hind(leg, robot.num_legs()) && is_within_limits(robot, leg, front, bad));
  const bool mirror = !copies && is_within_limits(robot, leg, mirrored, bad);
  set_leg(top, "posture.nominal", leg, mirror ? mirrored : front, robot);
}

/// Sets the nominal posture from the limits: X-configuration if possible, else all knees backward,
/// else all forward. Knees bend by 0.8 rad, or by the least greater angle within their limits.
void choose_posture(const Section& top, const model::RobotModel& model,
                    model::RobotDescription& robot) {
  constexpr double kLeastBend = 0.8, kMostBend = 2.0, kStep = 0.05;
  constexpr double kSmallTurn = 1e-3;  // to find a joint's direction [rad]
  const auto bent = [&](Leg leg, bool is_backward) -> std::optional<Vec3> {
    const double x = model.foot_in_base(leg, Vec3::Zero()).x();
    const double hip_moves = model.foot_in_base(leg, Vec3(0.0, kSmallTurn, 0.0)).x() - x;
    const double knee_moves = model.foot_in_base(leg, Vec3(0.0, 0.0, kSmallTurn)).x() - x;
    const double side = is_backward ? 1.0 : -1.0;
    for (double bend = kLeastBend; bend < kMostBend; bend += kStep) {
      const Vec3 q(0.0, -std::copysign(0.5 * bend, side * hip_moves),
                   std::copysign(bend, side * knee_moves));
      Eigen::Index bad = 0;
      if (is_within_limits(robot, leg, q, bad)) return q;
    }
    return std::nullopt;
  };
  std::string bends;
  for (const Leg leg : robot.legs.legs()) {
    const bool back = bent(leg, true).has_value(), ahead = bent(leg, false).has_value();
    bends += (bends.empty() ? " " : ", ") + std::string(leg_name(leg, robot.num_legs())) +
             (back    ? ahead ? " bends both ways" : " bends backward"
              : ahead ? " bends forward"
                      : " does not bend");
  }
  for (const auto& [front, hind] :
       {std::pair{true, false}, std::pair{true, true}, std::pair{false, false}}) {
    bool fits = true;
    for (const Leg leg : robot.legs.legs()) {
      std::optional<Vec3> q = bent(leg, is_hind(leg, robot.num_legs()) ? hind : front);
      if (!q && !is_front(leg)) q = bent(leg, hind);
      if (q) robot.q_nominal.segment<3>(first_joint(leg)) = *q;
      fits = fits && q;
    }
    if (fits) return;
  }
  top.fail("posture.nominal",
           "this key is missing, and the joints' limits leave no posture with its knees bent by "
           "0.8 to 2 rad under the hips, left and right alike; by them" +
               bends);
}

/// Of a joint in the URDF.
int line_of(const model::Urdf& urdf, const std::string& joint) {
  return std::ranges::find(urdf.joints, joint, &model::UrdfJoint::name)->line;
}

/// A limit of each joint: from the file, of its leg or of all, else from the URDF.
class JointNumbers {
 public:
  JointNumbers(const Section& top, const model::Urdf& urdf, const RobotInFile& given)
      : top_(top), urdf_(urdf), given_(given) {}

  /// `lists`: of further joints, of a biped's legs and of arms, one after the other.
  [[nodiscard]] JointVector of(const char* key, LegJoints LimitsInFile::* limit,
                               double model::UrdfJoint::* described, bool is_positive,
                               const std::vector<double>& lists) const {
    JointVector numbers(given_.robot.num_joints());
    const std::vector<std::string> names = given_.robot.joint_names();
    for (Eigen::Index joint = 0; joint < numbers.size(); ++joint) {
      numbers[joint] =
          joint < num_walking_joints(given_.robot) ? of_leg(joint, limit) : of_list(joint, lists);
      if (!std::isnan(numbers[joint])) continue;
      const model::UrdfJoint& from = *std::ranges::find(
          urdf_.joints, names[static_cast<std::size_t>(joint)], &model::UrdfJoint::name);
      numbers[joint] = from.*described;
      if (std::isnan(numbers[joint]) || (is_positive && numbers[joint] <= 0.0)) {
        top_.fail(key_of(given_.robot, joint) + "." + key,
                  std::string("this key is missing, and the ") + urdf_.format() +
                      " does not limit joint \"" + from.name + "\" (" + urdf_.path + ":" +
                      std::to_string(from.line) + ")");
      }
    }
    return numbers;
  }

 private:
  [[nodiscard]] double of_leg(Eigen::Index joint, LegJoints LimitsInFile::* limit) const {
    const Eigen::Index i = joint % kJointsPerLeg;
    const auto leg = static_cast<std::size_t>(joint / kJointsPerLeg);
    const double own = (given_.legs[leg].limits.*limit)[i];
    return std::isnan(own) ? (given_.limits.*limit)[i] : own;
  }
  [[nodiscard]] double of_list(Eigen::Index joint, const std::vector<double>& lists) const {
    const auto i = static_cast<std::size_t>(joint - num_walking_joints(given_.robot));
    return i < lists.size() ? lists[i] : kNaN;
  }

  const Section& top_;
  const model::Urdf& urdf_;
  const RobotInFile& given_;
};

/// Numbers of all joints with lists; NaN: not given.
std::vector<double> listed(const RobotInFile& given, const model::RobotDescription& robot,
                           std::vector<double> JointLists::* numbers) {
  std::vector<double> all;
  const auto add = [&](std::vector<double> of_limb, std::size_t num_joints) {
    of_limb.resize(num_joints, kNaN);
    all.insert(all.end(), of_limb.begin(), of_limb.end());
  };
  for (std::size_t i = 0; i < robot.legs.size(); ++i) {
    const model::LegDescription& leg = robot.legs[i];
    add(given.legs[i].lists.*numbers, (robot.can_walk() ? leg.further : leg.joints).size());
  }
  for (std::size_t i = 0; i < robot.arms.size(); ++i)
    add(given.arms[i].lists.*numbers, robot.arms[i].joints.size());
  return all;
}

JointVector or_else(const LegJoints& given, const JointVector& others, int num_walking_joints) {
  JointVector all = others;
  for (Eigen::Index i = 0; i < num_walking_joints; ++i) {
    if (!std::isnan(given[i % kJointsPerLeg])) all[i] = given[i % kJointsPerLeg];
  }
  return all;
}

/// A gain of each joint: the leg's own, else that of all legs, else `usual`. Further joints and
/// those of arms and of two legs have the one number that is given for all.
JointVector gains_of(const RobotInFile& given, const model::RobotDescription& robot,
                     LegJoints GainsInFile::* gain, double usual) {
  const LegJoints& all = given.gains.*gain;
  const bool is_one = !robot.can_walk() || (all.array() == all.x()).all();
  JointVector result = JointVector::Constant(robot.num_joints(), usual);
  if (is_one && !std::isnan(all.x())) result.setConstant(all.x());
  if (!robot.can_walk()) return result;
  result = or_else(all, result, num_walking_joints(robot));
  for (const Leg leg : robot.legs.legs()) {
    const LegJoints& own = given.legs[index(leg)].gains.*gain;
    for (Eigen::Index j = 0; j < kJointsPerLeg; ++j) {
      if (!std::isnan(own[j])) result[first_joint(leg) + j] = own[j];
    }
  }
  return result;
}

}  // namespace

void complete_limits(const Section& top, const model::Urdf& urdf, const RobotInFile& given,
                     model::RobotDescription& robot) {
  const JointNumbers numbers(top, urdf, given);
  using model::UrdfJoint;
  using Limits = LimitsInFile;
  robot.torque_limit = numbers.of("torque", &Limits::torque, &UrdfJoint::effort, true,
                                  listed(given, robot, &JointLists::torque));
  robot.velocity_limit = numbers.of("velocity", &Limits::velocity, &UrdfJoint::velocity, true,
                                    listed(given, robot, &JointLists::velocity));
  robot.q_min = numbers.of("position_min", &Limits::position_min, &UrdfJoint::lower, false,
                           listed(given, robot, &JointLists::position_min));
  robot.q_max = numbers.of("position_max", &Limits::position_max, &UrdfJoint::upper, false,
                           listed(given, robot, &JointLists::position_max));
  for (Eigen::Index i = 0; i < robot.num_joints(); ++i) {
    if (robot.q_min[i] < robot.q_max[i]) continue;
    top.fail(key_of(robot, i) + ".position_max",
             formatted("must be above position_min at every joint, but joint \"%s\" has %g and %g "
                       "rad, here or in %s:%d",
                       robot.joint_names()[static_cast<std::size_t>(i)].c_str(), robot.q_max[i],
                       robot.q_min[i], urdf.path.c_str(),
                       line_of(urdf, robot.joint_names()[static_cast<std::size_t>(i)])));
  }
  const int first = num_walking_joints(robot);
  robot.stall_torque = or_else(given.stall_torque, robot.torque_limit, first);
  robot.no_load_speed = or_else(given.no_load_speed, robot.velocity_limit, first);
  const std::vector<double> posture = listed(given, robot, &JointLists::posture);
  robot.q_nominal = JointVector::Zero(robot.num_joints());
  for (Eigen::Index i = first; i < robot.num_joints(); ++i) {
    const double wanted = posture[static_cast<std::size_t>(i - first)];
    const double q = std::clamp(std::isnan(wanted) ? 0.0 : wanted, robot.q_min[i], robot.q_max[i]);
    robot.q_nominal[i] = q;
    if (std::isnan(wanted) || wanted == q) continue;
    top.fail(key_of(robot, i) + ".posture",
             formatted("the posture of joint \"%s\" is %g rad; its limits allow %g to %g rad",
                       robot.joint_names()[static_cast<std::size_t>(i)].c_str(), wanted,
                       robot.q_min[i], robot.q_max[i]));
  }
}

void complete_posture(const Section& top, const RobotInFile& given, const model::RobotModel& model,
                      model::RobotDescription& robot) {
  const auto is_own = [&](Leg leg) {
    return !given.legs[index(leg)].nominal.array().isNaN().any();
  };
  const bool is_chosen = given.nominal.array().isNaN().any();
  if (is_chosen && !std::ranges::all_of(robot.legs.legs(), is_own))
    choose_posture(top, model, robot);
  for (const Leg leg : robot.legs.legs()) {
    if (is_own(leg)) {
      set_leg(top, key_of(leg, robot.num_legs()) + "posture.nominal", leg,
              given.legs[index(leg)].nominal, robot);
    } else if (!is_chosen) {
      set_posture(top, given.nominal, leg, robot);
    }
  }
}

/// Delays of drives don't go with size: the damping of a smaller robot does not act faster than the
/// reference's, as kd / (m l²).
void complete_gains(const RobotInFile& given, model::RobotDescription& robot) {
  const double stiffness = robot.scale.torque();
  const double damping = stiffness * std::min(robot.scale.time(), robot.scale.length);
  robot.hold_kp = gains_of(given, robot, &GainsInFile::kp, 80.0 * stiffness);
  robot.hold_kd = gains_of(given, robot, &GainsInFile::kd, 4.0 * damping);
  robot.damping_kd = gains_of(given, robot, &GainsInFile::damping, 6.0 * damping);
}

void complete_feet(const RobotInFile& given, model::RobotDescription& robot) {
  for (const Leg leg : robot.legs.legs()) {
    const LegInFile& own = given.legs[index(leg)];
    model::LegDescription& foot = robot.legs[index(leg)];
    foot.foot_radius = std::isnan(own.foot_radius) ? given.foot_radius : own.foot_radius;
    foot.foot_center = own.foot_center.array().isNaN().any() ? given.foot_center : own.foot_center;
    if (std::isnan(foot.foot_radius)) foot.foot_radius = 0.0;  // a sole
  }
}

}  // namespace surefoot::config
