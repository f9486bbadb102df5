#include "surefoot/doctor/limit_guesses.hpp"

#include "surefoot/config/robot_plausibility.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::doctor {

bool is_missing(double limit) { return std::isnan(limit) || limit <= 0.0; }

bool has_no_stops(const model::UrdfJoint& joint) {
  return std::isnan(joint.lower) || std::isnan(joint.upper);
}

double most_standing_torque(const Diagnosis& robot) {
  return robot.standing_torque.cwiseAbs().maxCoeff();
}

LimitGaps gaps_of(const Diagnosis& robot, const model::UrdfJoint& joint) {
  const bool turns = has_no_stops(joint) && joint.type == "continuous";
  return {.effort = is_missing(joint.effort) ||
                    config::is_effort_placeholder(joint.effort, most_standing_torque(robot)),
          .velocity = is_missing(joint.velocity) || config::is_velocity_placeholder(joint.velocity),
          .position = !turns && (has_no_stops(joint) ||
                                 config::is_position_placeholder(joint.lower, joint.upper)),
          .turns = turns};
}

bool has_gaps(const Diagnosis& robot) {
  if (!robot.anatomy.legs) return false;
  return std::ranges::any_of(*robot.anatomy.legs, [&](const FoundLeg& leg) {
    return std::ranges::any_of(leg.joints, [&](const model::UrdfJoint& joint) {
      const LimitGaps gaps = gaps_of(robot, joint);
      return gaps.effort || gaps.velocity || gaps.position;
    });
  });
}

std::vector<LimitGuess> limit_guesses(const Diagnosis& robot) {
  const Scale scale = robot.proportions ? model::scale_of(*robot.proportions) : Scale();
  const double torque = 40.0 * scale.torque(), velocity = 15.0 * scale.rate();
  const double of_arm = 6.0 * scale.rate();
  using Gaps = LimitGaps;
  using Joint = model::UrdfJoint;
  return {{"torque", &Gaps::effort, &Joint::effort, {torque, torque, torque}, torque, "N·m"},
          {"velocity",
           &Gaps::velocity,
           &Joint::velocity,
           {velocity, velocity, velocity},
           of_arm,
           "rad/s"},
          {"position_min", &Gaps::position, &Joint::lower, {-1.2, -2.6, -2.9}, -kPi, "rad"},
          {"position_max", &Gaps::position, &Joint::upper, {1.2, 2.6, 2.9}, kPi, "rad"}};
}

}  // namespace surefoot::doctor
