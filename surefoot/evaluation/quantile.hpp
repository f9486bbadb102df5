#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace surefoot::evaluation {

/// The smallest value that a share p of all values does not exceed, 0 < p ≤ 1. The values must be
/// sorted in ascending order and not empty.
[[nodiscard]] inline double quantile(const std::vector<double>& sorted, double p) {
  const double rank = std::ceil(p * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

/// The same for unsorted values; NaN without values.
[[nodiscard]] inline double quantile_of(std::vector<double> values, double p) {
  std::ranges::sort(values);
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : quantile(values, p);
}

}  // namespace surefoot::evaluation
