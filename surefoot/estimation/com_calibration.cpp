#include "surefoot/estimation/com_calibration.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/math/smoothstep.hpp"
#include "surefoot/model/leg_jacobian.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr double kFadeIn = 0.5;      // of a weighing [s]
constexpr double kFollow = 0.5;      // of what links are found to weigh, a time constant [s]
constexpr double kLargest = 0.10;    // of an offset that is believed [m]
constexpr double kLeastShare = 0.5;  // of the weight that the feet must feel
constexpr double kLeast = 1.0;       // of a weighing that counts [s]
constexpr double kMemory = 1.0;      // the vertical is known only at the end of the motion [s]

}  // namespace

void ComCalibration::update(const Dynamics& dynamics, const PerLeg<Vec3>& foot_force,
                            bool listening) noexcept {
  if (!listening) {
    end_weighing(dynamics);
    share_ = std::min(1.0, share_ + period_ / kFadeIn);
    heavier_in_use_ += period_ / kFollow * (heavier_ - heavier_in_use_);
    return;
  }
  Vec3 F = Vec3::Zero(), M = Vec3::Zero();
  double ground = 0.0;
  for (const Leg leg : kLegs) {
    const Vec3& f = foot_force[index(leg)];
    F += f;
    M += dynamics.contact[index(leg)].p.cross(f);
    ground += dynamics.contact[index(leg)].p.z() / kNumLegs;
  }
  if (!(F.z() > kLeastShare * dynamics.mass * kGravity)) return;
  const Vec3& c = dynamics.com.p;
  const Vec3 error((ground * F.x() - M.y()) / F.z() - c.x(),
                   (ground * F.y() + M.x()) / F.z() - c.y(), 0.0);
  const Vec3 in_base = dynamics.base_rotation.R.transpose() * error;
  if (!in_base.allFinite()) return;
  const double share = std::max(1.0 / ++samples_, period_ / kMemory);
  mean_ += share * (Vec3(in_base.x(), in_base.y(), 0.0) - mean_);
  F_ = F;
  centre_ = Vec3(c.x() + error.x(), c.y() + error.y(), ground);
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

// The weighing knows nothing of heavier links, the offset that was in use while it lasted does.
void ComCalibration::end_weighing(const Dynamics& dynamics) {
  if (samples_ >= std::lround(kLeast / period_)) {
    const Vec3 offset_now = offset();
    slope_ = slope(dynamics);
    before_ = offset_now - slope_ * heavier_in_use_;
    offset_ = clip_norm<3>(offset_now + mean_, kLargest);
    share_ = 0.0;
  }
  mean_.setZero();
  samples_ = 0;
}

Vec3 ComCalibration::offset() const noexcept {
  const Vec3 weighed = before_ + smoothstep(share_) * (offset_ - before_);
  return clip_norm<3>(weighed + slope_ * heavier_in_use_, kLargest);
}

}  // namespace surefoot
