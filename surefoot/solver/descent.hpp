#pragma once

#include "surefoot/solver/budget.hpp"
#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/level_rows.hpp"
#include "surefoot/solver/level_timer.hpp"
#include "surefoot/solver/sweep.hpp"

#include <vector>

namespace surefoot::solver {

/// Finds the active rows of a hierarchy level by level, by the cascade's primal active-set method:
/// each level is minimised from the feasible point of the level before, within the satisfied rows
/// of higher levels. Small and fast, because it works in the columns that the leading equalities
/// leave, on a tableau whose columns are turned by one reflection for each held row and a few
/// rotations for each released row.
///
/// The columns of the tableau, from the left: fixed by the levels before | one for each held row,
/// in which these rows are lower triangular | free.
class Descent {
 public:
  explicit Descent(const Hierarchy& capacity);

  /// Sets the sides of all rows of `s` from level `first` on, which must be projected. If the
  /// levels leave x open, the shortest x is the last level. False if a level takes too many steps
  /// or the budget is spent: then y, which is base_value[num_rows …), is feasible for the levels
  /// before `level`, and optimal for them. Each level is a lap of the timer.
  [[nodiscard]] bool find_sides(Sweep& s, const SweepKernels& kernels, int first,
                                BudgetWatch& budget, LevelTimer& timer);

  /// The level at which it ended.
  [[nodiscard]] int level() const { return level_; }

  /// Columns that are free after a level.
  [[nodiscard]] int freedom_left(int level) const {
    return freedom_left_[static_cast<std::size_t>(level)];
  }

  /// The levels left x open, and ‖y‖ was minimised; ‖x‖ is not minimal if the basis is skew.
  [[nodiscard]] bool has_minimised_norm() const { return has_minimised_norm_; }

 private:
  enum class Move { negligible, blocked, piece_changed, stationary };

  void begin(Sweep& s, int first);
  void append_identity();
  void clear_idle_rows();
  void enter(int level);
  [[nodiscard]] RowValues row_values() const;
  [[nodiscard]] bool minimise();
  [[nodiscard]] Move descend();
  void factorize_counting();
  void set_motion();
  void stop_dependent_rows(double slow);
  [[nodiscard]] bool is_dependent(int row) const;
  [[nodiscard]] bool is_negligible() const;
  void hold(int row, signed char side);
  void release(std::size_t place);
  void note_pivot(double relative);
  void weigh_pivots();
  void weigh_forces();
  [[nodiscard]] bool drop_worst();
  void retire();
  void release_idle();
  [[nodiscard]] bool collect_fixed();
  void fix(int row, signed char side);
  void finish();

  [[nodiscard]] double& entry(int row, int column) const {
    return sweep_->tableau[column * sweep_->row_stride + row];
  }
  [[nodiscard]] int first_free() const { return first_column_ + static_cast<int>(held_.size()); }

  void spend();

  Sweep* sweep_ = nullptr;
  BudgetWatch* budget_ = nullptr;
  const SweepKernels* kernels_ = nullptr;
  LevelRows rows_;
  std::vector<double> value_at_zero_, reflection_;
  std::vector<signed char> fixed_side_;  // of fixed rows
  std::vector<int> freedom_left_;        // by level
  std::vector<int> held_, fixed_;        // held_[i] has the column first_column_ + i
  double x_size_ = 0.0, size_ = 0.0;     // of x, of the current direction
  double force_scale_ = 0.0, force_noise_ = 0.0;
  struct Pivots {
    double keep = 0.0, smallest_pivot = 1.0;
  };
  Pivots before_, factorized_;  // at the start of the level, with the counting rows
  int level_ = 0, level_begin_ = 0, level_end_ = 0, first_column_ = 0;
  bool has_factorized_ = false;  // the current counting rows
  bool has_minimised_norm_ = false;
};

}  // namespace surefoot::solver
