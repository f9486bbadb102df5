#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/solution.hpp"

#include <bitset>
#include <cstddef>

namespace surefoot {

/// Which levels of a hierarchy are there, by index; those from the 64th on always are.
using LevelSet = std::bitset<64>;

/// Takes a hierarchy from one set of its levels to another over a time, without a jump of x:
///
///     x(s) = (1 − s) x⁻ + s x⁺     x⁻, x⁺ the optima with the levels before and after, s = 0 … 1
///
///     const Solution& before = first_solver.solve(soft.select(hierarchy, levels_before));
///     const Solution& after = second_solver.solve(soft.select(hierarchy, levels_after));
///     const Solution& solution = soft.between(hierarchy, before, after, share);
///
/// What changes in a tick is Δs (x⁺ − x⁻): the same share of the change at once, whatever the rows
/// are and however far a level is from what it asks for. All levels above the first that changes
/// are at their optimum throughout: x⁻ and x⁺ lie in the convex set of their optima, and so does
/// what is between. A level below it is not at its own optimum on the way, but no worse than
/// (1 − s) ‖v(x⁻)‖ + s ‖v(x⁺)‖; rows that both satisfy stay satisfied. So x(s) is not the optimum
/// of any hierarchy, and no certificate proves it: its status says how the two sides ended.
///
/// All memory is taken at construction.
class SoftLevels {
 public:
  explicit SoftLevels(const Hierarchy& capacity);

  /// The hierarchy with the rows of the levels in `present`; the others have none. `hierarchy` must
  /// be within the capacity; over other unknowns it comes back as it is, for the solver to refuse.
  /// Level k is called as in the capacity: a solver finds rows of its last solution again where the
  /// hierarchy has its levels in the capacity's order, in any other it begins anew. The reference
  /// stays valid until the next call. Does not allocate.
  const Hierarchy& select(const Hierarchy& hierarchy, const LevelSet& present) noexcept;

  /// x(s), and what each row of `hierarchy`, with all levels of either side, does there; a level
  /// that is on one side only has a residual here, too. The status is the worse of the two sides':
  /// `optimal` says that both are, not that x(s) is. If one side failed, so did what is between. It
  /// is borderline where one side is. A share that is no number is 0. `time` and `flops` are 0. The
  /// reference stays valid until the next call. Does not allocate.
  const Solution& between(const Hierarchy& hierarchy, const Solution& before, const Solution& after,
                          double share) noexcept;

 private:
  void describe(const Hierarchy& hierarchy);
  void judge(const Solution& before, const Solution& after);

  Hierarchy selected_;
  Solution solution_;
  Eigen::VectorXd value_;  // of the rows of a level
};

}  // namespace surefoot
