#include "surefoot/model/leg_jacobian.hpp"

#include <Eigen/LU>

namespace surefoot::model {
namespace {

constexpr double kDamping = 0.01;  // δ [m]

}  // namespace

Mat3 leg_jacobian(const PointKinematics& point, Leg leg) {
  return point.J.middleCols<kJointsPerLeg>(6 + first_joint(leg));
}

Mat3 damped_inverse(const Mat3& J, const Scale& scale) {
  const double damping = scale.length * kDamping;
  const Mat3 squared = J * J.transpose() + damping * damping * Mat3::Identity();
  return J.transpose() * squared.inverse();
}

}  // namespace surefoot::model
