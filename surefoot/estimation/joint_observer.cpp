#include "surefoot/estimation/joint_observer.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr int kLongestBridge = 40;  // periods for which a prediction is useful

}  // namespace

JointObserver::JointObserver(double bandwidth, double period, int num_joints)
    : bandwidth_(bandwidth),
      period_(period),
      each_period_(gains_after(1)),
      q_(JointVector::Constant(num_joints, kNaN)),
      velocity_(JointVector::Zero(num_joints)),
      disturbance_(velocity_),
      expected_(velocity_) {}

JointObserver::Gains JointObserver::gains_after(int periods) const {
  const double dt = periods * period_;
  const double theta = std::exp(-bandwidth_ * dt);
  return {.q = 1.0 - theta * theta * theta,
          .velocity = 1.5 * (1.0 - theta) * (1.0 - theta) * (1.0 + theta) / dt,
          .disturbance = 2.0 * (0.5 * std::pow(1.0 - theta, 3)) / (dt * dt)};
}

void JointObserver::start(const JointVector& q) noexcept {
  q_ = q;
  velocity_.setZero();
  disturbance_.setZero();
  expected_.setZero();
  since_.fill(0);
}

void JointObserver::start(Eigen::Index joint, double q) noexcept {
  q_[joint] = q;
  velocity_[joint] = disturbance_[joint] = expected_[joint] = 0.0;
}

void JointObserver::go_back(int ticks) noexcept {
  const double dt = ticks * period_;
  const JointVector acceleration = expected_ + disturbance_;
  q_ -= dt * velocity_ - 0.5 * dt * dt * acceleration;
  velocity_ -= dt * acceleration;
}

void JointObserver::update(const JointVector& q, int periods) noexcept {
  const double dt = periods * period_;
  const JointVector acceleration = expected_ + disturbance_;
  q_ += dt * velocity_ + 0.5 * dt * dt * acceleration;
  velocity_ += dt * acceleration;
  for (Eigen::Index i = 0; i < q_.size(); ++i) {
    int& since = since_[static_cast<std::size_t>(i)];
    since = std::min(since, kLongestBridge) + periods;
    if (!std::isfinite(q[i])) continue;
    if (!std::isfinite(q_[i]) || since > kLongestBridge) start(i, q[i]);
    const Gains gains = since == 1 ? each_period_ : gains_after(since);
    const double error = q[i] - q_[i];
    q_[i] += gains.q * error;
    velocity_[i] += gains.velocity * error;
    disturbance_[i] += gains.disturbance * error;
    since = 0;
  }
}

}  // namespace surefoot::estimation
