#include "surefoot/solver/level_solver.hpp"

#include "surefoot/math/numbers.hpp"
#include "surefoot/solver/index.hpp"
#include "surefoot/solver/tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::solver {
namespace {

using Side = LevelRows::Side;

}  // namespace

LevelSolver::LevelSolver(Index unknowns, Index max_rows)
    : factorization_(max_rows, unknowns),
      turning_(max_rows, unknowns),
      working_set_(unknowns),
      rows_(max_rows),
      selected_(at(max_rows), 0),
      factorized_(at(max_rows), 0),
      direction_(Eigen::VectorXd::Zero(unknowns)),
      gradient_(Eigen::VectorXd::Zero(unknowns)) {}

void LevelSolver::reset(const RankTolerance& tolerance) {
  tolerance_ = tolerance;
  smallest_pivot_ = 1.0;
  is_borderline_ = false;
}

bool LevelSolver::minimize(Tableau& tableau, int max_iterations) {
  working_set_.clear(tableau);
  turning_.stop();
  may_turn_ = true;
  num_factorized_ = -1;
  zero_steps_ = 0;
  rows_.enter(tableau.row_values());
  force_scale_ = force_noise_ = 0.0;
  for (iterations_ = 0; iterations_ < max_iterations; ++iterations_) {
    rows_.update(tableau.row_values());
    const Move move = descend(tableau);
    if (move == Move::blocked || move == Move::piece_changed) continue;
    rows_.update(tableau.row_values());
    if (drop_constraint(tableau)) continue;
    if (!turning_.is_running()) return true;
    turning_.stop();  // a fresh factorization confirms the end
    may_turn_ = false;
  }
  return false;
}

LevelSolver::Move LevelSolver::descend(Tableau& tableau) {
  const Index free = tableau.num_free() - working_set_.size();
  if (free == 0 || rows_.num_counting() == 0) return Move::negligible;
  choose_direction(tableau);
  if (is_negligible(tableau)) return Move::negligible;

  const Block block = first_block(tableau);
  const double length = rows_.minimum_along(tableau.row_values(), block.length);
  tableau.move(length);
  if (turning_.is_running()) turning_.advance(free, length);
  const bool has_moved = length * direction_.head(free).norm() > kEpsilon * tableau.x_size;
  zero_steps_ = has_moved ? 0 : zero_steps_ + 1;
  rows_.note_step(has_moved);
  if (block.row >= 0 && length >= block.length) {
    hold(tableau, block);
    return Move::blocked;
  }
  return rows_.is_stationary(tableau.row_values(), length) ? Move::stationary : Move::piece_changed;
}

// Goes to the minimum of the current piece over the free columns.
void LevelSolver::choose_direction(Tableau& tableau) {
  const Index first = tableau.first_free + working_set_.size();
  auto direction = direction_.head(tableau.unknowns - first);
  if (turning_.is_running()) {
    turning_.step(direction);
  } else {
    for (Index i = 0; i < rows_.num_counting(); ++i) selected_[at(i)] = rows_.counting(i);
    factorize(tableau, first, rows_.num_counting());
    factorization_.least_squares_step(rows_.counting_residuals(), direction);
  }
  const double size = direction.norm();
  if (!std::isfinite(size)) tableau.x_size = kInfinity;  // invalidates the result
  tableau.set_direction(first, direction, present_tolerance(tableau).keep);
}

void LevelSolver::hold(Tableau& tableau, const Block& block) {
  const bool is_upper = block.side > 0;
  tableau.value[block.row] = is_upper ? tableau.upper[block.row] : tableau.lower[block.row];
  if (may_turn_ && !turning_.is_running()) start_turning(tableau);
  working_set_.add(tableau, block.row, block.side, turning_);
  num_factorized_ = -1;
}

// From its first constraint on, a large level of equalities is updated.
void LevelSolver::start_turning(const Tableau& tableau) {
  may_turn_ = false;
  if (rows_.has_inequalities() || tableau.num_free() < kMinTurningColumns) return;
  rows_.update(tableau.row_values());
  const Index count = tableau.num_rows - tableau.level_begin;
  (void)turning_.start(
      tableau.T.block(tableau.level_begin, tableau.first_free, count, tableau.num_free()),
      rows_.residuals());
}

// Factorizes the first `num_rows` selected rows in the columns from `first`, unless already done.
void LevelSolver::factorize(const Tableau& tableau, Index first, Index num_rows) {
  if (num_factorized_ == num_rows &&
      std::equal(selected_.begin(), selected_.begin() + num_rows, factorized_.begin())) {
    return;
  }
  const Index free = tableau.unknowns - first;
  auto columns = factorization_.rows_to_fill(num_rows, free);
  auto scales = factorization_.scales_to_fill();
  for (Index i = 0; i < num_rows; ++i) {
    const Index row = selected_[at(i)];
    columns.col(i) = tableau.T.row(row).tail(free).transpose();
    scales[i] = tableau.scale[row];
    factorized_[at(i)] = row;
  }
  factorization_.compute(tolerance_);
  num_factorized_ = num_rows;
}

bool LevelSolver::is_negligible(const Tableau& tableau) const {
  const double rounding = rows_.rounding_of_step();
  for (Index i = 0; i < rows_.num_counting(); ++i) {
    const Index row = rows_.counting(i);
    if (std::abs(tableau.motion[row]) > tableau.noise(row) + rounding) return false;
  }
  return true;
}

LevelSolver::Block LevelSolver::first_block(const Tableau& tableau) const {
  Block block{kInfinity, -1, 0};
  double best_rate = 0.0;
  for (Index row = tableau.unknowns; row < tableau.level_begin; ++row) {
    if (tableau.held[at(row)]) continue;
    const double rate = tableau.motion[row];
    if (rate == 0.0) continue;
    const double bound = rate > 0.0 ? tableau.upper[row] : tableau.lower[row];
    const double length = std::max(0.0, (bound - tableau.value[row]) / rate);
    const double relative_rate = std::abs(rate) / tableau.scale[row];
    const bool is_tie = length == block.length && !is_cycling() && relative_rate > best_rate;
    if (length < block.length || is_tie) {
      block = {length, row, rate > 0.0 ? 1 : -1};
      best_rate = relative_rate;
    }
  }
  return block;
}

// Releases the constraint that pulls most in the wrong direction; false if none does.
bool LevelSolver::drop_constraint(Tableau& tableau) {
  update_forces(tableau);
  const double wrong =
      -(tolerance::kWrongSign * force_scale_ + tolerance::kWrongSignOfNoise * force_noise_);
  Index worst = -1;
  for (Index i = 0; i < working_set_.size(); ++i) {
    if (working_set_[i].force >= wrong) continue;
    const bool better =
        worst < 0 || (is_cycling() ? working_set_[i].row < working_set_[worst].row
                                   : working_set_[i].force < working_set_[worst].force);
    if (better) worst = i;
  }
  if (worst < 0) return false;
  working_set_.remove(tableau, worst, turning_);
  num_factorized_ = -1;
  return true;
}

void LevelSolver::update_forces(const Tableau& tableau) {
  const Index held = working_set_.size();
  const Index count = tableau.num_rows - tableau.level_begin;
  const auto scale = tableau.scale.segment(tableau.level_begin, count).array();
  force_scale_ = (scale * rows_.residuals().array().abs()).sum();
  force_noise_ = 0.0;
  for (Index i = 0; i < rows_.num_counting(); ++i) {
    force_noise_ += tableau.scale[rows_.counting(i)] * tableau.noise(rows_.counting(i));
  }
  if (held == 0) return;
  auto gradient = gradient_.head(held);
  gradient.noalias() =
      tableau.T.block(tableau.level_begin, tableau.first_free, count, held).transpose() *
      rows_.residuals();
  working_set_.set_forces(tableau, gradient);
}

void LevelSolver::retire(Tableau& tableau) {
  release_idle_constraints(tableau);
  const double smallest_held = working_set_.smallest_pivot(tableau);
  const Index num_determined = collect_determined_rows(tableau);
  tableau.first_free += working_set_.size();
  const Index free = tableau.num_free();
  if (num_determined > 0 && free > 0) {
    factorize(tableau, tableau.first_free, num_determined);
    if (factorization_.num_fixed() < free) {  // otherwise no columns remain to be turned
      factorization_.apply_on_the_right(tableau.rows(tableau.first_free, free),
                                        tableau.scratch.head(tableau.num_rows));
    }
    tableau.first_free += factorization_.num_fixed();
    note_pivot(factorization_.smallest_pivot());
    is_borderline_ = is_borderline_ || factorization_.has_unused();
  }
  note_pivot(smallest_held);
  mark_remaining(tableau);
  working_set_.clear(tableau);
  tableau.retire();
}

void LevelSolver::release_idle_constraints(Tableau& tableau) {
  const double strict =
      tolerance::kStrict * force_scale_ + tolerance::kStrictOfNoise * force_noise_;
  for (Index i = working_set_.size() - 1; i >= 0; --i) {
    if (working_set_[i].force > strict) {
      const double clear = tolerance::kWeakForce * force_scale_;
      is_borderline_ = is_borderline_ || working_set_[i].force < clear;
      continue;
    }
    working_set_.remove(tableau, i, turning_);
    num_factorized_ = -1;
  }
}

// Rows of the level with the same residual at all of its optima.
Index LevelSolver::collect_determined_rows(const Tableau& tableau) {
  Index count = 0;
  for (Index i = 0; i < tableau.num_rows - tableau.level_begin; ++i) {
    const Index row = tableau.level_begin + i;
    const double clearly = tolerance::kViolated * tableau.scale[row] * tableau.x_size;
    const bool is_determined =
        rows_.side(i) == Side::equality || std::abs(rows_.residuals()[i]) > clearly;
    if (is_determined) selected_[at(count++)] = row;
  }
  return count;
}

// Keeps as constraints the rows that are not fixed and can still move.
void LevelSolver::mark_remaining(Tableau& tableau) {
  const Index free = tableau.num_free();
  for (Index row = tableau.unknowns; row < tableau.num_rows; ++row) {
    const double left = tableau.T.row(row).tail(free).norm();
    tableau.keep[at(row)] = left > tolerance_.keep * tableau.scale[row] && !tableau.held[at(row)];
  }
  for (Index i = 0; i < tableau.num_rows - tableau.level_begin; ++i) {
    if (rows_.side(i) == Side::equality) tableau.keep[at(tableau.level_begin + i)] = 0;
  }
}

// Weaker pivots leave more rounding in the remaining rows.
void LevelSolver::note_pivot(double relative) {
  smallest_pivot_ = std::min(smallest_pivot_, relative);
  tolerance_.keep = std::max(tolerance_.keep, tolerance::rounding_after(smallest_pivot_));
}

// Includes the constraints held now.
RankTolerance LevelSolver::present_tolerance(const Tableau& tableau) const {
  const double pivot = std::min(smallest_pivot_, working_set_.smallest_pivot(tableau));
  return {tolerance_.solve, std::max(tolerance_.keep, tolerance::rounding_after(pivot))};
}

}  // namespace surefoot::solver
