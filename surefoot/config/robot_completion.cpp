#include "surefoot/config/robot_completion.hpp"

#include "surefoot/base/formatted.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace surefoot::config {
namespace {

/// Is a leg's posture within the limits? `bad` gets the joint that is not.
bool is_within_limits(const model::RobotDescription& robot, Leg leg, const Vec3& q,
                      Eigen::Index& bad) {
  const Eigen::Index first = first_joint(leg);
  for (bad = 0; bad < kJointsPerLeg; ++bad) {
    if (q[bad] < robot.q_min[first + bad] || q[bad] > robot.q_max[first + bad]) return false;
  }
  return true;
}

/// Hind legs mirror HFE and KFE of a front leg (X-configuration), but where their limits leave that
/// out, they stand like the front ones.
void set_posture(const Section& top, const Vec3& front, model::RobotDescription& robot) {
  for (const Leg leg : kLegs) {
    const Vec3 mirrored(front.x(), -front.y(), -front.z());
    Eigen::Index bad = 0;
    const bool mirror = !is_front(leg) && is_within_limits(robot, leg, mirrored, bad);
    const Vec3 q = mirror ? mirrored : front;
    robot.q_nominal.segment<3>(first_joint(leg)) = q;
    if (is_within_limits(robot, leg, q, bad)) continue;
    const Eigen::Index joint = first_joint(leg) + bad;
    top.fail("posture.nominal",
             std::string(kJointNames[static_cast<std::size_t>(bad)]) +
                 formatted(" at %g rad lies outside limits.position_min and position_max, "
                           "%g to %g rad",
                           q[bad], robot.q_min[joint], robot.q_max[joint]));
  }
}

/// The nominal posture of legs whose limits leave one side of the knee, or both: X-configuration
/// where that is possible, else all knees backward, else all forward. The knee is bent by 0.8 rad,
/// or by as little more as its limits allow.
void choose_posture(const Section& top, const model::RobotModel& model,
                    model::RobotDescription& robot) {
  constexpr double kLeastBend = 0.8, kMostBend = 2.0, kStep = 0.05;
  constexpr double kSmallTurn = 1e-3;  // that tells which way a joint turns [rad]
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
  for (const auto& [front, hind] :
       {std::pair{true, false}, std::pair{true, true}, std::pair{false, false}}) {
    bool fits = true;
    for (const Leg leg : kLegs) {
      const std::optional<Vec3> q = bent(leg, is_front(leg) ? front : hind);
      if (q) robot.q_nominal.segment<3>(first_joint(leg)) = *q;
      fits = fits && q;
    }
    if (fits) return;
  }
  top.fail("posture.nominal",
           "this key is missing, and the joints' limits leave no posture with its knees bent by "
           "0.8 to 2 rad under the hips");
}

/// A number of each joint: the file's, else the URDF's.
class JointNumbers {
 public:
  JointNumbers(const Section& top, const model::Urdf& urdf, const model::RobotDescription& robot)
      : top_(top), urdf_(urdf), robot_(robot) {}

  [[nodiscard]] JointVector of(const char* key, const LegJoints& given,
                               double model::UrdfJoint::* described, bool is_positive) const {
    JointVector numbers = JointVector::Zero();
    for (const Leg leg : kLegs) {
      for (std::size_t i = 0; i < kJointsPerLeg; ++i) {
        const Eigen::Index joint = first_joint(leg) + static_cast<Eigen::Index>(i);
        numbers[joint] = given[static_cast<Eigen::Index>(i)];
        if (!std::isnan(numbers[joint])) continue;
        const model::UrdfJoint& from = *std::ranges::find(
            urdf_.joints, robot_.legs[index(leg)].joints[i], &model::UrdfJoint::name);
        numbers[joint] = from.*described;
        if (std::isnan(numbers[joint]) || (is_positive && numbers[joint] <= 0.0)) {
          top_.fail(key, std::string("this key is missing, and the ") + urdf_.format() +
                             " does not limit joint \"" + from.name + "\" (" + urdf_.path + ":" +
                             std::to_string(from.line) + ")");
        }
      }
    }
    return numbers;
  }

 private:
  const Section& top_;
  const model::Urdf& urdf_;
  const model::RobotDescription& robot_;
};

JointVector or_else(const LegJoints& given, const JointVector& others) {
  const JointVector all = given.replicate<kNumLegs, 1>();
  return all.array().isNaN().select(others, all);
}

}  // namespace

void complete_leg(const Section& top, const model::Urdf& urdf, const std::string& base,
                  const std::string& key, model::LegDescription& leg) {
  std::vector<const model::UrdfJoint*> chain;
  for (std::string link = leg.foot_frame; link != base && link != urdf.root;) {
    const auto joint = std::ranges::find(urdf.joints, link, &model::UrdfJoint::child);
    if (joint->type != "fixed") chain.insert(chain.begin(), &*joint);
    link = joint->parent;
  }
  if (leg.joints.front().empty()) {
    std::string names;
    for (const model::UrdfJoint* joint : chain) names += " " + joint->name;
    if (chain.size() != leg.joints.size()) {
      top.fail(key, "between the base and \"" + leg.foot_frame + "\" there are " +
                        std::to_string(chain.size()) + " joints that move:" +
                        (names.empty() ? " none" : names) + "; a leg has three, HAA, HFE and KFE");
    }
    for (std::size_t i = 0; i < chain.size(); ++i) leg.joints[i] = chain[i]->name;
  }
  const auto moved_by = [&](const std::string& name) {
    const auto joint = std::ranges::find(urdf.joints, name, &model::UrdfJoint::name);
    return joint == urdf.joints.end() ? std::string() : joint->child;
  };
  if (leg.thigh_link.empty()) leg.thigh_link = moved_by(leg.joints[1]);
  if (leg.hip_frame.empty()) leg.hip_frame = leg.thigh_link;
  if (leg.shank_link.empty()) leg.shank_link = moved_by(leg.joints[2]);
}

void complete_limits(const Section& top, const model::Urdf& urdf, const RobotInFile& given,
                     model::RobotDescription& robot) {
  const JointNumbers numbers(top, urdf, robot);
  using model::UrdfJoint;
  robot.torque_limit = numbers.of("limits.torque", given.torque, &UrdfJoint::effort, true);
  robot.velocity_limit = numbers.of("limits.velocity", given.velocity, &UrdfJoint::velocity, true);
  robot.q_min = numbers.of("limits.position_min", given.position_min, &UrdfJoint::lower, false);
  robot.q_max = numbers.of("limits.position_max", given.position_max, &UrdfJoint::upper, false);
  for (Eigen::Index i = 0; i < kNumJoints; ++i) {
    if (robot.q_min[i] < robot.q_max[i]) continue;
    top.fail("limits.position_max",
             formatted("must be above position_min at every joint, but joint \"%s\" has %g and %g "
                       "rad",
                       robot.legs[static_cast<std::size_t>(i / kJointsPerLeg)]
                           .joints[static_cast<std::size_t>(i % kJointsPerLeg)]
                           .c_str(),
                       robot.q_min[i], robot.q_max[i]));
  }
  robot.stall_torque = or_else(given.stall_torque, robot.torque_limit);
  robot.no_load_speed = or_else(given.no_load_speed, robot.velocity_limit);
}

void complete_posture(const Section& top, const Vec3& front, const model::RobotModel& model,
                      model::RobotDescription& robot) {
  if (front.array().isNaN().any()) {
    choose_posture(top, model, robot);
  } else {
    set_posture(top, front, robot);
  }
}

void complete_gains(model::RobotDescription& robot) {
  const double stiffness = robot.scale.torque(), damping = stiffness * robot.scale.time();
  if (std::isnan(robot.hold_kp)) robot.hold_kp = 80.0 * stiffness;
  if (std::isnan(robot.hold_kd)) robot.hold_kd = 4.0 * damping;
  if (std::isnan(robot.damping_kd)) robot.damping_kd = 6.0 * damping;
}

}  // namespace surefoot::config
