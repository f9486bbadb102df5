#include "surefoot/estimation/joint_observer.hpp"

#include <cmath>

namespace surefoot {

JointObserver::JointObserver(double bandwidth, double period) : period_(period) {
  const double theta = std::exp(-bandwidth * period);
  alpha_ = 1.0 - theta * theta * theta;
  beta_ = 1.5 * (1.0 - theta) * (1.0 - theta) * (1.0 + theta);
  gamma_ = 0.5 * std::pow(1.0 - theta, 3);
}

void JointObserver::start(const JointVector& q) noexcept {
  q_ = q;
  velocity_.setZero();
  disturbance_.setZero();
  expected_.setZero();
}

void JointObserver::start(Eigen::Index joint, double q) noexcept {
  q_[joint] = q;
  velocity_[joint] = disturbance_[joint] = expected_[joint] = 0.0;
}

void JointObserver::update(const JointVector& q, int periods) noexcept {
  const double dt = periods * period_;
  const JointVector acceleration = expected_ + disturbance_;
  q_ += dt * velocity_ + 0.5 * dt * dt * acceleration;
  velocity_ += dt * acceleration;
  for (Eigen::Index i = 0; i < kNumJoints; ++i) {
    if (std::isnan(q_[i]) && std::isfinite(q[i])) start(i, q[i]);
    const double error = q[i] - q_[i];
    if (!std::isfinite(error)) continue;
    q_[i] += alpha_ * error;
    velocity_[i] += beta_ / period_ * error;
    disturbance_[i] += 2.0 * gamma_ / (period_ * period_) * error;
  }
}

}  // namespace surefoot
