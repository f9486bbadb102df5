#include "surefoot/solver/descent.hpp"

#include "surefoot/math/numbers.hpp"
#include "surefoot/solver/capacity.hpp"
#include "surefoot/solver/index.hpp"
#include "surefoot/solver/sweep_memory.hpp"
#include "surefoot/solver/tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace surefoot::solver {
namespace {

using Side = LevelRows::Side;

/// Rows of the tableau: those of the hierarchy and y.
std::size_t rows_of(const Hierarchy& capacity) {
  return static_cast<std::size_t>(max_rows(capacity) + capacity.unknowns());
}

}  // namespace

Descent::Descent(const Hierarchy& capacity)
    : rows_(static_cast<Eigen::Index>(rows_of(capacity))),
      value_at_zero_(rows_of(capacity), 0.0),
      reflection_(static_cast<std::size_t>(capacity.unknowns()), 0.0),
      fixed_side_(rows_of(capacity), 0),
      freedom_left_(capacity.num_levels() + 1, 0) {
  held_.reserve(rows_of(capacity));
  fixed_.reserve(rows_of(capacity));
}

bool Descent::find_sides(Sweep& s, const SweepKernels& kernels, int first, BudgetWatch& budget,
                         LevelTimer& timer) {
  sweep_ = &s;
  kernels_ = &kernels;
  budget_ = &budget;
  begin(s, first);
  timer.start();
  for (level_ = first; level_ <= s.num_levels && first_column_ < s.columns; ++level_) {
    enter(level_);
    has_minimised_norm_ = level_ == s.num_levels;
    const bool is_minimal = minimise();
    if (is_minimal) retire();
    if (!has_minimised_norm_) timer.lap(level_);
    if (!is_minimal) break;
    freedom_left_[at(level_)] = s.columns - first_column_;
  }
  const bool has_ended = level_ > s.num_levels || first_column_ == s.columns;
  for (int k = level_; k < s.num_levels; ++k) freedom_left_[at(k)] = s.columns - first_column_;
  finish();
  return has_ended;
}

// y = 0: x is where the leading equalities put it.
void Descent::begin(Sweep& s, int first) {
  s.first_row = s.level_begin[first];
  double square = 0.0;
  for (int i = 0; i < s.unknowns && s.columns < s.unknowns; ++i) {
    const double x = s.basis[i * s.stride + s.columns];
    square += x * x;
  }
  x_size_ = std::sqrt(square);
  append_identity();
  kernels_->fill_tableau(s);
  clear_idle_rows();
  std::fill_n(s.limit_lower, s.row_stride, -kInfinity);
  std::fill_n(s.limit_upper, s.row_stride, kInfinity);
  for (int row = s.first_row; row < s.num_rows; ++row) {
    value_at_zero_[at(row)] = s.base_value[row];
    fixed_side_[at(row)] = 0;
  }
  first_column_ = 0;
  held_.clear();
  has_minimised_norm_ = false;
}

// Idle rows share packs with the tableau's: clear them, so that they stay without motion.
void Descent::clear_idle_rows() {
  const Sweep& s = *sweep_;
  const auto clear = [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      s.base_value[row] = 0.0;
      for (int j = 0; j < s.columns; ++j) entry(row, j) = 0.0;
    }
  };
  clear(s.first_row / SweepMemory::kWidestPack * SweepMemory::kWidestPack, s.first_row);
  const int end = SweepMemory::padded(s.end_row);
  clear(s.end_row, end);
  std::fill(s.scale + s.end_row, s.scale + end, 1.0);
}

// The last rows of the tableau are y itself: a last level y = 0.
void Descent::append_identity() {
  Sweep& s = *sweep_;
  s.end_row = s.level_begin[s.num_levels + 1] = s.num_rows + s.columns;
  for (int row = s.num_rows; row < s.end_row; ++row) {
    std::fill_n(s.base + row * s.stride, s.stride, 0.0);
    s.base[row * s.stride + row - s.num_rows] = 1.0;
    s.lower[row] = s.upper[row] = s.base_value[row] = 0.0;
    s.scale[row] = 1.0;
    fixed_side_[at(row)] = 0;
  }
}

void Descent::enter(int level) {
  const Sweep& s = *sweep_;
  level_begin_ = s.level_begin[level];
  level_end_ = s.level_begin[level + 1];
  before_ = {s.keep_tolerance, s.smallest_pivot};
  has_factorized_ = false;
}

RowValues Descent::row_values() const {
  const Sweep& s = *sweep_;
  return {s.base_value, s.lower, s.upper, s.scale, s.motion, level_begin_, level_end_, x_size_};
}

bool Descent::minimise() {
  const int cap = 20 + 2 * level_end_;
  rows_.enter(row_values());
  for (int step = 0; step < cap && !budget_->is_spent(); ++step) {
    spend();
    rows_.update(row_values());
    const Move move = descend();
    if (move == Move::blocked || move == Move::piece_changed) continue;
    rows_.update(row_values());
    weigh_forces();
    if (!drop_worst()) return true;
  }
  return false;
}

// Upper bound of a step: factorizes the counting rows, moves all rows, and holds one.
void Descent::spend() {
  const double free = sweep_->columns - first_column_;
  const double rows = sweep_->end_row - sweep_->first_row;
  const double counting = level_end_ - level_begin_;
  budget_->spend(free * (8.0 * rows + 4.0 * counting * std::min(counting, free)));
}

Descent::Move Descent::descend() {
  has_factorized_ = false;
  if (rows_.num_counting() == 0) return Move::negligible;
  factorize_counting();
  set_motion();
  if (is_negligible()) return Move::negligible;

  int row = -1;
  const double limit = kernels_->longest_step(*sweep_, level_begin_, row);
  const double length = rows_.minimum_along(row_values(), limit);
  kernels_->advance(*sweep_, length);
  x_size_ += length * size_;
  rows_.note_step(length * size_ > kEpsilon * x_size_);
  if (row >= 0 && length >= limit) {
    hold(row, static_cast<signed char>(sweep_->motion[row] > 0.0 ? 1 : -1));
    return Move::blocked;
  }
  return rows_.is_stationary(row_values(), length) ? Move::stationary : Move::piece_changed;
}

// Factorizes the counting rows in the free columns.
void Descent::factorize_counting() {
  Sweep& s = *sweep_;
  s.num_taking_part = 0;
  for (Eigen::Index i = 0; i < rows_.num_counting(); ++i) {
    const int row = static_cast<int>(rows_.counting(i));
    const Side side = rows_.side(row - level_begin_);
    s.side[row] = side == Side::equality ? 2 : static_cast<signed char>(side);
    s.order[s.num_taking_part++] = row;
  }
  s.order_begin[0] = 0;
  s.order_begin[1] = s.num_taking_part;
  const Pivots held{s.keep_tolerance, s.smallest_pivot};
  s.keep_tolerance = before_.keep;
  kernels_->gather(s, first_free());
  kernels_->run(s, 0, 1, nullptr);
  factorized_ = {s.keep_tolerance, s.smallest_pivot};
  s.keep_tolerance = held.keep;
  s.smallest_pivot = held.smallest_pivot;
  has_factorized_ = true;
}

// Full step to the minimum of the counting rows, in all rows.
void Descent::set_motion() {
  Sweep& s = *sweep_;
  kernels_->turn_back(s, first_free());
  double square = 0.0;
  for (int j = first_free(); j < s.columns; ++j) square += s.y[j] * s.y[j];
  size_ = std::sqrt(square);
  const double slow = s.keep_tolerance * size_;
  const bool has_slow = kernels_->move(s, first_free(), tolerance::kRounding * size_, slow);
  for (const int row : held_) s.motion[row] = 0.0;
  if (has_slow) stop_dependent_rows(slow);
}

// Checks slowly moving rows.
void Descent::stop_dependent_rows(double slow) {
  const Sweep& s = *sweep_;
  for (int row = s.first_row; row < s.end_row; ++row) {
    const double motion = std::abs(s.motion[row]);
    if (motion > 0.0 && motion <= slow * s.scale[row] && is_dependent(row)) s.motion[row] = 0.0;
  }
}

// Is only rounding left of the row in the free columns?
bool Descent::is_dependent(int row) const {
  const Sweep& s = *sweep_;
  const double rounding = s.keep_tolerance * s.scale[row];
  double square = 0.0;
  for (int j = first_free(); j < s.columns; ++j) square += entry(row, j) * entry(row, j);
  return square <= rounding * rounding;
}

bool Descent::is_negligible() const {
  const double rounding = rows_.rounding_of_step();
  for (Eigen::Index i = 0; i < rows_.num_counting(); ++i) {
    const Eigen::Index row = rows_.counting(i);
    if (std::abs(sweep_->motion[row]) > row_values().noise(row) + rounding) return false;
  }
  return true;
}

// Gives a constraint at its bound the first free column.
void Descent::hold(int row, signed char side) {
  Sweep& s = *sweep_;
  const int first = first_free();
  double square = 0.0;
  for (int j = first; j < s.columns; ++j) {
    reflection_[at(j)] = entry(row, j);
    square += entry(row, j) * entry(row, j);
  }
  const double norm = std::sqrt(square);
  const double head = reflection_[at(first)] > 0.0 ? -norm : norm;
  const double beta = 1.0 / (square + norm * std::abs(reflection_[at(first)]));
  reflection_[at(first)] -= head;
  kernels_->turn(s, reflection_.data(), beta, first);
  for (int j = first + 1; j < s.columns; ++j) entry(row, j) = 0.0;
  entry(row, first) = head;
  s.side[row] = side;
  s.base_value[row] = side > 0 ? s.upper[row] : s.lower[row];
  s.limit_lower[row] = -kInfinity;
  s.limit_upper[row] = kInfinity;
  held_.push_back(row);
  note_pivot(norm / s.scale[row]);
}

// A weaker pivot of a held row leaves more rounding in all others.
void Descent::note_pivot(double relative) {
  Sweep& s = *sweep_;
  if (relative >= s.smallest_pivot) return;
  s.smallest_pivot = relative;
  s.keep_tolerance = std::max(before_.keep, tolerance::rounding_after(relative));
}

void Descent::weigh_pivots() {
  Sweep& s = *sweep_;
  s.keep_tolerance = before_.keep;
  s.smallest_pivot = before_.smallest_pivot;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const double pivot = std::abs(entry(held_[i], first_column_ + static_cast<int>(i)));
    note_pivot(pivot / s.scale[held_[i]]);
  }
}

// Rotations make the rows after it triangular again, and free its column.
void Descent::release(std::size_t place) {
  Sweep& s = *sweep_;
  const int gone = held_[place];
  budget_->spend(6.0 * (s.end_row - s.first_row) * static_cast<double>(held_.size() - place));
  held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(place));
  for (std::size_t i = place; i < held_.size(); ++i) {
    const int column = first_column_ + static_cast<int>(i);
    const double left = entry(held_[i], column);
    const double right = entry(held_[i], column + 1);
    const double norm = std::hypot(left, right);
    kernels_->rotate(s, column, left / norm, right / norm);
    entry(held_[i], column + 1) = 0.0;
  }
  s.limit_lower[gone] = s.lower[gone];
  s.limit_upper[gone] = s.upper[gone];
  weigh_pivots();
}

// Forces of the held rows at the current point, positive if they push back.
void Descent::weigh_forces() {
  Sweep& s = *sweep_;
  force_scale_ = force_noise_ = 0.0;
  std::fill_n(s.gradient, s.columns, 0.0);
  for (Eigen::Index i = 0; i < rows_.num_counting(); ++i) {
    const int row = static_cast<int>(rows_.counting(i));
    const double residual = rows_.counting_residuals()[i];
    force_scale_ += s.scale[row] * std::abs(residual);
    force_noise_ += s.scale[row] * row_values().noise(row);
    for (int j = first_column_; j < first_free(); ++j) s.gradient[j] += residual * entry(row, j);
  }
  for (int j = first_free() - 1; j >= first_column_; --j) {
    const int row = held_[at(j - first_column_)];
    const double force = -s.gradient[j] / entry(row, j);
    for (int i = first_column_; i < j; ++i) s.gradient[i] += force * entry(row, i);
    s.force[row] = force * s.side[row] * s.scale[row];
  }
}

// Releases the held row that pulls most in the wrong direction.
bool Descent::drop_worst() {
  const Sweep& s = *sweep_;
  double worst =
      -(tolerance::kWrongSign * force_scale_ + tolerance::kWrongSignOfNoise * force_noise_);
  std::size_t place = held_.size();
  for (std::size_t i = 0; i < held_.size(); ++i) {
    if (s.force[held_[i]] >= worst) continue;
    worst = s.force[held_[i]];
    place = i;
  }
  if (place == held_.size()) return false;
  release(place);
  has_factorized_ = false;
  return true;
}

// Fixes rows with the same value at all optima of the level, with their columns.
void Descent::retire() {
  Sweep& s = *sweep_;
  release_idle();
  const bool is_factorized = collect_fixed();
  if (is_factorized) {
    s.keep_tolerance = factorized_.keep;
    s.smallest_pivot = factorized_.smallest_pivot;
  } else {
    s.keep_tolerance = before_.keep;
    s.num_taking_part = static_cast<int>(fixed_.size());
    std::copy(fixed_.begin(), fixed_.end(), s.order);
    kernels_->gather(s, first_free());
    kernels_->fix(s, 0, s.num_taking_part);
  }
  budget_->spend(4.0 * (s.columns - first_column_) * (s.fixed - first_column_) *
                 (s.end_row - s.first_row));
  for (int j = first_free(); j < s.fixed; ++j) {
    if (s.beta[j] != 0.0) kernels_->turn(s, s.reflectors + j * s.stride, s.beta[j], j);
  }
  first_column_ = s.fixed;
  held_.clear();
  for (int row = level_begin_; row < level_end_; ++row) {
    if (fixed_side_[at(row)] != 0) continue;
    s.limit_lower[row] = s.lower[row];
    s.limit_upper[row] = s.upper[row];
  }
}

// Held rows that don't push back become constraints again.
void Descent::release_idle() {
  const double strict =
      tolerance::kStrict * force_scale_ + tolerance::kStrictOfNoise * force_noise_;
  for (std::size_t i = held_.size(); i-- > 0;) {
    const int row = held_[i];
    if (sweep_->force[row] > strict) {
      fixed_side_[at(row)] = sweep_->side[row];
    } else {
      release(i);
      has_factorized_ = false;
    }
  }
}

// Lists rows of the level with the same residual at all of its optima. True if these are the rows
// of the last factorization, which can then be used.
bool Descent::collect_fixed() {
  const Sweep& s = *sweep_;
  fixed_.clear();
  for (int row = level_begin_; row < level_end_; ++row) {
    const Side side = rows_.side(row - level_begin_);
    const bool is_violated = std::abs(rows_.residuals()[row - level_begin_]) >
                             tolerance::kViolated * s.scale[row] * x_size_;
    if (side == Side::equality || is_violated) fix(row, static_cast<signed char>(side));
  }
  return has_factorized_ && static_cast<int>(fixed_.size()) == s.num_taking_part;
}

void Descent::fix(int row, signed char side) {
  fixed_side_[at(row)] = side;
  fixed_.push_back(row);
}

// Restores the sweep, with the sides found.
void Descent::finish() {
  Sweep& s = *sweep_;
  for (int row = s.first_row; row < s.num_rows; ++row) {
    s.base_value[row] = value_at_zero_[at(row)];
    s.side[row] = s.lower[row] == s.upper[row] ? 2 : fixed_side_[at(row)];
  }
}

}  // namespace surefoot::solver
