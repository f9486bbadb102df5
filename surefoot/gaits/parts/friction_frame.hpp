#pragma once

#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/math/rotation.hpp"

namespace surefoot::gaits {

/// The terrain's normal as forces are to be seen by: the plane through the footholds jumps at a
/// touchdown, and with it would the friction pyramids. First order, and no faster than a rate:
///
///     ṅ = (n_plane − n) / T,   |ṅ| ≤ ω_max
class FrictionFrame {
 public:
  FrictionFrame(const FrictionFrameOptions& options, double period)
      : share_(period / (period + options.time_constant)), step_max_(period * options.rate_max) {}

  /// Begins at a normal.
  void restart(const Vec3& normal) { normal_ = normal; }
  /// One period on, toward the plane's normal.
  void update(const Vec3& plane_normal) {
    const Vec3 step = share_ * (plane_normal - normal_);
    normal_ = (normal_ + clip_norm<3>(step, step_max_)).normalized();
  }

  /// Unit, in W.
  [[nodiscard]] const Vec3& normal() const { return normal_; }

 private:
  double share_;     // of the way to go in a period
  double step_max_;  // in a period [rad]
  Vec3 normal_ = Vec3::UnitZ();
};

}  // namespace surefoot::gaits
