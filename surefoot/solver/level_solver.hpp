#pragma once

#include "surefoot/solver/level_rows.hpp"
#include "surefoot/solver/row_factorization.hpp"
#include "surefoot/solver/tableau.hpp"
#include "surefoot/solver/turning_least_squares.hpp"
#include "surefoot/solver/working_set.hpp"

#include <Eigen/Core>

#include <vector>

namespace surefoot::solver {

/// Solves one level of the cascade (Eqs. 9–11) in its least-squares form
///
///     min_z ½ ‖violation of the level at x + Z z‖²   subject to the constraints in the tableau
///
/// by a primal active-set method from z = 0, which is feasible by construction. Each step goes to
/// the minimum of the current quadratic piece in the directions left by held constraints, from
/// orthogonal factorizations (H of Eq. 11 is never formed), with an exact line search. Every
/// iterate satisfies all constraints. If a level leaves directions open, z changes as little as
/// possible. A large level of equalities that meets constraints is updated (TurningLeastSquares); a
/// fresh factorization confirms the end.
class LevelSolver {
 public:
  LevelSolver(Eigen::Index unknowns, Eigen::Index max_rows);

  /// Starts a hierarchy.
  void reset(const RankTolerance& tolerance);

  /// Moves the tableau to the optimum of its level; false at the iteration cap.
  [[nodiscard]] bool minimize(Tableau& tableau, int max_iterations);

  /// After `minimize`: fixes all that the level determines (the null space shrinks, Eq. 12) and
  /// turns its other rows into constraints.
  ///
  /// Fixed are (i) equality rows and violated rows of the level, whose residual is unique at the
  /// optimum, and (ii) held constraints with a strictly positive multiplier: all optima of the
  /// level lie on them. Satisfied rows and those with zero multiplier stay inequalities.
  void retire(Tableau& tableau);

  [[nodiscard]] int iterations() const { return iterations_; }

  /// The result since `reset` depends on rounding, see Solution::borderline.
  [[nodiscard]] bool is_borderline() const {
    return is_borderline_ || smallest_pivot_ < tolerance::kWeakPivot;
  }

 private:
  struct Block {
    double length = 0.0;  ///< step to the constraint
    Eigen::Index row = -1;
    int side = 0;
  };
  enum class Move { negligible, blocked, piece_changed, stationary };

  [[nodiscard]] Move descend(Tableau& tableau);
  void choose_direction(Tableau& tableau);
  void hold(Tableau& tableau, const Block& block);
  void start_turning(const Tableau& tableau);
  void factorize(const Tableau& tableau, Eigen::Index first, Eigen::Index num_rows);
  [[nodiscard]] bool is_negligible(const Tableau& tableau) const;
  [[nodiscard]] Block first_block(const Tableau& tableau) const;
  [[nodiscard]] bool drop_constraint(Tableau& tableau);
  void update_forces(const Tableau& tableau);
  void release_idle_constraints(Tableau& tableau);
  [[nodiscard]] Eigen::Index collect_determined_rows(const Tableau& tableau);
  void mark_remaining(Tableau& tableau);
  void note_pivot(double relative);
  [[nodiscard]] RankTolerance present_tolerance(const Tableau& tableau) const;
  [[nodiscard]] bool is_cycling() const { return zero_steps_ > kPatience; }

  static constexpr Eigen::Index kMinTurningColumns = 10;  ///< free columns for updates to pay off
  static constexpr int kPatience = 8;  ///< steps of zero length before Bland's rule

  RankTolerance tolerance_;
  double smallest_pivot_ = 1.0;
  bool is_borderline_ = false;
  RowFactorization factorization_;
  TurningLeastSquares turning_;
  WorkingSet working_set_;
  LevelRows rows_;
  std::vector<Eigen::Index> selected_;    // rows to factorize
  std::vector<Eigen::Index> factorized_;  // rows in the factorization
  Eigen::Index num_factorized_ = -1;      // −1: invalid for the current basis
  Eigen::VectorXd direction_, gradient_;
  double force_scale_ = 0.0, force_noise_ = 0.0;
  int iterations_ = 0, zero_steps_ = 0;
  bool may_turn_ = false;
};

}  // namespace surefoot::solver
