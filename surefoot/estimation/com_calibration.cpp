#include "surefoot/estimation/com_calibration.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/math/smoothstep.hpp"
#include "surefoot/model/leg_jacobian.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr double kFadeIn = 0.5;    // of a weighing [s]
constexpr double kFollow = 0.5;    // of what links are found to weigh, a time constant [s]
constexpr double kLargest = 0.10;  // of an offset that is believed [m]
constexpr double kLightest = -0.3, kHeaviest = 0.6;  // of a load that is, in model's masses
constexpr double kLeastShare = 0.5;                  // of the weight that the feet must feel
constexpr double kLeast = 1.0;                       // of a weighing that counts [s]
constexpr double kMemory = 1.0;  // the vertical is known only at the end of the motion [s]

}  // namespace

void ComCalibration::update(const Dynamics& dynamics, const PerLeg<Vec3>& foot_force,
                            CalibrationStage stage) noexcept {
  const bool turns = stage == CalibrationStage::turning;
  if (turns && !turning_) height_.begin();
  turning_ = turns;
  const GroundReaction reaction = ground_reaction(dynamics, foot_force);
  const bool is_felt = reaction.force.z() > kLeastShare * dynamics.mass * kGravity;
  if (stage == CalibrationStage::weighing) {
    if (is_felt) weigh(dynamics, reaction);
    return;
  }
  end_weighing(dynamics);
  share_ = std::min(1.0, share_ + period_ / kFadeIn);
  heavier_in_use_ += period_ / kFollow * (heavier_ - heavier_in_use_);
  if (turns && is_felt) height_.add(dynamics, reaction);
}

void ComCalibration::weigh(const Dynamics& dynamics, const GroundReaction& reaction) {
  Vec3 error = Vec3::Zero();
  error.head<2>() = reaction.line_of_action(0.0) - dynamics.com.p.head<2>();
  const Vec3 in_base = dynamics.base_rotation.R.transpose() * error;
  if (!in_base.allFinite()) return;
  const double share = std::max(1.0 / ++samples_, period_ / kMemory);
  mean_.offset += share * (in_base - mean_.offset);
  mean_.mass += share * (reaction.force.z() / kGravity - dynamics.mass - mean_.mass);
  F_ = reaction.force;
  centre_ << dynamics.com.p.head<2>() + error.head<2>(), reaction.ground;
}

ComCalibration::Slope ComCalibration::slope(const Dynamics& dynamics) const {
  Slope result;
  for (const Leg leg : kLegs) {
    const PointKinematics& contact = dynamics.contact[index(leg)];
    const Mat3 forces = -damped_inverse(leg_jacobian(contact, leg)).transpose() *
                        dynamics.links[index(leg)].free_rate;
    for (int l = 0; l < kJointsPerLeg; ++l) {
      const Vec3 f = forces.col(l);
      const Vec3 moved = (contact.p - centre_).cross(f) / F_.z();
      result.col(first_joint(leg) + l) << -moved.y(), moved.x(), 0.0;
    }
  }
  result = dynamics.base_rotation.R.transpose() * result;
  result.row(2).setZero();
  return result;
}

ComCalibration::Bare ComCalibration::bare(const Dynamics& dynamics) const {
  const BaseLoad now = load();
  const double mass = dynamics.mass - now.mass;
  const Vec3 com = dynamics.base_rotation.R.transpose() * (dynamics.com.p - dynamics.base.p);
  return {.mass = mass, .com = (dynamics.mass * com - now.moment) / mass};
}

// The weighing knows nothing of heavier links, the offset that was in use while it lasted does. It
// knows of a line that the COM is on, the turning how high.
void ComCalibration::end_weighing(const Dynamics& dynamics) {
  if (samples_ >= std::lround(kLeast / period_)) {
    const Mat3 R_BW = dynamics.base_rotation.R.transpose();
    const double mass_now = in_use().mass;
    bare_ = bare(dynamics);
    const Vec3 offset_now = R_BW * (dynamics.com.p - dynamics.base.p) - bare_.com;
    const Vec3 up = R_BW.col(2);
    const Vec3 found = mean_.offset + (height_.found() - mean_.offset.z()) / up.z() * up;
    slope_ = slope(dynamics);
    before_ = {.mass = mass_now, .offset = offset_now - slope_ * heavier_in_use_};
    weighed_ = {
        .mass = std::clamp(mass_now + mean_.mass, kLightest * bare_.mass, kHeaviest * bare_.mass),
        .offset = clip_norm<3>(offset_now + found, kLargest)};
    share_ = 0.0;
    height_.begin();
  }
  mean_ = Weight{};
  samples_ = 0;
}

ComCalibration::Weight ComCalibration::in_use() const {
  const double share = smoothstep(share_);
  const Vec3 offset = before_.offset + share * (weighed_.offset - before_.offset);
  return {.mass = before_.mass + share * (weighed_.mass - before_.mass),
          .offset = clip_norm<3>(offset + slope_ * heavier_in_use_, kLargest)};
}

BaseLoad ComCalibration::load() const noexcept {
  const Weight weight = in_use();
  return {.mass = weight.mass,
          .moment = weight.mass * bare_.com + (bare_.mass + weight.mass) * weight.offset};
}

}  // namespace surefoot
