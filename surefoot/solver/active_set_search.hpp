#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/level_timer.hpp"
#include "surefoot/solver/sweep.hpp"

#include <vector>

namespace surefoot::solver {

/// Decides whether the active rows of a sweep are those of the lexicographic optimum, and otherwise
/// which ones to try next.
///
/// An active row is an equality of its own level. Level k pulls at it with the multiplier λ of
///
///     Aₖᵀ vₖ + Σ λᵢ aᵢ = 0   over the rows i of the levels before, vₖ the residuals of level k,
///
/// its own level pulls with its residual. The first level that pulls decides. If it pulls against
/// the bound, the row is fixed for all levels from there on; otherwise the row must be released. If
/// no row must be released and no inactive row is violated, the sweep is the optimum.
class ActiveSetSearch {
 public:
  explicit ActiveSetSearch(const Hierarchy& capacity);

  /// Is s, swept over the levels [first, num_levels), optimal? `s.value` must be valid.
  /// Each level is a lap of the timer.
  [[nodiscard]] bool is_optimal(Sweep& s, const SweepKernels& kernels, int first,
                                LevelTimer& timer);

  /// ‖x‖ of the last `is_optimal`.
  [[nodiscard]] double x_size() const { return size_; }

  /// Smallest force that keeps a row active in the last `is_optimal`, relative to the level that
  /// needs it; 1 if there is none.
  [[nodiscard]] double weakest_force() const { return weakest_force_; }

  /// Did the last `is_optimal` check the pull of ‖y‖?
  [[nodiscard]] bool has_judged_norm() const { return has_judged_norm_; }

  /// After `is_optimal` said no: is `improve` promising?
  [[nodiscard]] bool is_nearly_optimal() const;

  /// Releases all wrong rows, and activates the violated ones of the first level that has some.
  void improve(Sweep& s) const;

  /// The same, but activates only the most violated row.
  void exchange(Sweep& s) const;

  /// Releases active rows that no level pulls at; true if there were any.
  bool release_idle(Sweep& s);

  /// First level for which an active row is fixed; num_levels if there is none.
  [[nodiscard]] int fixed_by(int row) const { return fixed_by_[static_cast<std::size_t>(row)]; }

 private:
  struct Undecided {
    int row, column;
  };
  struct Violated {
    int row, level;
    signed char side;
  };

  void judge_own_rows(const Sweep& s, int level);
  void judge_forces(Sweep& s, const SweepKernels& kernels, int level);
  void judge_norm(Sweep& s, const SweepKernels& kernels);
  void judge_undecided(const Sweep& s, int level, double scale, double noise);
  void find_violated(const Sweep& s, int first);
  [[nodiscard]] int lowest_column() const;
  [[nodiscard]] bool is_frozen(const Sweep& s, int level) const;

  std::vector<Undecided> undecided_;
  std::vector<int> wrong_;
  std::vector<Violated> violated_;
  std::vector<int> fixed_by_;
  double size_ = 0.0;  // ‖x‖
  double way_ = 0.0;  // ‖x‖, or the residuals of the rows so far relative to their length if larger
  double weakest_force_ = 1.0;
  bool has_judged_norm_ = false;
};

}  // namespace surefoot::solver
