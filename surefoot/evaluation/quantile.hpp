#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace surefoot {

/// The smallest of the values that at least a share p of them does not exceed, 0 < p ≤ 1; the
/// values are in ascending order and not empty.
[[nodiscard]] inline double quantile(const std::vector<double>& sorted, double p) {
  const double rank = std::ceil(p * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

}  // namespace surefoot
