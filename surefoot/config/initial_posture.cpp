#include "surefoot/config/initial_posture.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/planning/foothold_planner.hpp"

#include <cmath>
#include <string>

namespace surefoot {

namespace {

// Well bent, so that the straight leg does not lie between start and solution [rad].
constexpr double kBentHip = 0.6;
constexpr double kBentKnee = 1.2;

}  // namespace

Vec3 knee_side(const RobotDescription& robot, Leg leg, KneeConfiguration knees) {
  const bool backward =
      knees == KneeConfiguration::backward || (knees == KneeConfiguration::x && is_front(leg));
  const double side = backward == is_front(leg) ? 1.0 : -1.0;
  const Vec3 nominal = robot.q_nominal.segment<3>(first_joint(leg));
  return {nominal.x(), std::copysign(kBentHip, side * nominal.y()),
          std::copysign(kBentKnee, side * nominal.z())};
}

JointVector stance_posture(const RobotModel& model, const StanceOptions& stance) {
  JointVector q = JointVector::Zero();
  for (const Leg leg : kLegs) {
    Vec3 p_BF;
    p_BF << nominal_offset(stance, leg), -stance.height;
    Vec3 q_leg = Vec3::Zero();
    if (!model.inverse_kinematics(leg, p_BF, knee_side(model.description(), leg, stance.knees),
                                  q_leg)) {
      throw Error(
          "planner.stance: foot " + std::string(kLegNames[index(leg)]) +
          " can't reach its place; half_length, half_width and height are too far for the leg");
    }
    q.segment<3>(first_joint(leg)) = q_leg;
  }
  return q;
}

}  // namespace surefoot
