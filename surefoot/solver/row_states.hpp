#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/solution.hpp"

#include <cmath>
#include <limits>

namespace surefoot {

/// What both solvers say of rows, in one place.

/// A row within this share of ‖a‖ ‖x‖ of a bound is reported as being at it.
inline constexpr double kAtBound = 1e-10;

/// lower ≤ upper, and neither is an infinity that nothing can meet. False for NaN.
inline bool are_sound(double lower, double upper) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return lower <= upper && lower < kInfinity && upper > -kInfinity;
}

/// All bounds are sound, and the squared length of every row is finite: so is then every element.
inline bool is_sound(const Level& level) {
  for (Eigen::Index i = 0; i < level.num_rows(); ++i) {
    if (!are_sound(level.lower()[i], level.upper()[i])) return false;
    if (!std::isfinite(level.A().row(i).squaredNorm())) return false;
  }
  return true;
}

/// What a row does where it has this value; `tolerance` is the smallest difference that counts.
inline RowState state_of(double value, double lower, double upper, double tolerance) {
  const double above = value - upper, below = lower - value;
  if (lower == upper) return RowState::equality;
  if (above >= -tolerance) return above > tolerance ? RowState::above_upper : RowState::at_upper;
  if (below >= -tolerance) return below > tolerance ? RowState::below_lower : RowState::at_lower;
  return RowState::inactive;
}

/// Rows that a hierarchy has room for.
inline Eigen::Index max_rows(const Hierarchy& hierarchy) {
  Eigen::Index rows = 0;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) rows += hierarchy.level(k).max_rows();
  return rows;
}

}  // namespace surefoot
