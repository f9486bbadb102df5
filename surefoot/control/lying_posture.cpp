#include "surefoot/control/lying_posture.hpp"

#include <cmath>

namespace surefoot::control {
namespace {

// Initial guess, well bent: the singular straight leg is not on the way to the solution [rad].
constexpr double kFoldedHip = 1.3;
constexpr double kFoldedKnee = 2.4;

}  // namespace

JointVector lying_posture(const model::RobotModel& model, double height) {
  const model::RobotDescription& robot = model.description();
  JointVector result = robot.q_nominal;
  if (!robot.can_walk()) return result;
  for (const Leg leg : robot.legs.legs()) {
    const Vec3 nominal = robot.q_nominal.segment<3>(first_joint(leg));
    const Vec3 hip = model.hip_in_base(leg, nominal);
    const Vec3 p_BF(hip.x(), model.foot_in_base(leg, nominal).y(), hip.z() - height);
    const Vec3 guess(nominal.x(), std::copysign(kFoldedHip, nominal.y()),
                     std::copysign(kFoldedKnee, nominal.z()));
    Vec3 q;
    (void)model.inverse_kinematics(leg, p_BF, guess, q);
    result.segment<3>(first_joint(leg)) = q;
  }
  return result.cwiseMax(robot.q_min).cwiseMin(robot.q_max);
}

}  // namespace surefoot::control
