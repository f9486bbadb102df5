#pragma once

#include "surefoot/base/error.hpp"

#include <cmath>
#include <string>

namespace surefoot {

/// Of the control loop [s]. Throws Error unless it is a time above 0.
inline double checked_period(double period) {
  if (period > 0.0 && std::isfinite(period)) return period;
  throw Error("period is " + std::to_string(period) + " s; valid is a time > 0, such as 0.0025");
}

}  // namespace surefoot
