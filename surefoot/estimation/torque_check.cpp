#include "surefoot/estimation/torque_check.hpp"

#include <cmath>

namespace surefoot {
namespace {

constexpr double kSmoothing = 0.02;  // of a joint's error [s]
constexpr double kSure = 0.01;       // an IMU that lies lets torques claim much for a moment [s]

}  // namespace

TorqueCheck::TorqueCheck(const TorqueCheckOptions& options, double period)
    : options_(options),
      period_(period),
      gain_(1.0 - std::exp(-period / kSmoothing)),
      claim_(
          {.time_constant = options.time_constant, .load_time_constant = options.time_constant}) {}

void TorqueCheck::forget() noexcept {
  error_.setZero();
  off_for_.setZero();
  claims_for_ = 0.0;
}

void TorqueCheck::update(const RobotState& state, const Dynamics& dynamics,
                         const PerLeg<bool>& stands, const JointVector& command,
                         bool moves_exactly) noexcept {
  const JointVector before = error_;
  const JointVector error = state.torque - command;
  if (error.allFinite()) error_ += gain_ * (error - error_);
  for (int i = 0; i < kNumJoints; ++i) {
    const bool is_off = std::abs(error_[i]) > options_.max_error && error_[i] * before[i] > 0.0;
    off_for_[i] = is_off ? off_for_[i] + period_ : 0.0;
  }
  exact_for_ = moves_exactly ? exact_for_ + period_ : 0.0;
  RobotState claimed;  // no more of the state than the claim is made from
  claimed.time = state.time;
  claimed.foot_force = state.foot_force;
  claim_.update(dynamics, stands, claimed);
  const bool claims =
      claim_.force().norm() > options_.max_force || claim_.moment().norm() > options_.max_moment;
  claims_for_ = claims && exact_for_ >= options_.time_constant ? claims_for_ + period_ : 0.0;
}

double TorqueCheck::wrong_for() const {
  const double longest = off_for_.maxCoeff();
  if (longest > options_.duration) return longest;
  return claims_for_ > kSure ? options_.time_constant + claims_for_ : 0.0;
}

int TorqueCheck::joint() const {
  int result = -1, count = 0;
  for (int i = 0; i < kNumJoints; ++i) {
    if (!(off_for_[i] > options_.duration)) continue;
    result = i;
    ++count;
  }
  return count == 1 ? result : -1;
}

}  // namespace surefoot
