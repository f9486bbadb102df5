#include "surefoot/estimation/torque_check.hpp"

#include "surefoot/model/leg_jacobian.hpp"

#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kSmoothing = 0.02;      // of a joint's error [s]
constexpr double kMinClaimTime = 0.01;   // a faulty IMU causes short claims [s]
constexpr double kMaxUnexplained = 0.5;  // share of a claim that torque errors must leave at most

}  // namespace

TorqueCheck::TorqueCheck(const TorqueCheckOptions& options, double period, int num_joints)
    : options_(options),
      period_(period),
      gain_(1.0 - std::exp(-period / kSmoothing)),
      claim_gain_(1.0 - std::exp(-period / options.time_constant)),
      error_(JointVector::Zero(num_joints)),
      off_for_(error_),
      claim_(
          {.time_constant = options.time_constant, .load_time_constant = options.time_constant}) {}

void TorqueCheck::forget() noexcept {
  error_.setZero();
  off_for_.setZero();
  claims_for_ = 0.0;
  by_errors_ = {};
}

void TorqueCheck::update(const RobotState& state, const model::Dynamics& dynamics,
                         const PerLeg<bool>& stands, const JointVector& command,
                         bool moves_exactly) noexcept {
  const JointVector before = error_;
  const JointVector error = state.torque - command;
  if (error.allFinite()) error_ += gain_ * (error - error_);
  for (int i = 0; i < error_.size(); ++i) {
    const bool is_off = std::abs(error_[i]) > options_.max_error && error_[i] * before[i] > 0.0;
    off_for_[i] = is_off ? off_for_[i] + period_ : 0.0;
  }
  exact_for_ = moves_exactly ? exact_for_ + period_ : 0.0;
  RobotState claimed;  // only what the claim needs
  claimed.time = state.time;
  claimed.foot_force = state.foot_force;
  claim_.update(dynamics, stands, claimed);
  const Wrench errors = claimed_by_errors(dynamics, stands);
  by_errors_.force += claim_gain_ * (errors.force - by_errors_.force);
  by_errors_.moment += claim_gain_ * (errors.moment - by_errors_.moment);
  claims_for_ =
      claims_too_much() && exact_for_ >= options_.time_constant ? claims_for_ + period_ : 0.0;
}

// A torque reading that is e too high makes its leg push J⁺ᵀ e less on the ground.
TorqueCheck::Wrench TorqueCheck::claimed_by_errors(const model::Dynamics& dynamics,
                                                   const PerLeg<bool>& stands) const {
  Wrench result;
  for (const Leg leg : stands.legs()) {
    const model::PointKinematics& contact = dynamics.contact[index(leg)];
    if (!stands[index(leg)]) continue;
    const Mat3 inverse = model::damped_inverse(model::leg_jacobian(contact, leg), dynamics.scale);
    const Vec3 force = inverse.transpose() * error_.segment<kJointsPerLeg>(first_joint(leg));
    result.force += force;
    result.moment += (contact.p - dynamics.com.p).cross(force);
  }
  return result;
}

bool TorqueCheck::claims_too_much() const {
  const auto explains = [](const Vec3& claim, const Vec3& errors, double most) {
    return claim.norm() > most && (claim - errors).norm() < kMaxUnexplained * claim.norm();
  };
  return explains(claim_.force(), by_errors_.force, options_.max_force) ||
         explains(claim_.moment(), by_errors_.moment, options_.max_moment);
}

double TorqueCheck::wrong_for() const {
  const double longest = off_for_.maxCoeff();
  if (longest > options_.duration) return longest;
  return claims_for_ > kMinClaimTime ? options_.time_constant + claims_for_ : 0.0;
}

int TorqueCheck::joint() const {
  int result = -1, count = 0;
  for (int i = 0; i < error_.size(); ++i) {
    if (!(off_for_[i] > options_.duration)) continue;
    result = i;
    ++count;
  }
  return count == 1 ? result : -1;
}

}  // namespace surefoot::estimation
