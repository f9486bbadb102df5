#pragma once

#include "surefoot/solver/certificate.hpp"
#include "surefoot/solver/optimality_conditions.hpp"

#include <Eigen/Core>

namespace surefoot {

/// Where less of a row is left beside the others, relative to its length, ranks are borderline.
inline constexpr double kClearRank = 1e-5;
/// Where ‖x‖ is larger, rounding of it counts.
inline constexpr double kLargeX = 1e6;

/// Of a level that has the rows E and T above it, by numbers of 32 digits (`DoubleDouble`): the
/// rows as they are given, dependent only where less than 1e-14 of one is left, without any
/// allowance for rounding. What is at most that much may be rounding of the given numbers, so
/// nothing is asked of it. Nothing is computed, and nothing in doubt, where in doubles all rows are
/// clearly independent or dependent and neither x is large nor rows of the level differ in length.
/// `units`: those that the hierarchy is in, beside those that were given; where any is not 1 it is
/// computed in any case, and what a level gains is held against the rows as they were given, if
/// these were shorter. `tight`: see `optimality_conditions`. Allocates.
[[nodiscard]] Doubt what_doubles_hide(const Hierarchy& hierarchy, std::size_t level,
                                      const Eigen::VectorXd& x, double tight, const RowSet& fixed,
                                      const RowSet& touching, const Eigen::VectorXd& units);

}  // namespace surefoot
