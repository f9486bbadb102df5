#include "surefoot/model/dynamics.hpp"

namespace surefoot::model {

Dynamics::Dynamics(int num_joints, std::size_t num_arms, int num_legs)
    : M(MassMatrix::Zero(6 + num_joints, 6 + num_joints)),
      h(GeneralizedVector::Zero(6 + num_joints)),
      u(GeneralizedVector::Zero(6 + num_joints)),
      q(JointVector::Zero(num_joints)),
      arm_tips(num_arms),
      bodies(static_cast<std::size_t>(1 + num_joints)) {
  const Jacobian3 none = Jacobian3::Zero(3, 6 + num_joints);
  base_rotation.J = base.J = com.J = none;
  for (PerLeg<PointKinematics>* points : {&hip, &foot, &contact}) points->resize(num_legs);
  shank.resize(num_legs);
  links.resize(num_legs);
  leg_joints.resize(num_legs);
  for (const Leg leg : foot.legs()) {
    const std::size_t k = index(leg);
    hip[k].J = foot[k].J = contact[k].J = shank[k].J = none;
  }
  for (FrameKinematics& tip : arm_tips) tip.point.J = tip.rotation.J = none;
}

}  // namespace surefoot::model
