#include "surefoot/estimation/com_height.hpp"

#include "surefoot/model/angular_momentum.hpp"

namespace surefoot::estimation {
namespace {

// ∫ of the tilts' squared deviations [rad² s]: a third of a turn.
constexpr double kMinTiltIntegral = 0.01;

/// Onto B's x and y, along `up` in B.
Vec2 projected(const Vec3& v, const Vec3& up) {
  return v.head<2>() - v.z() / up.z() * up.head<2>();
}

}  // namespace

void ComHeight::add(const model::Dynamics& dynamics, const GroundReaction& reaction) noexcept {
  const Mat3 R_BW = dynamics.base_rotation.R.transpose();
  const Vec3& c = dynamics.com.p;
  const Vec3 up = R_BW.col(2);
  Vec3 error = Vec3::Zero();
  error.head<2>() = reaction.line_of_action(c.z()) - c.head<2>();
  const Vec3 L = model::angular_momentum(dynamics);
  const Vec2 e = projected(R_BW * error, up);
  const Vec2 D = projected(R_BW * Vec3(L.y(), -L.x(), 0.0), up) / reaction.force.z();
  const Vec2 tilt = -up.head<2>() / up.z();
  const Vec3 up_rate = up.cross(R_BW * dynamics.base_rotation.w);
  const Vec2 rate = -(up_rate.head<2>() + up_rate.z() * tilt) / up.z();
  if (!e.allFinite() || !D.allFinite() || !rate.allFinite()) return;
  ++sums_.ticks;
  sums_.tilt += tilt;
  sums_.error += e;
  sums_.tilt_tilt += tilt.cwiseAbs2();
  sums_.tilt_error += tilt.cwiseProduct(e);
  sums_.rate_momentum += rate.cwiseProduct(D);
}

std::optional<double> ComHeight::found() const noexcept {
  const double n = sums_.ticks;
  const Vec2 variance = sums_.tilt_tilt - sums_.tilt.cwiseAbs2() / n;
  if (!(period_ * variance.sum() > kMinTiltIntegral)) return std::nullopt;
  const Vec2 covariance =
      sums_.tilt_error - sums_.tilt.cwiseProduct(sums_.error) / n - sums_.rate_momentum;
  return covariance.sum() / variance.sum();
}

}  // namespace surefoot::estimation
