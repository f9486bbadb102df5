#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/solution.hpp"

#include <Eigen/Core>

#include <algorithm>

namespace surefoot {

/// Units d of the unknowns, x = d ∘ y, in which the elements of a row are alike: of all |aᵢⱼ| that
/// are not zero
///
///     min Σ (log |aᵢⱼ| + log dⱼ − rᵢ)²   over d and r,   mean log d = 0
///
/// (Curtis and Reid 1972), each dⱼ rounded to a power of two, so that nothing else is. A level has
/// the same optimum in any units, but what rounding does to it has not: what is small beside the
/// rest of a row in one unit is as large in another. All 1 where the units given are good enough,
/// which is where no two of d differ by 4096, and where others would not help: where they don't
/// make the root of that sum a quarter of what it is with d = 1.
///
/// A rank may hang on the units, and what a level gets must not hang on levels below it. So the
/// levels are taken in order of priority: a level's rows count for d only where no rank of the
/// levels before does: of their rows in their order, and of any two of them. Where one does, what
/// these levels have decided of the unknowns that their rows have in common stays. Allocates.
[[nodiscard]] Eigen::VectorXd even_units(const Hierarchy& hierarchy);

/// The hierarchy over y = x / d: the columns of A times d.
[[nodiscard]] Hierarchy in_units(const Hierarchy& hierarchy, const Eigen::VectorXd& units);

/// The same, with a last level that makes ‖d ∘ y‖ least: the shortest x, not the shortest y.
[[nodiscard]] Hierarchy with_shortest_in_units(const Hierarchy& hierarchy,
                                               const Eigen::VectorXd& units);

/// The answer of a solver that is made for this one problem, in units that are even: what
/// `surefoot solve` does. Where `even_units` are 1 the solver's own, to the bit. Allocates.
template <typename Solver, typename Options>
[[nodiscard]] Solution solve_in_even_units(const Hierarchy& hierarchy, const Options& options) {
  const Eigen::VectorXd units = even_units(hierarchy);
  if ((units.array() == 1.0).all()) return Solver(hierarchy, options).solve(hierarchy);
  const Hierarchy question = with_shortest_in_units(hierarchy, units);
  Solution solution = Solver(question, options).solve(question);
  solution.x = solution.x.cwiseProduct(units).eval();
  solution.levels.pop_back();
  solution.failed_level = std::min(solution.failed_level, static_cast<int>(hierarchy.num_levels()));
  return solution;
}

}  // namespace surefoot
