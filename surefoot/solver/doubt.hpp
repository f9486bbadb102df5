#pragma once

#include "surefoot/solver/optimality_conditions.hpp"

#include <Eigen/Core>

namespace surefoot {

/// What exact arithmetic could still gain where doubles see nothing: in directions that rows see so
/// weakly that a rank is a matter of tolerance, or beside forces so large that their rounding hides
/// it.
struct Doubt {
  /// Of the level's residual the share that could be gained, or that the rounding of x is, relative
  /// to residual, largest bound and longest row together.
  double residual = 0.0;
  double stationarity = 0.0;  ///< as `LevelCertificate` measures it, but excusing nothing
  /// Of a row what the others leave of it at least, relative to its length (to within a factor of
  /// 2), of those where more is left than the rounding of its elements, 1e-14.
  double weakest = 1.0;
};

/// Of a level that has the rows E and T above it, by numbers of 32 digits (`DoubleDouble`): the
/// rows as they are given, dependent only where less than 1e-14 of one is left, without any
/// allowance for rounding. What is at most that much may be rounding of the given numbers, so
/// nothing is asked of it. Nothing is computed, and nothing in doubt, where in doubles all rows are
/// clearly independent or dependent and neither x is large nor rows of the level differ in length.
/// `tight`: see `optimality_conditions`. Allocates.
[[nodiscard]] Doubt doubt(const Hierarchy& hierarchy, std::size_t level, const Eigen::VectorXd& x,
                          double tight, const RowSet& fixed, const RowSet& touching);

}  // namespace surefoot
