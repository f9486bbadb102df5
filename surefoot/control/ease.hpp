#pragma once

namespace surefoot::control {

/// From 0 to 1 over s from 0 to 1, with velocity and acceleration 0 at both ends: 6 s⁵ − 15 s⁴ + 10
/// s³.
[[nodiscard]] constexpr double ease(double s) { return s * s * s * (10.0 + s * (-15.0 + 6.0 * s)); }
/// Its derivative.
[[nodiscard]] constexpr double ease_slope(double s) { return 30.0 * s * s * (1.0 - s) * (1.0 - s); }

}  // namespace surefoot::control
