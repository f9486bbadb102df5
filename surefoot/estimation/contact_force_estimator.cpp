#include "surefoot/estimation/contact_force_estimator.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr double kInverseDamping = 0.01;  // [m], of the 3×3 leg Jacobian near the straight leg

}  // namespace

ContactForceEstimator::ContactForceEstimator(const ContactForceOptions& options, double period)
    : options_(options),
      period_(period),
      decay_(std::exp(-2.0 * kPi * options.cutoff_hz * period)) {}

void ContactForceEstimator::update(const Dynamics& dynamics, const Vec3& terrain_normal_W,
                                   const SensorReading& reading, RobotState& state) noexcept {
  // Whole periods, so that a clock that rounds changes nothing; 1 also where a time is NaN.
  const double periods = std::max(1.0, std::round((state.time - previous_time_) / period_));
  const GeneralizedVector acceleration =
      initialised_ ? GeneralizedVector((dynamics.u - previous_u_) / (periods * period_))
                   : GeneralizedVector::Zero();
  const double gain = initialised_ ? 1.0 - std::pow(decay_, periods) : 1.0;
  previous_u_ = dynamics.u;
  previous_time_ = state.time;
  const JointVector residual = dynamics.M.bottomRows<kNumJoints>() * acceleration +
                               dynamics.h.tail<kNumJoints>() - state.torque;
  residual_ += gain * (residual - residual_);
  initialised_ = true;
  for (const Leg leg : kLegs) {
    const std::size_t k = index(leg);
    const Mat3 J = dynamics.contact[k].J.middleCols<kJointsPerLeg>(6 + first_joint(leg));
    const Vec3 torque = residual_.segment<kJointsPerLeg>(first_joint(leg));
    const Mat3 normal_matrix =
        J * J.transpose() + kInverseDamping * kInverseDamping * Mat3::Identity();
    state.foot_force[k] = normal_matrix.inverse() * (J * torque);
    if (options_.use_foot_sensor && std::isfinite(reading.foot_force[k])) {
      state.foot_force[k] = reading.foot_force[k] * terrain_normal_W;
    }
  }
}

}  // namespace surefoot
