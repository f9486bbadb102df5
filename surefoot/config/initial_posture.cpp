#include "surefoot/config/initial_posture.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace surefoot::config {

namespace {

// Start of the inverse kinematics, bent enough not to pass the straight leg [rad].
constexpr double kBentHip = 0.6;
constexpr double kBentKnee = 1.2;
// Tolerance of the joint limits, for rounding errors of the inverse kinematics [rad].
constexpr double kRounding = 1e-6;

}  // namespace

Vec3 knee_side(const model::RobotDescription& robot, Leg leg, gaits::KneeConfiguration knees) {
  const Leg front = is_left(leg) ? Leg::LF : Leg::RF;
  const Vec3 nominal = robot.q_nominal.segment<3>(first_joint(front));
  const bool as_front =
      is_front(leg) || (!is_hind(leg, robot.num_legs()) && can_bend(robot, leg, nominal.z()));
  const bool backward = knees == gaits::KneeConfiguration::backward ||
                        (knees == gaits::KneeConfiguration::x && as_front);
  const double side = backward ? 1.0 : -1.0;
  return {nominal.x(), std::copysign(kBentHip, side * nominal.y()),
          std::copysign(kBentKnee, side * nominal.z())};
}

bool can_bend(const model::RobotDescription& robot, Leg leg, double knee) {
  const Eigen::Index i = first_joint(leg) + 2;
  return knee < 0.0 ? robot.q_min[i] < -kSideBend : robot.q_max[i] > kSideBend;
}

gaits::KneeConfiguration knees_that_fit(const model::RobotDescription& robot,
                                        gaits::KneeConfiguration wanted) {
  if (!robot.can_walk()) return wanted;
  const auto fit = [&](gaits::KneeConfiguration knees) {
    return std::ranges::all_of(robot.legs.legs(), [&](Leg leg) {
      return can_bend(robot, leg, knee_side(robot, leg, knees).z());
    });
  };
  if (fit(wanted)) return wanted;
  for (const gaits::KneeConfiguration other :
       {gaits::KneeConfiguration::x, gaits::KneeConfiguration::backward,
        gaits::KneeConfiguration::forward}) {
    if (fit(other)) return other;
  }
  return wanted;
}

namespace {

/// Index of the first joint outside its limits; −1: none.
Eigen::Index outside_limits(const model::RobotDescription& robot, const JointVector& q) {
  for (Eigen::Index i = 0; i < kJointsPerLeg * robot.num_legs(); ++i) {
    if (q[i] < robot.q_min[i] - kRounding || q[i] > robot.q_max[i] + kRounding) return i;
  }
  return -1;
}

JointVector posture_of(const model::RobotModel& model, const gaits::StanceOptions& stance) {
  JointVector q = model.description().q_nominal;
  for (const Leg leg : model.description().legs.legs()) {
    Vec3 p_BF;
    p_BF << gaits::nominal_offset(stance, leg, model.description().num_legs()), -stance.height;
    Vec3 q_leg = Vec3::Zero();
    if (!model.inverse_kinematics(leg, p_BF, knee_side(model.description(), leg, stance.knees),
                                  q_leg)) {
      throw Error(
          "planner.stance: foot " + std::string(leg_name(leg, model.description().num_legs())) +
          " can't reach its place; half_length, half_width and height are too far for the leg");
    }
    q.segment<3>(first_joint(leg)) = q_leg;
  }
  return q;
}

/// Advice: a knee configuration that fits the limits; empty if there is none.
std::string other_knees(const model::RobotModel& model, gaits::StanceOptions stance) {
  for (const auto& [name, knees] : kKnees) {
    stance.knees = knees;
    try {
      if (outside_limits(model.description(), posture_of(model, stance)) < 0)
        return std::string("; knees: ") + name + " would fit";
    } catch (const Error&) {
      continue;  // out of reach
    }
  }
  return "";
}

}  // namespace

JointVector stance_posture(const model::RobotModel& model, const gaits::StanceOptions& stance) {
  if (!model.description().can_walk()) return model.description().q_nominal;
  const JointVector q = posture_of(model, stance);
  const model::RobotDescription& robot = model.description();
  const Eigen::Index i = outside_limits(robot, q);
  if (i < 0) return q;
  const auto leg = static_cast<std::size_t>(i / kJointsPerLeg);
  const auto joint = static_cast<std::size_t>(i % kJointsPerLeg);
  throw Error(formatted("planner.stance: it puts joint %s of %s, \"%s\", at %.3f rad, outside the "
                        "robot's limits.position_min and position_max, %g to %g rad",
                        kJointNames[joint].data(), leg_names(robot.num_legs())[leg].data(),
                        robot.legs[leg].joints[joint].c_str(), q[i], robot.q_min[i],
                        robot.q_max[i]) +
              other_knees(model, stance));
}

}  // namespace surefoot::config
