#pragma once

namespace surefoot {

/// Rises smoothly from 0 at s = 0 to 1 at s = 1: 3 s² − 2 s³, constant outside.
[[nodiscard]] constexpr double smoothstep(double s) {
  const double c = s < 0.0 ? 0.0 : (s > 1.0 ? 1.0 : s);
  return c * c * (3.0 - 2.0 * c);
}

/// Rises smoothly from 0 at t = 0 to 1 at `duration`; a step after t = 0 if that is 0.
[[nodiscard]] constexpr double smooth_ramp(double t, double duration) {
  if (duration > 0.0) return smoothstep(t / duration);
  return t > 0.0 ? 1.0 : 0.0;
}

}  // namespace surefoot
