#include "surefoot/evaluation/interval.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {

Interval wilson_interval(int successes, int trials) {
  if (trials <= 0) return {};
  constexpr double z = 1.959963984540054;
  const double n = trials;
  const double p = successes / n;
  const double centre = p + z * z / (2.0 * n);
  const double spread = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  const double scale = 1.0 + z * z / n;
  // Rounding must not exclude the rate itself, nor 0 or 1 if that is the rate.
  return {std::clamp((centre - spread) / scale, 0.0, p),
          std::clamp((centre + spread) / scale, p, 1.0)};
}

}  // namespace surefoot
