#pragma once

#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/math/rotation.hpp"

namespace surefoot::gaits {

/// Filters the terrain normal for the friction pyramids, because the plane through the footholds
/// jumps at a touchdown. First order, with limited rate:
///
///     ṅ = (n_plane − n) / T,   |ṅ| ≤ ω_max
class FrictionFrame {
 public:
  FrictionFrame(const FrictionFrameOptions& options, double period)
      : share_(period / (period + options.time_constant)), step_max_(period * options.rate_max) {}

  /// Sets the normal, without filtering.
  void restart(const Vec3& normal) { normal_ = normal; }
  /// One control period.
  void update(const Vec3& plane_normal) {
    const Vec3 step = share_ * (plane_normal - normal_);
    normal_ = (normal_ + clip_norm<3>(step, step_max_)).normalized();
  }

  /// Unit, in W.
  [[nodiscard]] const Vec3& normal() const { return normal_; }

 private:
  double share_;     // of the difference, per period
  double step_max_;  // per period [rad]
  Vec3 normal_ = Vec3::UnitZ();
};

}  // namespace surefoot::gaits
