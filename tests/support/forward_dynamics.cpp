#include "tests/support/forward_dynamics.hpp"

#include "tests/support/linear_algebra.hpp"
#include "tests/support/sizes.hpp"

namespace surefoot::test {
namespace {

VecX stacked_drifts(const model::Dynamics& dynamics, const MotionPlan& plan) {
  VecX drifts(3 * plan.num_contacts());
  Eigen::Index row = 0;
  for (const Leg leg : kLegs) {
    if (!plan.contact(leg)) continue;
    drifts.segment<3>(row) = dynamics.contact[index(leg)].Jdot_u;
    row += 3;
  }
  return drifts;
}

VecX with_torque(const VecX& acceleration, const JointVector& torque) {
  VecX x(acceleration.size() + torque.size());
  x << acceleration, torque;
  return x;
}

}  // namespace

JointVector random_torque(Random& random) {
  JointVector torque(kNumLegJoints);
  for (double& value : torque) value = random.uniform(-40.0, 40.0);
  return torque;
}

MatX stacked_jacobians(const model::Dynamics& dynamics, const MotionPlan& plan) {
  MatX J_s(3 * plan.num_contacts(), kNumVelocities);
  Eigen::Index row = 0;
  for (const Leg leg : kLegs) {
    if (!plan.contact(leg)) continue;
    J_s.middleRows<3>(row) = dynamics.contact[index(leg)].J;
    row += 3;
  }
  return J_s;
}

ForwardDynamics forward_dynamics(const model::Dynamics& dynamics, const MotionPlan& plan,
                                 const JointVector& torque) {
  const MatX J_s = stacked_jacobians(dynamics, plan);
  const Eigen::Index n = J_s.rows();
  MatX K = MatX::Zero(kNumVelocities + n, kNumVelocities + n);
  K.topLeftCorner(kNumVelocities, kNumVelocities) = dynamics.M;
  K.topRightCorner(kNumVelocities, n) = -J_s.transpose();
  K.bottomLeftCorner(n, kNumVelocities) = J_s;
  VecX b(kNumVelocities + n);
  b << -dynamics.h, -stacked_drifts(dynamics, plan);
  b.segment<kNumLegJoints>(6) += torque;
  const VecX solution = least_squares(K, b);
  return {with_torque(solution.head<kNumVelocities>(), torque), solution.tail(n)};
}

VecX accelerated_by(const model::Dynamics& dynamics, const MotionPlan& plan,
                    const JointVector& torque, const VecX& lambda) {
  VecX force = stacked_jacobians(dynamics, plan).transpose() * lambda - dynamics.h;
  force.tail<kNumLegJoints>() += torque;
  return with_torque(least_squares(dynamics.M, force), torque);
}

}  // namespace surefoot::test
