#include "surefoot/model/limb_dynamics.hpp"

#include <Eigen/Cholesky>

namespace surefoot::model {
namespace {

constexpr double kDamping = 0.01;  // δ [m], and of moments [rad]

}  // namespace

LimbDynamics::LimbDynamics(const Dynamics& dynamics, Leg leg) noexcept
    : dynamics_(dynamics), joints_(dynamics.leg_joints[index(leg)]) {
  const int first = 6 + joints_.first, n = joints_.count;
  const PointKinematics& contact = dynamics.contact[index(leg)];
  const RotationKinematics& foot = dynamics.shank[index(leg)];
  M_ = dynamics.M.block(first, first, n, n);
  J_.resize(6, n);
  J_ << contact.J.middleCols(first, n), foot.J.middleCols(first, n);
  J_base_ << contact.J.leftCols<6>(), foot.J.leftCols<6>();
  Jdot_u_ << contact.Jdot_u, foot.Jdot_u;
  const double damping = dynamics.scale.length * kDamping;
  squared_.noalias() = J_ * J_.transpose();
  squared_.diagonal().array() += damping * damping;
}

LimbDynamics::Joints LimbDynamics::free_acceleration(const JointVector& torque,
                                                     const Vector6& base) const {
  const int first = 6 + joints_.first, n = joints_.count;
  const Joints left = torque.segment(joints_.first, n) - dynamics_.h.segment(first, n) -
                      dynamics_.M.block(first, 0, n, 6) * base;
  return M_.llt().solve(left);
}

LimbDynamics::Joints LimbDynamics::stance_acceleration(const Vector6& base) const {
  const Vector6 rest = J_base_ * base + Jdot_u_;
  return -(J_.transpose() * squared_.llt().solve(rest));
}

LimbDynamics::Vector6 LimbDynamics::wrench(const JointVector& acceleration) const {
  const Vector6 pressed = J_ * (M_ * acceleration.segment(joints_.first, joints_.count));
  return squared_.llt().solve(pressed);
}

}  // namespace surefoot::model
