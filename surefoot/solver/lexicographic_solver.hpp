#pragma once

#include "surefoot/solver/active_set_search.hpp"
#include "surefoot/solver/blockers.hpp"
#include "surefoot/solver/budget.hpp"
#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/descent.hpp"
#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/row_memory.hpp"
#include "surefoot/solver/solution.hpp"
#include "surefoot/solver/substitution.hpp"
#include "surefoot/solver/sweep_memory.hpp"

namespace surefoot {

struct LexicographicOptions {
  RankTolerance rank{};    ///< what counts as an independent row
  bool warm_start = true;  ///< begin with the rows that were active in the last solution
  int max_sweeps = 8;      ///< before the cascade takes over; 0: always the cascade, which has no
                           ///< budget: where one is set 0 means 8
  int max_iterations = 0;  ///< of the cascade in a level; 0: its default
  SolveBudget budget{};    ///< see LexicographicSolver
  /// Those of a certain instruction set, out of `all_kernels`; null: the fastest.
  const SweepKernels* kernels = nullptr;
  /// Seconds of any steady clock. The solver has none of its own: what is computed must not depend
  /// on one. Where one is given, Solution::time is measured with it.
  double (*clock)() = nullptr;
};

/// The lexicographic optimum of a hierarchy, in microseconds.
///
/// A guess of the active inequality rows makes every level a set of equalities, solved by one
/// orthogonal factorization from the top to the bottom (see Sweep). The result is checked against
/// the optimality conditions of all levels: it is the optimum if every inactive row is satisfied
/// and the first level that pulls at an active row pulls it against its bound. So a guess changes
/// the time, never the answer. If the check fails the guess is improved (see ActiveSetSearch); if
/// that doesn't end within `max_sweeps`, the cascade solves the hierarchy (CascadeSolver), whose
/// number of iterations is bounded and whose result at the bound is safe.
///
/// Where the hierarchy leaves x open, the shortest x of all optima is returned.
///
/// With a budget the cascade isn't asked, and the search may end within a level. Then the status is
/// `iteration_cap`, the levels before `failed_level` are optimal, and x is feasible for them. All
/// that is computed counts. The leading equalities are always solved; beyond them and its budget a
/// solve costs at most what it had begun, one sweep or one step of the descent.
///
/// The last active rows are remembered by the name of their level and their id (Level::id), across
/// contact switches and reordered levels. All memory is taken at construction; `solve` does not
/// allocate, throw or lock. The same calls in the same order give the same bits on one machine.
class LexicographicSolver {
 public:
  /// Sizes come from `capacity`: unknowns, number of levels, and the levels' max_rows.
  explicit LexicographicSolver(const Hierarchy& capacity, const LexicographicOptions& options = {});

  /// The reference stays valid until the next call. A hierarchy beyond the capacity, with NaN,
  /// with lower > upper or with a bound that can't be met (lower = ∞) is `invalid_input`.
  const Solution& solve(const Hierarchy& hierarchy) noexcept;

  /// The same x, sooner, where somebody has solved the first levels already. A substitution whose
  /// sizes don't fit the hierarchy, or whose levels are no equalities, isn't used.
  const Solution& solve(const Hierarchy& hierarchy, const Substitution& substitution) noexcept;

  [[nodiscard]] const Solution& solution() const { return solution_; }

  /// Which rows of higher levels hold each level back in the last solution, and what they cost it;
  /// see BlockerSearch. Computed when asked, without allocating; until then the hierarchy of the
  /// last solve must be as it was. By level of the capacity.
  ///
  /// Rows of the leading levels, those before the first level with an inequality or those that a
  /// substitution has solved, are taken as facts and never named. Nothing is known of such a level
  /// itself if it has a residual, nor of a violated level of inequalities right after equalities
  /// that leave nothing free, nor of any level where the cascade solved or the input was invalid.
  const std::vector<LevelBlockers>& blockers() noexcept;

  /// The next solve starts without a guess.
  void forget() {
    memory_of_rows_.forget();
    has_guess_ = false;
  }

  /// Sweeps of the last solve; more than `max_sweeps` if the cascade solved, 0 if the input was
  /// invalid.
  [[nodiscard]] int num_sweeps() const { return num_sweeps_; }

  /// What the last solve has counted against its budget; without what the cascade did.
  [[nodiscard]] double flops() const { return budget_.spent(); }

 private:
  const Solution& solve(const Hierarchy& hierarchy, const Substitution* substitution) noexcept;
  void solve_untimed(const Hierarchy& hierarchy, const Substitution* substitution);
  [[nodiscard]] bool fits(const Hierarchy& hierarchy) const;
  [[nodiscard]] bool fits(const Substitution& substitution) const;
  [[nodiscard]] bool measure_columns(const Substitution& substitution);
  [[nodiscard]] bool load(const Hierarchy& hierarchy);
  void reject(const Hierarchy& hierarchy);
  void sweep_leading_equalities();
  void substitute(const Substitution& substitution);
  void make_basis_orthonormal();
  void forget_projections();
  enum class Outcome { optimal, stuck, out_of_budget };

  [[nodiscard]] Outcome find_active_rows(bool may_descend);
  [[nodiscard]] bool begins_far_off();
  [[nodiscard]] Outcome descend();
  void sweep();
  void project_rows(bool are_all);
  void keep_point();
  void take_kept_point();
  void take_from_cascade(const Hierarchy& hierarchy);
  [[nodiscard]] bool polish();
  void describe(const Hierarchy& hierarchy);
  void count_freedom();

  LexicographicOptions options_;
  SweepMemory memory_;
  const SweepKernels& kernels_;
  RowMemory memory_of_rows_;
  ActiveSetSearch search_;
  Descent descent_;
  BudgetWatch budget_;
  CascadeSolver cascade_;
  BlockerSearch blockers_;
  Solution solution_;
  // Where the descent has come to: it is the answer at the end of a budget.
  struct KeptPoint {
    Eigen::VectorXd x;
    int level = 0;  // that it was solving
    std::vector<int> freedom_left;
  };
  KeptPoint kept_;
  int first_level_ = 0;  // of the levels with a choice: those before are equalities
  int num_sweeps_ = 0, num_descents_ = 0;
  bool has_guess_ = false;                              // from the last solve
  bool is_swept_ = false;                               // the solution is that of the last sweep
  bool is_orthonormal_ = true;                          // the basis
  double keep_tolerance_ = 0.0, smallest_pivot_ = 1.0;  // after the leading equalities
};

}  // namespace surefoot
