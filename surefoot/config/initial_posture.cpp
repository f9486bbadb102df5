#include "surefoot/config/initial_posture.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/planning/foothold_planner.hpp"

#include <string>

namespace surefoot {

Vec3 knee_side(Leg leg, KneeConfiguration knees) {
  // A knee that points backward has HFE > 0 and KFE < 0.
  const bool backward =
      knees == KneeConfiguration::backward || (knees == KneeConfiguration::x && is_front(leg));
  return backward ? Vec3(0.0, 0.6, -1.2) : Vec3(0.0, -0.6, 1.2);
}

JointVector stance_posture(const RobotModel& model, const StanceOptions& stance) {
  JointVector q = JointVector::Zero();
  for (const Leg leg : kLegs) {
    Vec3 p_BF;
    p_BF << nominal_offset(stance, leg), -stance.height;
    Vec3 q_leg = Vec3::Zero();
    if (!model.inverse_kinematics(leg, p_BF, knee_side(leg, stance.knees), q_leg)) {
      throw Error(
          "planner.stance: foot " + std::string(kLegNames[index(leg)]) +
          " can't reach its place; half_length, half_width and height are too far for the leg");
    }
    q.segment<3>(first_joint(leg)) = q_leg;
  }
  return q;
}

}  // namespace surefoot
