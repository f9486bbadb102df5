#include "surefoot/estimation/imu_step_check.hpp"

#include "surefoot/math/rotation.hpp"

#include <algorithm>

namespace surefoot::estimation {
namespace {

constexpr double kMinForce = 20.0;  // of a stance foot [N]
constexpr int kMinWitnesses = 2;
constexpr int kShortHold = 2;           // held samples that leave the velocity as it was
constexpr double kRecoveryTime = 0.05;  // in which the feet correct the velocity [s]
/// Error of a foot within 20 ms from encoders, rolling and samples out of step [m].
constexpr double kMinDifference = 1e-3;

}  // namespace

void ImuStepCheck::forget() noexcept {
  has_begun_ = false;
  doubted_ticks_ = 0;
  verdict_ = ImuStep::not_judged;
}

void ImuStepCheck::update(const SensorReading& offered, const SensorReading& held, bool is_doubted,
                          const RobotState& state, const model::Dynamics& dynamics,
                          const PerLeg<bool>& stands, const Vec3& normal_W) noexcept {
  if (!is_doubted) {
    const bool was_impact = doubted_ticks_ > kShortHold && verdict_ != ImuStep::contradicted;
    unsure_ticks_ =
        was_impact ? static_cast<int>(kRecoveryTime / period_) : std::max(0, unsure_ticks_ - 1);
    forget();
    begin(held, state, dynamics, stands, normal_W);
    return;
  }
  ++doubted_ticks_;
  if (!has_begun_ || unsure_ticks_ > 0) is_witness_.fill(false);
  integrate(offered_, offered);
  integrate(held_, held);
  judge(dynamics, stands);
}

void ImuStepCheck::begin(const SensorReading& reading, const RobotState& state,
                         const model::Dynamics& dynamics, const PerLeg<bool>& stands,
                         const Vec3& normal_W) {
  has_begun_ = true;
  offered_ = {.R = state.R_WB(), .p = dynamics.base.p, .v = state.v_WB, .gyro = reading.gyro};
  held_ = offered_;
  const double least = dynamics.scale.force() * kMinForce;
  p_WF_.resize(static_cast<int>(stands.size()));
  is_witness_.resize(static_cast<int>(stands.size()));
  for (std::size_t k = 0; k < stands.size(); ++k) {
    p_WF_[k] = dynamics.foot[k].p;
    is_witness_[k] = stands[k] && normal_W.dot(state.foot_force[k]) >= least;  // not if NaN
  }
}

void ImuStepCheck::integrate(Prediction& base, const SensorReading& reading) const {
  const Vec3 turn = 0.5 * period_ * (base.gyro + reading.gyro);
  const Mat3 R_half = base.R * exp_rotation(0.5 * turn).toRotationMatrix();
  const Vec3 change = period_ * (R_half * reading.accelerometer + kGravityVector);
  base.p += period_ * (base.v + 0.5 * change);
  base.v += change;
  base.R = base.R * exp_rotation(turn).toRotationMatrix();
  base.gyro = reading.gyro;
}

void ImuStepCheck::judge(const model::Dynamics& dynamics, const PerLeg<bool>& stands) {
  const Mat3 R_BW = dynamics.base_rotation.R.transpose();
  const double least = dynamics.scale.length * kMinDifference;
  int witnesses = 0, against = 0, in_favour = 0;
  for (std::size_t k = 0; k < is_witness_.size(); ++k) {
    is_witness_[k] = is_witness_[k] && stands[k];
    if (!is_witness_[k]) continue;
    const Vec3 h_B = R_BW * (dynamics.foot[k].p - dynamics.base.p);
    const auto moved = [&](const Prediction& b) { return (b.p + b.R * h_B - p_WF_[k]).norm(); };
    const double more = moved(offered_) - moved(held_);
    ++witnesses;
    against += more > least ? 1 : 0;
    in_favour += more < -least ? 1 : 0;
  }
  verdict_ = ImuStep::undecided;
  if (witnesses < kMinWitnesses)
    verdict_ = ImuStep::no_witness;
  else if (against == witnesses)
    verdict_ = ImuStep::contradicted;
  else if (2 * in_favour > witnesses)
    verdict_ = ImuStep::confirmed;
}

}  // namespace surefoot::estimation
