#pragma once

#include <limits>

namespace surefoot {

/// Rank policy, relative to the length ‖aᵢ‖ that a row has in the space of x.
///
/// What is left of a row after projection onto the null space of everything fixed before decides:
///  - more than `solve` ‖aᵢ‖: the row is independent, the level may use this direction;
///  - between `keep` and `solve`: the direction is too weak to be used (x would blow up by more
///    than 1 / solve) and too strong to be given away: it is fixed where it is;
///  - less than `keep` ‖aᵢ‖: rounding, the row depends on those fixed before.
///
/// Where a weak direction has been used, `keep` grows to `tolerance::kPivotRounding` / (its
/// relative length), `kMostRounding` at the most: so large is the rounding in what is left of the
/// rows that follow.
struct RankTolerance {
  double solve = 1e-10;
  double keep = 1e-12;
};

/// What both solvers take for rounding. Numbers only: the kernels of all instruction sets use them.
namespace tolerance {

/// Lengths of rows and finite bounds at most: squares of larger ones are beyond the range of
/// doubles, so they are invalid input.
inline constexpr double kLargest = 1e150;

/// Relative to what is used of a row: rounding in the rows that follow.
inline constexpr double kPivotRounding = 16.0 * std::numeric_limits<double>::epsilon();
/// What is taken for rounding at most, however weak the directions used.
inline constexpr double kMostRounding = 1e-4;

/// Rounding in what is left of rows, relative to their lengths, where a row has been used of which
/// so much was left.
constexpr double rounding_after(double smallest_pivot) {
  const double rounding = kPivotRounding / smallest_pivot;
  return rounding < kMostRounding ? rounding : kMostRounding;
}

/// If less of a row was left, doubles can hardly tell whether it is independent.
inline constexpr double kWeakPivot = 1e-5;
/// If less of a row was left, doubles can't tell whether it is independent.
inline constexpr double kBorderlinePivot = 1e-9;

/// Values of rows, relative to ‖a‖ ‖x‖. Below: a difference may be rounding.
inline constexpr double kRounding = 2e-14;
/// A row that is no further beyond its bound is taken for satisfied by a sweep.
inline constexpr double kSatisfied = 1e-12;
/// A row within this of a bound is reported as being at it.
inline constexpr double kAtBound = 1e-10;
/// A row further beyond its bound certainly can't be met.
inline constexpr double kViolated = 1e-9;

/// Forces of held rows, relative to Σ ‖aᵢ‖ |vᵢ|: below −kWrongSign a row is let go,
inline constexpr double kWrongSign = 1e-11;
/// above kStrict it is certain to be needed.
inline constexpr double kStrict = 1e-9;
/// The same, relative to what kRounding makes of Σ ‖aᵢ‖²: where nearly parallel rows make x large
/// and forces small, a row that is kept in error costs more than one that is let go in vain.
inline constexpr double kWrongSignOfNoise = 0.2;
inline constexpr double kStrictOfNoise = 100.0;
/// Of a held row, relative to Σ ‖aᵢ‖ |vᵢ|: doubles can hardly tell whether less is needed.
inline constexpr double kWeakForce = 1e-6;
/// The same: doubles can't tell whether less is needed.
inline constexpr double kBorderlineForce = 1e-7;

}  // namespace tolerance
}  // namespace surefoot
