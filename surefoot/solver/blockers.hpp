#pragma once

#include "surefoot/solver/active_set_search.hpp"
#include "surefoot/solver/explanation.hpp"
#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/sweep.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace surefoot::solver {

/// The rows that hold a level back, as many as fit.
struct LevelBlockers {
  static constexpr std::size_t kCapacity = 8;

  /// False if the solver can't say: see LexicographicSolver::blockers.
  bool is_known = false;
  std::size_t count = 0;
  /// By falling cost; at equal cost limits before equalities, then, also without costs, by
  /// multiplier.
  std::array<Blocker, kCapacity> dearest{};

  [[nodiscard]] std::span<const Blocker> rows() const { return {dearest.data(), count}; }
};

/// Finds the rows of higher levels that hold a level back, in the factorization of the last sweep.
/// Solves nothing and does not allocate, so it can run at every tick.
///
/// With v the residuals of level k, W its equality and violated rows, L the triangle of the rows
/// that hold their bound for it, all in the turned basis, the multipliers are those of
///
///     Wᵀ v + Lᵀ λ = 0.
///
/// L d = eᵢ is the direction that moves row i by 1 and no other held row. With u the part of W d
/// that no direction left to level k can undo, ½ ‖v‖² falls along it by at most
///
///     ½ (vᵀ u)² / ‖u‖²,   so   cost = ‖v‖ − √(‖v‖² − (vᵀ u)² / ‖u‖²),   vᵀ u = −λᵢ.
///
/// This is the drop of the residual if row i gives way and everything else stays. It equals the
/// cost of `explain` while that holds; `explain` gives less if the direction meets an inactive row,
/// more if another active row or a violated row of the level is released on the way, or a violated
/// limit above it approaches its bound.
///
/// If several rows hold the same direction none has a cost alone. Rows that are held only for
/// levels below k hold nothing for k.
class BlockerSearch {
 public:
  explicit BlockerSearch(const Hierarchy& capacity);

  /// For s, swept over the levels [first, num_levels) and found optimal by `search`.
  void find(Sweep& s, const SweepKernels& kernels, int first, const ActiveSetSearch& search);

  /// Makes all levels unknown.
  void forget();

  [[nodiscard]] const std::vector<LevelBlockers>& levels() const { return levels_; }

 private:
  void turn_missed_rows();
  void turn(double* row) const;
  void collect(int level);
  void add_row(int row, double violation);
  void explain(int level);
  void set_forces(int num_columns);
  void set_free_directions(int num_columns);
  bool set_direction(int column, int num_columns);
  [[nodiscard]] bool is_violated(int row) const;
  [[nodiscard]] bool is_held_by_others(int num_columns) const;
  [[nodiscard]] bool is_fixed(int row) const;
  void project_motion();
  [[nodiscard]] bool can_move() const;
  void extend_basis();
  [[nodiscard]] double cost();
  void insert(const Blocker& blocker, LevelBlockers& level) const;

  [[nodiscard]] const double* turned(int row) const {
    return s_->rows + static_cast<std::ptrdiff_t>(row) * s_->stride;
  }

  Sweep* s_ = nullptr;
  const SweepKernels* kernels_ = nullptr;
  const ActiveSetSearch* search_ = nullptr;
  std::vector<LevelBlockers> levels_;
  int first_ = 0;
  double size_ = 0.0;  // ‖x‖

  // Of the current level.
  int level_ = 0;
  std::vector<int> rows_;             // W
  Eigen::VectorXd violation_;         // v
  bool is_missed_ = false;            // beyond rounding
  double row_size_ = 0.0;             // of the longest row of W
  double force_noise_ = 0.0;          // rounding of λ ‖a‖
  Eigen::VectorXd gradient_, force_;  // by column
  Eigen::VectorXd direction_;         // d, by column
  Eigen::VectorXd motion_;            // W d, then u
  Eigen::MatrixXd basis_;             // orthonormal, of what the level can reach alone
  Eigen::Index num_basis_ = 0;
};

}  // namespace surefoot::solver
