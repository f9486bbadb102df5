#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/solution.hpp"

#include <bitset>
#include <cstddef>

namespace surefoot::solver {

/// The present levels of a hierarchy, by index; from the 64th on all are.
using LevelSet = std::bitset<64>;

/// Moves a hierarchy from one set of its levels to another over a time, without a jump of x:
///
///     x(s) = (1 − s) x⁻ + s x⁺     x⁻, x⁺ the optima with the levels before and after, s = 0 … 1
///
///     const Solution& before = first_solver.solve(soft.select(hierarchy, levels_before));
///     const Solution& after = second_solver.solve(soft.select(hierarchy, levels_after));
///     const Solution& solution = soft.between(hierarchy, before, after, share);
///
/// A tick changes x by Δs (x⁺ − x⁻): always the same share of the change. All levels above the
/// first that changes stay at their optimum: x⁻ and x⁺ are in the convex set of their optima, and
/// so is what lies between. A level below it is not at its own optimum on the way, but no worse
/// than (1 − s) ‖v(x⁻)‖ + s ‖v(x⁺)‖; rows that both satisfy stay satisfied. So x(s) is not the
/// optimum of any hierarchy, and no certificate proves it: its status is that of the two sides. All
/// memory is allocated at construction.
class SoftLevels {
 public:
  explicit SoftLevels(const Hierarchy& capacity);

  /// The hierarchy with the rows of the levels in `present`; the others have none. `hierarchy` must
  /// be within the capacity; with other unknowns it is returned as it is, for the solver to refuse.
  /// Levels have the capacity's names: a solver finds rows of its last solution only if the
  /// hierarchy's levels are in the capacity's order. The reference stays valid until the next call.
  /// Does not allocate.
  const Hierarchy& select(const Hierarchy& hierarchy, const LevelSet& present) noexcept;

  /// x(s), and the states of the rows of `hierarchy`, which has all levels of both sides; a level
  /// on one side only has a residual, too. The status is the worse of the two: `optimal` says that
  /// both sides are, not that x(s) is; borderline if one side is. A NaN share is 0. `time` and
  /// `flops` are 0. The reference stays valid until the next call. Does not allocate.
  const Solution& between(const Hierarchy& hierarchy, const Solution& before, const Solution& after,
                          double share) noexcept;

 private:
  void describe(const Hierarchy& hierarchy);
  void judge(const Solution& before, const Solution& after);

  Hierarchy selected_;
  Solution solution_;
  Eigen::VectorXd value_;  // of the rows of a level
};

}  // namespace surefoot::solver
