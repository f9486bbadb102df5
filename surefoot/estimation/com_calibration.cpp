#include "surefoot/estimation/com_calibration.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/math/smoothstep.hpp"

#include <algorithm>

namespace surefoot {
namespace {

constexpr double kFadeIn = 0.5;      // [s]
constexpr double kLargest = 0.10;    // of an offset that is believed [m]
constexpr double kLeastShare = 0.5;  // of the weight that the feet must feel
constexpr int kLeastSamples = 400;
constexpr double kMemory = 1.0;  // the vertical is known only at the end of the motion [s]

}  // namespace

void ComCalibration::update(const Dynamics& dynamics, const PerLeg<Vec3>& foot_force,
                            bool listening) noexcept {
  if (!listening) {
    if (samples_ >= kLeastSamples) {
      before_ = offset_;
      offset_ = clip_norm<3>(offset_ + mean_, kLargest);
      share_ = 0.0;
    }
    mean_.setZero();
    samples_ = 0;
    share_ = std::min(1.0, share_ + period_ / kFadeIn);
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
}

Vec3 ComCalibration::offset() const noexcept {
  return before_ + smoothstep(share_) * (offset_ - before_);
}

}  // namespace surefoot
