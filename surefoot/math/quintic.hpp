#pragma once

#include <Eigen/Core>

namespace surefoot {

/// Position, velocity and acceleration at one instant.
template <typename T>
struct Motion {
  T p;
  T v;
  T a;
};

/// Weights of the six boundary values (p0, v0, a0, p1, v1, a1) in a quintic Hermite spline.
using HermiteWeights = Eigen::Matrix<double, 1, 6>;

/// Weights of the position p(t) on [0, T]:  p(t) = w · (p0, v0, a0, p1, v1, a1).
[[nodiscard]] HermiteWeights hermite_position(double t, double T);
/// Weights of ṗ(t).
[[nodiscard]] HermiteWeights hermite_velocity(double t, double T);
/// Weights of p̈(t).
[[nodiscard]] HermiteWeights hermite_acceleration(double t, double T);

/// Quintic Hermite spline through two boundary states over T > 0, at t clamped to [0, T].
template <typename T>
[[nodiscard]] Motion<T> hermite(const Motion<T>& begin, const Motion<T>& end, double t,
                                double duration) {
  const double clamped = t < 0.0 ? 0.0 : (t > duration ? duration : t);
  const auto blend = [&](const HermiteWeights& w) -> T {
    return w[0] * begin.p + w[1] * begin.v + w[2] * begin.a + w[3] * end.p + w[4] * end.v +
           w[5] * end.a;
  };
  return {blend(hermite_position(clamped, duration)), blend(hermite_velocity(clamped, duration)),
          blend(hermite_acceleration(clamped, duration))};
}

}  // namespace surefoot
