#include "surefoot/control/standing_torque.hpp"

#include "surefoot/model/leg_jacobian.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace surefoot::control {
namespace {

/// Vertical foot forces [N] with Σ f = m g and, unless one would pull, this moment about the COM.
template <int kCount>
PerLeg<double> bearing_forces(const model::Dynamics& dynamics, const Vec3& moment) {
  Eigen::Matrix<double, 3, kCount> balance;
  for (const Leg leg : first_legs(kCount)) {
    const Vec3 arm = dynamics.contact[index(leg)].p - dynamics.com.p;
    balance.col(static_cast<Eigen::Index>(index(leg))) << 1.0, arm.x(), arm.y();
  }
  const Vec3 wanted(dynamics.mass * kGravity, -moment.y(), moment.x());  // of Σ f, Σ x f, Σ y f
  const Mat3 gram = balance * balance.transpose();
  const Eigen::Matrix<double, kCount, 1> forces =
      (balance.transpose() * gram.ldlt().solve(wanted)).cwiseMax(0.0);
  PerLeg<double> result(kCount, 0.0);
  Eigen::Map<Eigen::Matrix<double, kCount, 1>>(result.data()) = wanted.x() / forces.sum() * forces;
  return result;
}

/// The same of flat feet: forces at the corners of the soles, given as a force and a moment each.
JointVector flat_footed_torque(const model::Dynamics& dynamics) {
  constexpr int kMaxCorners = 4 * kMaxLegs;
  const int num_joints = dynamics.num_joints();
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxCorners> balance(
      3, 4 * dynamics.num_legs());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxCorners, kMaxJoints>
      rows(balance.cols(), num_joints);
  Eigen::Index corner = 0;
  for (const Leg leg : dynamics.contact.legs()) {
    const model::PointKinematics& contact = dynamics.contact[index(leg)];
    const model::RotationKinematics& foot = dynamics.shank[index(leg)];
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        const Vec3 lever = foot.R * Vec3(x * dynamics.sole.x(), y * dynamics.sole.y(), 0.0);
        const Vec3 arm = contact.p + lever - dynamics.com.p;
        balance.col(corner) << 1.0, arm.x(), arm.y();
        const Vec3 moment = lever.cross(Vec3::UnitZ());
        rows.row(corner++) =
            contact.J.row(2).tail(num_joints) + moment.transpose() * foot.J.rightCols(num_joints);
      }
    }
  }
  const Vec3 weight(dynamics.mass * kGravity, 0.0, 0.0);
  const Mat3 gram = balance * balance.transpose();
  const Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxCorners, 1> forces =
      (balance.transpose() * gram.ldlt().solve(weight)).cwiseMax(0.0);
  return dynamics.h.tail(num_joints) - rows.transpose() * (weight.x() / forces.sum() * forces);
}

}  // namespace

Mat3 limp_inertia(const model::Dynamics& dynamics) {
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, kMaxVelocities, 3>;
  Columns moments = Columns::Zero(dynamics.num_velocities(), 3);
  moments.middleRows<3>(3).setIdentity();
  const Columns accelerations = dynamics.M.llt().solve(moments);
  return accelerations.middleRows<3>(3).inverse();
}

RobotState level_at_rest(const JointVector& q) {
  RobotState state;
  state.p_WB.setZero();
  state.q_WB.setIdentity();
  state.v_WB.setZero();
  state.w_WB_B.setZero();
  state.q = q;
  state.qd.setZero(q.size());
  return state;
}

JointVector standing_torque(model::RobotModel& model, const JointVector& q,
                            const Righting& righting) noexcept {
  RobotState state = level_at_rest(q);
  state.q_WB = righting.q_WB;
  const model::Dynamics& dynamics = model.update(state, Vec3::UnitZ());
  if (dynamics.has_flat_feet()) return flat_footed_torque(dynamics);
  const PerLeg<double> force = dynamics.num_legs() == kNumLegs
                                   ? bearing_forces<kNumLegs>(dynamics, righting.moment)
                                   : bearing_forces<kMaxLegs>(dynamics, righting.moment);
  JointVector torque = dynamics.h.tail(q.size());
  for (const Leg leg : force.legs()) {
    const model::Jacobian3& J = dynamics.contact[index(leg)].J;
    torque -= force[index(leg)] * J.row(2).tail(q.size()).transpose();
  }
  return torque;
}

Vec3 borne_force(model::RobotModel& model, const JointVector& q,
                 const JointVector& torque) noexcept {
  const model::Dynamics& dynamics = model.update(level_at_rest(q), Vec3::UnitZ());
  const JointVector by_ground = dynamics.h.tail(q.size()) - torque;
  Vec3 force = Vec3::Zero();
  for (const Leg leg : dynamics.contact.legs()) {
    const Mat3 inverse = model::damped_inverse(
        model::leg_jacobian(dynamics.contact[index(leg)], leg), dynamics.scale);
    force += inverse.transpose() * by_ground.segment<kJointsPerLeg>(first_joint(leg));
  }
  return force;
}

}  // namespace surefoot::control
