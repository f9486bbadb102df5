#pragma once

#include "surefoot/math/numbers.hpp"
#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/solution.hpp"
#include "surefoot/solver/tolerances.hpp"

#include <cmath>

namespace surefoot::solver {

/// States of rows, shared by both solvers.

/// Distance beyond the bounds: positive above, negative below, 0 between.
inline double signed_violation(double value, double lower, double upper) {
  if (value > upper) return value - upper;
  return value < lower ? value - lower : 0.0;
}

/// Is lower ≤ upper, each at most `tolerance::kLargest` if finite, and no infinity impossible?
/// False for NaN.
inline bool are_sound(double lower, double upper) {
  constexpr double kLargest = tolerance::kLargest;
  if (std::isunordered(lower, upper)) return false;  // ordering would raise an exception
  const bool is_lower = lower >= -kLargest || lower == -kInfinity;
  const bool is_upper = upper <= kLargest || upper == kInfinity;
  return is_lower && is_upper && lower <= upper && lower <= kLargest && upper >= -kLargest;
}

/// Is a row's length at most `tolerance::kLargest`? Squares no larger elements, which would raise
/// an exception.
inline bool is_sound_row(const Eigen::Ref<const Eigen::RowVectorXd>& a) {
  for (const double element : a) {
    if (!std::islessequal(std::abs(element), tolerance::kLargest)) return false;
  }
  return a.norm() <= tolerance::kLargest;
}

/// Had all rows room, with valid bounds and coefficients?
inline bool is_sound(const Level& level) {
  if (level.has_overflowed()) return false;
  for (Eigen::Index i = 0; i < level.num_rows(); ++i) {
    if (!are_sound(level.lower()[i], level.upper()[i])) return false;
    if (!is_sound_row(level.A().row(i))) return false;
  }
  return true;
}

/// Index of the first invalid level; −1: none.
inline int first_unsound_level(const Hierarchy& hierarchy) {
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    if (!is_sound(hierarchy.level(k))) return static_cast<int>(k);
  }
  return -1;
}

/// Are ‖x‖² and the residuals of the first `num_levels` levels finite? All decisions are relative
/// to ‖x‖.
inline bool is_finite(const Solution& solution, std::size_t num_levels) {
  double sum = 0.0;
  for (std::size_t k = 0; k < num_levels; ++k) sum += solution.levels[k].residual;
  return std::isfinite(sum) && std::isfinite(solution.x.squaredNorm());
}

/// Clears the results from level `first` on, as of levels without rows.
inline void clear_levels(Solution& solution, std::size_t first) {
  const Eigen::Index left =
      first > 0 ? solution.levels[first - 1].degrees_of_freedom_left : solution.x.size();
  for (std::size_t k = first; k < solution.levels.size(); ++k) {
    LevelResult& result = solution.levels[k];
    result.residual = result.time = 0.0;
    result.num_rows = 0;
    result.iterations = 0;
    result.degrees_of_freedom_left = left;
  }
}

/// The answer to invalid input, or if the optimum is out of range.
inline void reject(const Hierarchy& hierarchy, Solution& solution) {
  solution.status = SolveStatus::invalid_input;
  solution.failed_level = first_unsound_level(hierarchy);
  solution.time = 0.0;
  solution.is_swept = solution.borderline = false;
  solution.x.setZero();
  clear_levels(solution, 0);
}

/// State of a row with this value; `tolerance` is the smallest difference that counts.
inline RowState state_of(double value, double lower, double upper, double tolerance) {
  const double above = value - upper, below = lower - value;
  if (lower == upper) return RowState::equality;
  if (above >= -tolerance) return above > tolerance ? RowState::above_upper : RowState::at_upper;
  if (below >= -tolerance) return below > tolerance ? RowState::below_lower : RowState::at_lower;
  return RowState::inactive;
}

}  // namespace surefoot::solver
