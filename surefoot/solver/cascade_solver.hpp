#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/level_solver.hpp"
#include "surefoot/solver/solution.hpp"
#include "surefoot/solver/tableau.hpp"

namespace surefoot::solver {

struct CascadeOptions {
  RankTolerance rank;      ///< of independent rows
  int max_iterations = 0;  ///< of the active-set method in a level; 0: 50 + 10 × rows so far
  /// Any steady clock [s], for Solution::time and the times of levels; nothing else depends on it.
  double (*clock)() = nullptr;
};

/// The paper's cascade (Eqs. 8–13), exact: level k is solved in the null space of all that the
/// levels before it determine, subject to their inequality rows,
///
///     z* = argmin_z ½ ‖violation of level k at x + Z z‖²   s.t.   lower ≤ aᵢ (x + Z z) ≤ upper
///     x ← x + Z z*,   Z ← Z N(rows determined by level k)
///
/// starting from x = 0, Z = I. A level can't fail: z = 0 is always feasible, and contradictions end
/// in their least violation. If the hierarchy leaves x open, each level has changed it by the least
/// norm, from 0. There is no regularisation and no normal equation.
///
/// All memory is allocated at construction; `solve` does not allocate, throw or lock, and gives the
/// same bits for the same input.
class CascadeSolver {
 public:
  /// Sizes come from `capacity`: unknowns, number of levels, and their max_rows.
  explicit CascadeSolver(const Hierarchy& capacity, const CascadeOptions& options = {});

  /// The reference stays valid until the next call. `invalid_input` if the hierarchy exceeds the
  /// capacity, or has NaN, lower > upper, an impossible bound (lower = ∞), or a row or finite bound
  /// beyond 1e150.
  const Solution& solve(const Hierarchy& hierarchy) noexcept;

  [[nodiscard]] const Solution& solution() const { return solution_; }

 private:
  [[nodiscard]] double now() const { return options_.clock != nullptr ? options_.clock() : 0.0; }
  [[nodiscard]] int max_iterations() const;
  void describe(const Level& level, LevelResult& result) const;

  CascadeOptions options_;
  Tableau tableau_;
  LevelSolver level_solver_;
  Solution solution_;
};

}  // namespace surefoot::solver
