#include "surefoot/estimation/com_calibration.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/math/smoothstep.hpp"
#include "surefoot/model/leg_jacobian.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kFadeInTime = 0.5;     // of a weighing [s]
constexpr double kFollowTime = 0.5;     // time constant for new link masses [s]
constexpr double kMaxComOffset = 0.10;  // of the COM, in B horizontal and vertical [m]
constexpr double kMinLoadShare = -0.5;  // of the payload, in masses of the base
constexpr double kMaxLoadShare = 1.0;   // of the payload, in masses of the base
// Smaller loads are uncertain: a robot as modelled can measure half of both.
constexpr double kMinCertainLoad = 0.01;    // in masses of the robot
constexpr double kMinCertainHeight = 0.01;  // of the COM against the bare model's [m]
constexpr double kMinForceShare = 0.5;      // of the weight, on the feet
constexpr double kMinWeighingTime = 0.5;    // [s]
constexpr double kVerticalTime = 1.0;  // of the mean, as the vertical settles after the motion [s]

Vec3 com_in_base(const model::Dynamics& dynamics) {
  return dynamics.base_rotation.R.transpose() * (dynamics.com.p - dynamics.base.p);
}

Vec3 limited(const Vec3& offset, const Scale& scale) {
  const double most = scale.length * kMaxComOffset;
  Vec3 result;
  result << clip_norm<2>(offset.head<2>(), most), std::clamp(offset.z(), -most, most);
  return result;
}

}  // namespace

void ComCalibration::update(const model::Dynamics& dynamics, const PerLeg<Vec3>& foot_force,
                            CalibrationStage stage, bool is_quiet) noexcept {
  const bool turns = stage == CalibrationStage::turning;
  if (turns && (!turning_ || !is_quiet)) height_.forget();
  turning_ = turns;
  const GroundReaction reaction = ground_reaction(dynamics, foot_force);
  const bool is_loaded = is_quiet && reaction.force.z() > kMinForceShare * dynamics.mass * kGravity;
  if (stage == CalibrationStage::weighing) {
    weighing_ = true;
    if (is_loaded) weigh(dynamics, reaction);
    return;
  }
  if (weighing_) end_weighing(dynamics);
  const double time = dynamics.scale.time();
  share_ = std::min(1.0, share_ + period_ / (time * kFadeInTime));
  heavier_in_use_ += period_ / (time * kFollowTime) * (heavier_ - heavier_in_use_);
  if (turns && is_loaded) height_.add(dynamics, reaction);
}

void ComCalibration::weigh(const model::Dynamics& dynamics, const GroundReaction& reaction) {
  Vec3 error = Vec3::Zero();
  error.head<2>() = reaction.line_of_action(reaction.ground) - dynamics.com.p.head<2>();
  const Vec3 in_base = dynamics.base_rotation.R.transpose() * error;
  if (!in_base.allFinite()) return;
  const double share =
      std::max(1.0 / ++samples_, period_ / (dynamics.scale.time() * kVerticalTime));
  mean_offset_ += share * (in_base - mean_offset_);
  mean_mass_ += share * (reaction.force.z() / kGravity - dynamics.mass - mean_mass_);
  F_ = reaction.force;
  centre_ << dynamics.com.p.head<2>() + error.head<2>(), reaction.ground;
}

// The weighing ignores heavier links; the load in use during it includes them.
void ComCalibration::end_weighing(const model::Dynamics& dynamics) {
  const std::optional<double> o_z = height_.found();
  const double least = dynamics.scale.time() * kMinWeighingTime;
  const bool is_long_enough = samples_ >= std::lround(least / period_);
  knows_load_ = is_long_enough && o_z.has_value();
  if (is_long_enough) {
    const BaseLoad now = load();
    const Vec3 com = com_in_base(dynamics);
    const double bare_mass = dynamics.mass - now.mass;
    const Vec3 bare_com = (dynamics.mass * com - now.first_moment) / bare_mass;
    const Vec3 up = dynamics.base_rotation.R.row(2);
    const double measured_mass = now.mass + mean_mass_;
    const Vec3 found = mean_offset_ + (o_z.value_or(0.0) - mean_offset_.z()) / up.z() * up;
    Vec3 offset = limited(com - bare_com + found, dynamics.scale);
    const bool is_certain = std::abs(measured_mass) > kMinCertainLoad * bare_mass ||
                            std::abs(offset.z()) > dynamics.scale.length * kMinCertainHeight;
    double mass = now.mass;
    if (o_z && is_certain) {
      mass = std::clamp(measured_mass, kMinLoadShare * base_mass_, kMaxLoadShare * base_mass_);
    } else if (o_z) {
      mass = offset.z() = 0.0;
    }
    slope_ = (bare_mass + mass) * slope(dynamics);
    before_ = {.mass = now.mass, .first_moment = now.first_moment - slope_ * heavier_in_use_};
    weighed_ = {.mass = mass,
                .first_moment = (bare_mass + mass) * (bare_com + offset) - bare_mass * bare_com};
    share_ = 0.0;
    height_.forget();
  }
  mean_offset_.setZero();
  mean_mass_ = 0.0;
  samples_ = 0;
  weighing_ = false;
}

ComCalibration::Slope ComCalibration::slope(const model::Dynamics& dynamics) const {
  Slope result(3, slope_.cols());
  for (const Leg leg : dynamics.contact.legs()) {
    const model::PointKinematics& contact = dynamics.contact[index(leg)];
    const Mat3 inverse = model::damped_inverse(model::leg_jacobian(contact, leg), dynamics.scale);
    const Mat3 forces = -inverse.transpose() * dynamics.links[index(leg)].free_rate;
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

BaseLoad ComCalibration::load() const noexcept {
  const double share = smoothstep(share_);
  const Vec3 moment = before_.first_moment + share * (weighed_.first_moment - before_.first_moment);
  return {.mass = before_.mass + share * (weighed_.mass - before_.mass),
          .first_moment = moment + slope_ * heavier_in_use_};
}

}  // namespace surefoot::estimation
