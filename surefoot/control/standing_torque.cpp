#include "surefoot/control/standing_torque.hpp"

#include <Eigen/Cholesky>

namespace surefoot {
namespace {

/// Vertical forces at the feet with Σ f = m g, and, unless one would pull, no moment about the
/// centre of mass.
Eigen::Vector4d bearing_forces(const Dynamics& dynamics) {
  Eigen::Matrix<double, 3, kNumLegs> balance;
  for (const Leg leg : kLegs) {
    const Vec3 arm = dynamics.contact[index(leg)].p - dynamics.com.p;
    balance.col(static_cast<Eigen::Index>(index(leg))) << 1.0, arm.x(), arm.y();
  }
  const Vec3 weight(dynamics.mass * kGravity, 0.0, 0.0);
  const Mat3 gram = balance * balance.transpose();
  const Eigen::Vector4d pushes = (balance.transpose() * gram.ldlt().solve(weight)).cwiseMax(0.0);
  return weight.x() / pushes.sum() * pushes;
}

}  // namespace

JointVector standing_torque(RobotModel& model, const JointVector& q) noexcept {
  RobotState level;
  level.p_WB.setZero();
  level.q_WB.setIdentity();
  level.v_WB.setZero();
  level.w_WB_B.setZero();
  level.q = q;
  level.qd.setZero();
  const Dynamics& dynamics = model.update(level, Vec3::UnitZ());
  const Eigen::Vector4d force = bearing_forces(dynamics);
  JointVector torque = dynamics.h.tail<kNumJoints>();
  for (const Leg leg : kLegs) {
    const Jacobian3& J = dynamics.contact[index(leg)].J;
    torque -=
        force[static_cast<Eigen::Index>(index(leg))] * J.row(2).tail<kNumJoints>().transpose();
  }
  return torque;
}

}  // namespace surefoot
