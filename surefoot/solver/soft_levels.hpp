#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"

#include <cstddef>
#include <span>

namespace surefoot {

/// Puts levels into a hierarchy, or takes them out, over a time and without a jump of x.
///
/// With x⁻ the optimum without these levels, each of their rows gets the bounds
///
///     lower(s) = min(lower, (1 − s) a x⁻ + s lower)      s = 0: as if the levels weren't there,
///     upper(s) = max(upper, (1 − s) a x⁻ + s upper)      s = 1: as they are,
///
/// an equality b(s) = (1 − s) a x⁻ + s b. Only bounds move, and the lexicographic optimum of given
/// rows A is a continuous function of the bounds, piecewise affine: the violations of a level are
/// the unique shortest ones over a polyhedron whose matrix is fixed, so they are, level by level,
/// and at last so is the shortest x. Lower levels and changes of the active set are covered by it,
/// if the solver returns the shortest x where the hierarchy leaves it open, or a last level leaves
/// nothing open (`add_reference`).
///
/// At s = 0, x⁻ meets the rows and is optimal with them as without. So x goes continuously from x⁻
/// to the optimum with the levels. s decides how fast (see `smooth_ramp`), but the slope dx/ds has
/// no bound that holds for all rows: it is large where rows are nearly dependent, and where a level
/// asks for far more than the limits above allow nearly all of the change can fall into a few
/// ticks. What else changes from tick to tick moves x as it would anyway.
///
/// A transition costs one more solve a tick, for x⁻. All levels that are soft at the same time
/// share one s; to exchange levels, take the old ones out first, then put the new ones in. All
/// memory is taken at construction.
class SoftLevels {
 public:
  /// Sizes come from `capacity`, as for the solver.
  explicit SoftLevels(const Hierarchy& capacity, const LexicographicOptions& options = {});

  /// The hierarchy to solve: `hierarchy` with the levels listed in `soft` at `share` s. Below 0 and
  /// above 1 it is as at 0 and 1. A hierarchy beyond the capacity comes back as it is. The
  /// reference stays valid until the next call, or as long as `hierarchy`. Does not allocate.
  const Hierarchy& update(const Hierarchy& hierarchy, std::span<const std::size_t> soft,
                          double share) noexcept;

 private:
  [[nodiscard]] bool fits(const Hierarchy& hierarchy) const;
  void copy_without(const Hierarchy& hierarchy, std::span<const std::size_t> soft);

  Hierarchy result_;
  LexicographicSolver solver_;
};

}  // namespace surefoot
