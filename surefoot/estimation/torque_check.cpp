#include "surefoot/estimation/torque_check.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {

TorqueCheck::TorqueCheck(const TorqueCheckOptions& options, double period)
    : options_(options),
      gain_(1.0 - std::exp(-period / options.time_constant)),
      claim_(
          {.time_constant = options.time_constant, .load_time_constant = options.time_constant}) {}

void TorqueCheck::forget() noexcept { error_.setZero(); }

void TorqueCheck::update(const RobotState& state, const Dynamics& dynamics,
                         const PerLeg<bool>& stands, const JointVector& command) noexcept {
  const JointVector error = state.torque - command;
  if (error.allFinite()) error_ += gain_ * (error - error_);
  RobotState claimed = state;
  claim_.update(dynamics, stands, claimed);
}

int TorqueCheck::joint() const {
  int result = -1, count = 0;
  for (int i = 0; i < kNumJoints; ++i) {
    if (!(std::abs(error_[i]) > options_.max_error)) continue;
    result = i;
    ++count;
  }
  return count == 1 ? result : -1;
}

double TorqueCheck::error_share() const {
  return error_.cwiseAbs().maxCoeff() / options_.max_error;
}

double TorqueCheck::claim_share() const {
  return std::max(claim_.force().norm() / options_.max_force,
                  claim_.moment().norm() / options_.max_moment);
}

}  // namespace surefoot
