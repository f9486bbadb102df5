#include "surefoot/estimation/base_motion.hpp"

#include <Eigen/LU>

namespace surefoot {

// About the feet's mean, where v and ω do not mix.
BaseMotion base_motion(const PerLeg<Vec3>& p_BF, const PerLeg<Vec3>& v_BF) {
  Vec3 p = Vec3::Zero(), v = Vec3::Zero();
  for (std::size_t k = 0; k < kNumLegs; ++k) {
    p += p_BF[k] / kNumLegs;
    v -= v_BF[k] / kNumLegs;
  }
  Mat3 spread = Mat3::Zero();
  Vec3 turn = Vec3::Zero();
  for (std::size_t k = 0; k < kNumLegs; ++k) {
    const Vec3 arm = p_BF[k] - p;
    spread += arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose();
    turn -= arm.cross(v_BF[k]);
  }
  const Vec3 w = spread.inverse() * turn;
  return {.v = v - w.cross(p), .w = w};
}

void LineFit::add(const Vec3& y) {
  sum_ += y;
  moment_ += n_ * y;
  ++n_;
}

// Σ (k − (n−1)/2) y / Σ (k − (n−1)/2)²
Vec3 LineFit::slope() const {
  if (n_ < 2) return Vec3::Zero();
  const double n = n_;
  return (moment_ - 0.5 * (n - 1.0) * sum_) * 12.0 / (n * (n * n - 1.0));
}

Vec3 LineFit::last() const { return sum_ / n_ + 0.5 * (n_ - 1.0) * slope(); }

}  // namespace surefoot
