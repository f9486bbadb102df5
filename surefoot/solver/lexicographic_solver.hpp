#pragma once

#include "surefoot/solver/active_set_search.hpp"
#include "surefoot/solver/blockers.hpp"
#include "surefoot/solver/budget.hpp"
#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/descent.hpp"
#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/level_timer.hpp"
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
  SolveBudget budget{};    ///< what a solve may cost; without one it ends at the optimum
  /// Those of a certain instruction set, out of `all_kernels`; null: the fastest.
  const SweepKernels* kernels = nullptr;
  /// Seconds of any steady clock, for `budget.seconds`, Solution::time and LevelResult::time. The
  /// solver has none of its own: nothing else that it computes can depend on one.
  double (*clock)() = nullptr;
};

/// Solves strict hierarchies, in microseconds: each level as well as possible, without disturbing
/// any before it.
///
///     Hierarchy hierarchy(2);                            // two unknowns x, of any unit
///     hierarchy.add_level("limits", 4);                  // highest priority first, with room for
///     hierarchy.add_level("wishes", 1);                  // so many rows
///     LexicographicSolver solver(hierarchy);             // takes all memory that it will need
///     ...
///     hierarchy.level(0).clear();                        // at each tick
///     Rows limit = hierarchy.level(0).add(1, 7);         // one row, known by its id 7
///     limit.A << 0.0, 1.0;
///     limit.lower[0] = -10.0;
///     limit.upper[0] = 10.0;                             // the wishes likewise, then
///     const Solution& solution = solver.solve(hierarchy);
///
/// **The problem.** A *row* is lower ≤ a x ≤ upper: an equality where both bounds are the same,
/// one-sided where one is infinite. By as much as a x is beyond its *bounds* the row is violated. A
/// *level* has any number of rows and wants the least √Σ violation² of them, among all x with which
/// no level before it gets worse. So rows that contradict each other are no error: the lower level
/// gives way, and within a level they meet in their least squares. The length of a row is its
/// weight in its level (Rows::weigh); between levels no weight counts.
///
/// **What comes back** is x, the shortest where the levels leave it open, and for each level its
/// residual √Σ violation², the degrees of freedom left below it, and what each of its rows does
/// (RowState). A row whose length squared is no number, because all of it is below 1e-154, counts
/// as zero; numbers within 1e±100 keep clear of both ends. `status` says what it is worth:
///
///     optimal          x is the optimum of all levels
///     iteration_cap    ended early: levels before `failed_level` are at their optimum, x does not
///                      disturb them; that level and those after it are not done (where it is
///                      the number of levels, all are, and x is only not yet the shortest)
///     invalid_input    NaN, lower > upper, a bound that can't be met (lower = ∞), rows or finite
///                      bounds larger than 1e150, more levels or rows than there is room for, more
///                      or fewer unknowns than the capacity, an x or a residual whose square no
///                      double holds: x is zero
///
/// **Cold and warm.** The first solve knows nothing of which rows will be active (held at a bound,
/// or violated). Each later one begins with those of the last, found again by the name of their
/// level and their id, so that levels and rows may come, go and change places. A guess that is
/// right is confirmed in one sweep over the levels; any other changes the time, never the answer,
/// since what was found is checked against the optimality conditions of all levels.
///
/// **A budget** of flops (the same end on every machine) or seconds ends a solve early, with
/// `iteration_cap`. Levels of equalities before the first inequality are solved in any case, and
/// what has begun is finished: one sweep, or one step of the descent. What a solve that was cut off
/// had found of a level is not carried on: the next begins with its guess, which may have to be
/// given up for the descent again. So a budget below what a solve takes may never come to the
/// optimum, however often the same problem is solved; one below a cold solve's is for ticks that
/// are late now and then (docs/solver.md has figures). `Solution::flops` says what a solve took.
///
/// **Why did a level not get what it asked for?** `blockers` names the rows above that cost it
/// most, fast enough for every tick; `explain` (explanation.hpp) says it exactly, afterwards. **Is
/// it really the optimum?** `certify` (certificate.hpp) proves any x, without any solver's code.
///
/// `solve` does not allocate, throw or lock, and its number of steps is bounded by the sizes. The
/// same calls in the same order give the same bits on one machine.
///
/// How: the guessed rows make every level a set of equalities, solved by one orthogonal
/// factorization from the top to the bottom (Sweep). If the check fails the guess is improved
/// (ActiveSetSearch, Descent); if that doesn't end within `max_sweeps` the cascade solves
/// (CascadeSolver), and where what was found hangs on little (Solution::borderline) it is asked for
/// a second answer; neither under a budget. docs/solver.md has the theory.
class LexicographicSolver {
 public:
  /// Takes the memory for as many unknowns, levels, and rows in them, as `capacity` has room for.
  explicit LexicographicSolver(const Hierarchy& capacity, const LexicographicOptions& options = {});

  /// The reference stays valid until the next call.
  const Solution& solve(const Hierarchy& hierarchy) noexcept;

  /// The same x, sooner, where somebody has solved the first levels already. A substitution whose
  /// sizes don't fit the hierarchy, whose levels are no equalities, or whose numbers have no
  /// squares, isn't used.
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
  [[nodiscard]] bool load(const Hierarchy& hierarchy);
  void take_times(std::size_t num_levels);
  [[nodiscard]] LevelTimer* timer() { return timer_.has_clock() ? &timer_ : nullptr; }
  void remember(const Hierarchy& hierarchy);
  void reject(const Hierarchy& hierarchy);

  // lexicographic_basis.cpp
  void sweep_leading_equalities();
  [[nodiscard]] bool can_use(const Substitution& substitution) const;
  [[nodiscard]] bool measure_columns(const Substitution& substitution);
  [[nodiscard]] bool is_usable(const Substitution& substitution);
  void substitute(const Substitution& substitution);
  void make_basis_orthonormal();
  void forget_projections();
  void project_rows(bool are_all);

  // lexicographic_search.cpp
  enum class Outcome { optimal, stuck, out_of_budget };
  [[nodiscard]] Outcome find_optimum();
  [[nodiscard]] Outcome find_active_rows(bool may_descend);
  void sweep();
  [[nodiscard]] bool begins_far_off();
  [[nodiscard]] Outcome descend();
  void keep_point(bool has_finished);
  [[nodiscard]] bool polish();

  // lexicographic_answer.cpp
  void take(Outcome outcome, const Hierarchy& hierarchy);
  void take_from_sweep(const Hierarchy& hierarchy);
  void take_kept_point();
  void take_from_cascade(const Hierarchy& hierarchy);
  void ask_cascade(const Hierarchy& hierarchy);
  const Solution& solve_by_cascade(const Hierarchy& hierarchy);
  void adopt(const Solution& solution);
  [[nodiscard]] bool hangs_on(double pivot, double force) const;
  [[nodiscard]] bool is_too_close_to_call() const;
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
  LevelTimer timer_;
  Solution solution_;
  // Where the descent has come to: it is the answer at the end of a budget.
  struct KeptPoint {
    Eigen::VectorXd x;
    int level = 0;            // that it was solving
    bool is_optimal = false;  // none is left, and no sweep has found it wrong
    std::vector<int> freedom_left;
  };
  KeptPoint kept_;
  int first_level_ = 0;  // of the levels with a choice: those before are equalities
  int num_sweeps_ = 0, num_descents_ = 0;
  bool has_guess_ = false;                            // from the last solve
  bool is_swept_ = false;                             // the solution is that of the last sweep
  bool is_orthonormal_ = true;                        // the basis
  double keep_tolerance_ = 0.0;                       // after the leading equalities,
  double smallest_pivot_ = 1.0, unused_pivot_ = 1.0;  // as in Sweep
};

}  // namespace surefoot
