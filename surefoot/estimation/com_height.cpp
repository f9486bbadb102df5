#include "surefoot/estimation/com_height.hpp"

#include "surefoot/model/angular_momentum.hpp"

namespace surefoot {
namespace {

constexpr double kDoubt = 0.01;  // rms of a tilt that tells as much as is known beforehand [rad]

}  // namespace

void ComHeight::add(const Dynamics& dynamics, const GroundReaction& reaction) noexcept {
  const Mat3 R_BW = dynamics.base_rotation.R.transpose();
  const Vec3& c = dynamics.com.p;
  Vec3 error = Vec3::Zero();
  error.head<2>() = reaction.line_of_action(c.z() - reaction.ground) - c.head<2>();
  const Vec3 L = angular_momentum(dynamics);
  const Vec2 e = (R_BW * error).head<2>();
  const Vec2 D = (R_BW * Vec3(L.y(), -L.x(), 0.0)).head<2>() / reaction.force.z();
  const Vec3 up = R_BW.col(2);
  const Vec2 tilt = -up.head<2>();
  const Vec2 rate = Vec3(R_BW * dynamics.base_rotation.w).cross(up).head<2>();
  if (!e.allFinite() || !D.allFinite() || !rate.allFinite()) return;
  ++sums_.ticks;
  sums_.tilt += tilt;
  sums_.error += e;
  sums_.tilt_tilt += tilt.cwiseAbs2();
  sums_.tilt_error += tilt.cwiseProduct(e);
  sums_.rate_momentum += rate.cwiseProduct(D);
}

double ComHeight::found() const noexcept {
  if (sums_.ticks == 0) return 0.0;
  const double n = sums_.ticks;
  const Vec2 together =
      sums_.tilt_error - sums_.tilt.cwiseProduct(sums_.error) / n - sums_.rate_momentum;
  const Vec2 spread = sums_.tilt_tilt - sums_.tilt.cwiseAbs2() / n;
  return together.sum() / (spread.sum() + n * kDoubt * kDoubt);
}

}  // namespace surefoot
