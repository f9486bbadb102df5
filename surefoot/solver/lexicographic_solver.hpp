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

namespace surefoot::solver {

struct LexicographicOptions {
  RankTolerance rank{};    ///< of independent rows
  bool warm_start = true;  ///< start with the active rows of the last solution
  int max_sweeps = 8;      ///< before the cascade takes over; 0: always the cascade, but 8 with a
                           ///< budget, which the cascade does not support
  /// Of a cold solve, before the descent: sweeps that each activate the most violated row only. For
  /// a hierarchy whose optimum has few active rows of many, such as a trajectory.
  int max_exchanges = 0;
  int max_iterations = 0;  ///< of the cascade in a level; 0: its default
  SolveBudget budget{};    ///< limit of a solve's cost; by default it ends at the optimum
  /// Kernels of an instruction set, from `all_kernels`; null: the fastest.
  const SweepKernels* kernels = nullptr;
  /// Any steady clock [s], for `budget.seconds`, Solution::time and LevelResult::time. The solver
  /// has no other clock: nothing else depends on it.
  double (*clock)() = nullptr;
};

/// Solves strict hierarchies, in microseconds: each level as well as possible without disturbing
/// any level before it.
///
///     Hierarchy hierarchy(2);                            // two unknowns x, of any unit
///     hierarchy.add_level("limits", 4);                  // highest priority first, each with its
///     hierarchy.add_level("wishes", 1);                  // largest number of rows
///     LexicographicSolver solver(hierarchy);             // allocates all memory
///     ...
///     hierarchy.level(0).clear();                        // at each tick
///     Rows limit = hierarchy.level(0).add(1, 7);         // one row with the id 7
///     limit.A << 0.0, 1.0;
///     limit.lower[0] = -10.0;
///     limit.upper[0] = 10.0;                             // the wishes likewise, then
///     const Solution& solution = solver.solve(hierarchy);
///
/// **The problem.** A *row* is lower ≤ a x ≤ upper: an equality if both bounds are the same,
/// one-sided if one is infinite. Its violation is the distance of a x beyond its *bounds*. A
/// *level* has any number of rows and minimises its residual √Σ violation² among all x that no
/// level before it likes less. So contradicting rows are no error: the lower level gives way, and
/// rows within a level meet in their least squares. The length of a row is its weight in its level
/// (Rows::weigh); between levels weights have no effect.
///
/// **The result** is x, the shortest if the levels leave it open, and for each level its residual,
/// the degrees of freedom left below it, and the state of its rows (RowState). A row whose squared
/// length underflows, because all of it is below 1e-154, counts as zero; use numbers within 1e±100.
/// `status` is one of
///
///     optimal          x is the optimum of all levels
///     iteration_cap    ended early: levels before `failed_level` are at their optimum, and x does
///     not
///                      disturb them; that level and those after it are not done (if it is the
///                      number of levels, all are done, and only x is not the shortest yet)
///     invalid_input    NaN, lower > upper, an impossible bound (lower = ∞), rows or finite bounds
///                      larger than 1e150, more levels or rows than the capacity, other unknowns,
///                      an x or a residual whose square overflows: x is zero
///
/// **Cold and warm.** The first solve does not know which rows will be active (held at a bound, or
/// violated). Each later one begins with those of the last, found by the name of their level and
/// their id, so that levels and rows may come, go and change places. A correct guess is confirmed
/// in one sweep over the levels. Any other guess changes the time, never the answer, because the
/// result is checked against the optimality conditions of all levels.
///
/// **A budget** of flops (the same end on every machine) or seconds ends a solve early, with
/// `iteration_cap`. Levels of equalities before the first inequality are always solved, and a
/// sweep, or a step of the descent, is always finished. The partial result of a level is not
/// continued: the next solve begins with its guess, and may need the descent again. So a budget
/// below the cost of a solve may never reach the optimum, however often the same problem is solved;
/// a budget below the cost of a cold solve suits ticks that are rarely late (docs/solver.md has
/// figures). `Solution::flops` is the cost of a solve.
///
/// **Why did a level miss its goal?** `blockers` names the rows above that cost it most, fast
/// enough for every tick; `explain` (explanation.hpp) is exact, afterwards. **Is it really the
/// optimum?** `certify` (certificate.hpp) proves any x, without any solver's code.
///
/// `solve` does not allocate, throw or lock, and its number of steps is bounded by the sizes. The
/// same calls in the same order give the same bits on one machine.
///
/// How: with the guessed rows every level is a set of equalities, solved by one orthogonal
/// factorization from top to bottom (Sweep). If the check fails the guess is improved
/// (ActiveSetSearch, Descent). If that doesn't end within `max_sweeps` the cascade solves
/// (CascadeSolver), which also gives a second answer if the result depends on rounding
/// (Solution::borderline); neither happens with a budget. docs/solver.md has the theory.
class LexicographicSolver {
 public:
  /// Allocates for the unknowns, levels and rows of `capacity`.
  explicit LexicographicSolver(const Hierarchy& capacity, const LexicographicOptions& options = {});

  /// The reference stays valid until the next call.
  const Solution& solve(const Hierarchy& hierarchy) noexcept;

  /// The same x, sooner, with a given solution of the first levels. Ignores a substitution that
  /// does not fit the hierarchy, whose levels are not equalities, or whose numbers overflow when
  /// squared.
  const Solution& solve(const Hierarchy& hierarchy, const Substitution& substitution) noexcept;

  [[nodiscard]] const Solution& solution() const { return solution_; }

  /// Rows of higher levels that hold each level back in the last solution, and their cost; see
  /// BlockerSearch. Computed on call, without allocating; the hierarchy of the last solve must be
  /// unchanged. By level of the capacity.
  ///
  /// Rows of the leading levels, those before the first level with an inequality or solved by a
  /// substitution, count as facts and are never named. Unknown for such a level with a residual,
  /// for a violated level of inequalities right after equalities that leave no freedom, and for all
  /// levels if the cascade solved or the input was invalid.
  const std::vector<LevelBlockers>& blockers() noexcept;

  /// Makes the next solve start without a guess.
  void forget() {
    memory_of_rows_.forget();
    has_guess_ = false;
  }

  /// Sweeps of the last solve; more than `max_sweeps` + `max_exchanges` if the cascade solved, 0 if
  /// the input was invalid.
  [[nodiscard]] int num_sweeps() const { return num_sweeps_; }

  /// Cost of the last solve by its budget's count, without the cascade.
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
  [[nodiscard]] Outcome find_active_rows(bool may_descend, int num_exchanges = 0);
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
  [[nodiscard]] bool depends_on(double pivot, double force) const;
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
  // Best point of the descent: the answer when a budget ends.
  struct KeptPoint {
    Eigen::VectorXd x;
    int level = 0;            // current level there
    bool is_optimal = false;  // all levels are done, and no sweep has disproved it
    std::vector<int> freedom_left;
  };
  KeptPoint kept_;
  int first_level_ = 0;  // first level with a choice: those before are equalities
  int num_sweeps_ = 0, num_descents_ = 0;
  bool has_guess_ = false;                            // from the last solve
  bool is_swept_ = false;                             // the solution is from the last sweep
  bool is_orthonormal_ = true;                        // the basis is
  double keep_tolerance_ = 0.0;                       // after the leading equalities,
  double smallest_pivot_ = 1.0, unused_pivot_ = 1.0;  // as in Sweep
};

}  // namespace surefoot::solver
