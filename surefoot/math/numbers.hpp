#pragma once

#include <limits>

namespace surefoot {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Times that are closer than this are the same [s].
inline constexpr double kTimeRounding = 1e-9;

}  // namespace surefoot
