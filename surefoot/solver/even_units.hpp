#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/solution.hpp"

#include <Eigen/Core>

#include <algorithm>

namespace surefoot::solver {

/// Units d of the unknowns, x = d ∘ y, that equalize the sizes of a row's elements: over all |aᵢⱼ|
/// that are not zero
///
///     min Σ (log |aᵢⱼ| + log dⱼ − rᵢ)²   over d and r,   mean log d = 0
///
/// (Curtis and Reid 1972), with each dⱼ rounded to a power of two, which rounds nothing else. A
/// level has the same optimum in any units, but different rounding: elements that are small in one
/// unit are not in another. All 1 if the given units are good enough: if no two of d differ by a
/// factor of 4096, or d does not reduce the root of that sum to a quarter of its value at d = 1.
///
/// A rank may depend on the units, but a level's result must not depend on levels below it. So the
/// levels are taken in order of priority: a level's rows influence d only if no rank of the levels
/// before changes: of their rows in their order, and of any two of them. Otherwise the relative
/// units of unknowns that appear together in rows of these levels stay. Allocates. these levels
/// have decided of the unknowns that their rows have in common stays. Allocates.
[[nodiscard]] Eigen::VectorXd even_units(const Hierarchy& hierarchy);

/// The hierarchy over y = x / d: the columns of A times d.
[[nodiscard]] Hierarchy in_units(const Hierarchy& hierarchy, const Eigen::VectorXd& units);

/// The same, with a last level that minimises ‖d ∘ y‖: the shortest x, not the shortest y.
[[nodiscard]] Hierarchy with_shortest_in_units(const Hierarchy& hierarchy,
                                               const Eigen::VectorXd& units);

/// Solution of a solver made for this problem, in even units: used by `surefoot solve`. If
/// `even_units` are 1 it is the solver's own, to the bit. Allocates.
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

}  // namespace surefoot::solver
