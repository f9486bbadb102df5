#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/level_timer.hpp"
#include "surefoot/solver/sweep.hpp"

#include <vector>

namespace surefoot {

/// Decides whether the active rows of a sweep are those of the lexicographic optimum, and which
/// other ones to try if not.
///
/// An active row is an equality of its own level. Level k pulls at it with the multiplier λ of
///
///     Aₖᵀ vₖ + Σ λᵢ aᵢ = 0   over the rows i of the levels before, vₖ the residuals of level k,
///
/// its own level pulls with its residual. The first level that pulls decides: against the bound,
/// and the row is fixed for all levels from there on; away from it, and the row must be let go. If
/// no row must be let go and no inactive row is violated, the sweep has found the optimum.
class ActiveSetSearch {
 public:
  explicit ActiveSetSearch(const Hierarchy& capacity);

  /// Whether s, swept over the levels [first, num_levels), is optimal; `s.value` must be valid.
  /// Each level is a lap of the timer.
  [[nodiscard]] bool is_optimal(Sweep& s, const SweepKernels& kernels, int first,
                                LevelTimer& timer);

  /// ‖x‖ of the last `is_optimal`.
  [[nodiscard]] double x_size() const { return size_; }

  /// Of the rows that the last `is_optimal` found to be needed the smallest force, relative to the
  /// level that needs it; 1 where there is none.
  [[nodiscard]] double weakest_force() const { return weakest_force_; }

  /// Whether the last `is_optimal` asked what the length of y pulls at.
  [[nodiscard]] bool has_judged_norm() const { return has_judged_norm_; }

  /// After `is_optimal` said no: whether `improve` is worth a try.
  [[nodiscard]] bool is_nearly_optimal() const;

  /// Lets all rows go that must be let go, and holds those of the first level that are violated.
  void improve(Sweep& s) const;

  /// Active rows that no level pulls at are let go; true if there were any.
  bool release_idle(Sweep& s);

  /// Index of the level from which on a row that takes part is fixed; num_levels if it isn't.
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
  double way_ = 0.0;   // the same, or how far rows of the levels so far pull it, if that is more
  double weakest_force_ = 1.0;
  bool has_judged_norm_ = false;
};

}  // namespace surefoot
