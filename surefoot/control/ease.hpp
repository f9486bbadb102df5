#pragma once

namespace surefoot::control {

/// 6 s⁵ − 15 s⁴ + 10 s³: from 0 to 1 for s from 0 to 1, with zero velocity and acceleration at both
/// ends.
[[nodiscard]] constexpr double ease(double s) { return s * s * s * (10.0 + s * (-15.0 + 6.0 * s)); }
/// Its derivative.
[[nodiscard]] constexpr double ease_slope(double s) { return 30.0 * s * s * (1.0 - s) * (1.0 - s); }

}  // namespace surefoot::control
