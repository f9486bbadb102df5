#pragma once

#include "surefoot/solver/certificate.hpp"
#include "surefoot/solver/optimality_conditions.hpp"

#include <Eigen/Core>

namespace surefoot::solver {

/// Ranks are borderline if less of a row is independent, relative to its length.
inline constexpr double kClearRank = 1e-5;
/// From this ‖x‖ on its rounding counts.
inline constexpr double kLargeX = 1e6;

/// Doubt of a level below the rows E and T, by numbers of 32 digits (`DoubleDouble`): with the rows
/// as given, dependent only if less than 1e-14 of one is left, without any tolerance for rounding.
/// Smaller parts may be rounding of the given numbers, so nothing is asked of them. Skipped,
/// without doubt, if in doubles all rows are clearly independent or dependent, x is not large and
/// rows of the level are of similar length. `units` relates the hierarchy's units to the given
/// ones; if any is not 1 it always computes, and compares the level's gain with the given rows, if
/// they were shorter. `tight`: see `optimality_conditions`. Allocates.
[[nodiscard]] Doubt what_doubles_hide(const Hierarchy& hierarchy, std::size_t level,
                                      const Eigen::VectorXd& x, double tight, const RowSet& fixed,
                                      const RowSet& touching, const Eigen::VectorXd& units);

}  // namespace surefoot::solver
