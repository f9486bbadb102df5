#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/level_rows.hpp"
#include "surefoot/solver/sweep.hpp"
#include "surefoot/solver/sweep_memory.hpp"
#include "surefoot/solver/tableau.hpp"

#include <vector>

namespace surefoot {

/// Finds the active rows of a hierarchy without a guess, level by level, by the primal active-set
/// method of the cascade: each level is minimised from a feasible point, in the columns that the
/// levels before leave free, and stops where rows of higher levels stop it. Small and fast, because
/// each step is a sweep over two short lists, the rows held and the rows that count.
class Descent {
 public:
  explicit Descent(const Hierarchy& capacity);

  /// Sets the sides of all rows of `s` from level `first` on, which must be projected. Where the
  /// levels leave x open, the shortest x is the last level. False where a level takes too many
  /// steps.
  [[nodiscard]] bool find_sides(Sweep& s, const SweepKernels& kernels, int first);

  [[nodiscard]] int num_steps() const { return num_steps_; }

 private:
  struct Block {
    double length;
    int row;
    signed char side;
  };
  enum class Move { negligible, blocked, piece_changed, stationary };

  [[nodiscard]] bool find(const Sweep& s, int first, bool with_norm);
  void begin(const Sweep& s, int first);
  void append_norm();
  [[nodiscard]] bool minimise(int level);
  void list_rows();
  [[nodiscard]] Move descend();
  [[nodiscard]] bool is_negligible() const;
  [[nodiscard]] Block first_block() const;
  [[nodiscard]] bool drop_worst();
  void retire(int level);
  [[nodiscard]] bool collect_fixed(int level);
  void fix(int row, signed char side);

  SweepMemory memory_;
  const SweepKernels* kernels_ = nullptr;
  Tableau state_;  // values and bounds, by row; it has no columns
  LevelRows rows_;
  std::vector<signed char> side_;  // of rows that have been fixed
  std::vector<int> held_, fixed_;
  std::vector<int> free_;  // constraints and rows of the level, all that can still move
  std::vector<int> constraints_;
  double force_scale_ = 0.0, force_noise_ = 0.0;
  bool has_swept_ = false;  // in the last step
  int num_levels_ = 0, num_steps_ = 0;
};

}  // namespace surefoot
