#pragma once

#include "surefoot/solver/hierarchy.hpp"

namespace surefoot::tasks {

/// How a coordinate stops at its bound.
enum class BoundResponse {
  paper,         ///< Eq. 27: ω_n = √2/δt, ζ = 0.707, overshoots by 4.3 %
  no_overshoot,  ///< two real poles at −1/δt and −2/δt: for strict bounds
};

/// Bounds r_min ≤ r ≤ r_max on a coordinate, as bounds on r̈ (Bellicoso 2016, Eqs. 25–27).
///
///     k (r_min − r) − d ṙ  ≤  r̈  ≤  k (r_max − r) − d ṙ
///
/// Eq. 27 divided by δt²/2 gives k = 2/δt², d = 2/δt, so a violation is an acceleration and weighs
/// like those of the tracking tasks. `no_overshoot` has the same k and d = 3/δt.
class MotionBound {
 public:
  /// δt [s] must be positive.
  explicit MotionBound(double dt, BoundResponse response = BoundResponse::paper);

  [[nodiscard]] double lower(double r_min, double r, double rdot) const noexcept {
    return stiffness_ * (r_min - r) - damping_ * rdot;
  }
  [[nodiscard]] double upper(double r_max, double r, double rdot) const noexcept {
    return stiffness_ * (r_max - r) - damping_ * rdot;
  }

  /// Bounds row i, with A x = r̈ − drift.
  void write(solver::Rows& rows, Eigen::Index i, double r_min, double r_max, double r, double rdot,
             double drift) const noexcept {
    rows.lower[i] = lower(r_min, r, rdot) - drift;
    rows.upper[i] = upper(r_max, r, rdot) - drift;
  }

 private:
  double stiffness_;  ///< [1/s²]
  double damping_;    ///< [1/s]
};

}  // namespace surefoot::tasks
