#pragma once

#include <limits>

namespace surefoot::solver {

/// Rank policy, relative to the length ‖aᵢ‖ that a row has in the space of x.
///
/// The rest of a row after projection onto the null space of all fixed rows decides:
///  - more than `solve` ‖aᵢ‖: the row is independent, the level may use this direction;
///  - between `keep` and `solve`: the direction is too weak to use (x would grow by more than
///    1 / solve) and too strong to give away: it is fixed where it is;
///  - less than `keep` ‖aᵢ‖: rounding, the row depends on the fixed ones.
///
/// A used weak direction raises `keep` to `tolerance::kPivotRounding` / (its relative length), at
/// most `kMaxRounding`, the rounding in the rest of the following rows.
struct RankTolerance {
  double solve = 1e-10;
  double keep = 1e-12;
};

/// Rounding in both solvers. Numbers only: the kernels of all instruction sets use them.
namespace tolerance {

/// Largest length of rows and finite bounds: squares of larger ones overflow, so they are invalid
/// input.
inline constexpr double kLargest = 1e150;

/// Rounding in the following rows, relative to the used part of a row.
inline constexpr double kPivotRounding = 16.0 * std::numeric_limits<double>::epsilon();
/// Limit of that rounding, for any used direction.
inline constexpr double kMaxRounding = 1e-4;

/// Rounding in the rest of rows, relative to their lengths, after a row with this pivot.
constexpr double rounding_after(double smallest_pivot) {
  const double rounding = kPivotRounding / smallest_pivot;
  return rounding < kMaxRounding ? rounding : kMaxRounding;
}

/// Below this pivot doubles hardly decide whether a row is independent.
inline constexpr double kWeakPivot = 1e-5;
/// Below this pivot doubles don't decide whether a row is independent.
inline constexpr double kBorderlinePivot = 1e-9;

// Values of rows, relative to ‖a‖ ‖x‖.
/// Smaller differences may be rounding.
inline constexpr double kRounding = 2e-14;
/// A row beyond its bound by less is satisfied for a sweep.
inline constexpr double kSatisfied = 1e-12;
/// A row this close to a bound is at it.
inline constexpr double kAtBound = 1e-10;
/// A row beyond its bound by more certainly can't be met.
inline constexpr double kViolated = 1e-9;

// Forces of held rows, relative to Σ ‖aᵢ‖ |vᵢ|.
/// A row with less than −kWrongSign is released.
inline constexpr double kWrongSign = 1e-11;
/// A row with more is certainly needed.
inline constexpr double kStrict = 1e-9;
/// The same, relative to the rounding of Σ ‖aᵢ‖² by kRounding: if nearly parallel rows make x large
/// and forces small, wrongly keeping a row costs more than wrongly releasing one.
inline constexpr double kWrongSignOfNoise = 0.2;
inline constexpr double kStrictOfNoise = 100.0;
/// Below this force doubles hardly decide whether a row is needed.
inline constexpr double kWeakForce = 1e-6;
/// Below this force doubles don't decide whether a row is needed.
inline constexpr double kBorderlineForce = 1e-7;

}  // namespace tolerance
}  // namespace surefoot::solver
