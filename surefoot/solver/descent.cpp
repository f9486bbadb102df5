#include "surefoot/solver/descent.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace surefoot {
namespace {

using Side = LevelRows::Side;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/// As in LevelSolver.
constexpr double kWrongSign = 1e-11;
constexpr double kStrict = 1e-9;
constexpr double kViolated = 1e-9;

Eigen::Index rows_of(const Hierarchy& capacity) {
  Eigen::Index rows = 0;
  for (std::size_t k = 0; k < capacity.num_levels(); ++k) rows += capacity.level(k).max_rows();
  return rows;
}

}  // namespace

Descent::Descent(const Hierarchy& capacity)
    : memory_(capacity, static_cast<std::size_t>(capacity.unknowns())),
      state_(0, rows_of(capacity) + capacity.unknowns()),
      rows_(rows_of(capacity) + capacity.unknowns()) {
  const auto rows = static_cast<std::size_t>(rows_of(capacity) + capacity.unknowns());
  side_.assign(rows, 0);
  held_.reserve(rows);
  fixed_.reserve(rows);
  free_.reserve(rows);
  constraints_.reserve(rows);
}

bool Descent::find_sides(Sweep& s, const SweepKernels& kernels, int first) {
  kernels_ = &kernels;
  if (!find(s, first, false)) return false;
  if (memory_.sweep.columns > 0 && !find(s, first, true)) return false;
  for (int row = s.level_begin[first]; row < s.num_rows; ++row) {
    const bool is_equality = s.lower[row] == s.upper[row];
    s.side[row] = is_equality ? 2 : side_[static_cast<std::size_t>(row)];
  }
  return true;
}

bool Descent::find(const Sweep& s, int first, bool with_norm) {
  begin(s, first);
  if (with_norm) append_norm();
  const int end = s.num_levels + (with_norm ? 1 : 0);
  for (int k = first; k < end && memory_.sweep.columns > 0; ++k) {
    if (!minimise(k)) return false;
    retire(k);
  }
  return true;
}

// A last level y = 0.
void Descent::append_norm() {
  Sweep& t = memory_.sweep;
  for (int j = 0; j < t.columns; ++j) {
    const int row = t.num_rows++;
    std::fill_n(t.base + row * t.stride, t.stride, 0.0);
    t.base[row * t.stride + j] = 1.0;
    t.lower[row] = state_.lower[row] = 0.0;
    t.upper[row] = state_.upper[row] = 0.0;
    t.scale[row] = state_.scale[row] = 1.0;
    t.base_value[row] = state_.value[row] = 0.0;
    free_.push_back(row);
  }
  t.level_begin[num_levels_ + 1] = t.num_rows;
}

// Takes over the projected rows; nothing is held and x is where the leading equalities put it.
void Descent::begin(const Sweep& s, int first) {
  Sweep& t = memory_.sweep;
  t.columns = t.unknowns = s.columns;
  t.stride = s.stride;
  t.num_rows = s.num_rows;
  t.num_levels = 2;
  t.solve_tolerance = s.solve_tolerance;
  t.keep_tolerance = s.keep_tolerance;
  t.smallest_pivot = s.smallest_pivot;
  double square = 0.0;
  for (int i = 0; i < s.unknowns && s.columns < s.unknowns; ++i) {
    const double x = s.basis[i * s.stride + s.columns];
    square += x * x;
  }
  state_.x_size = std::sqrt(square);
  const int begin = s.level_begin[first];
  std::copy(s.base + begin * s.stride, s.base + s.num_rows * s.stride, t.base + begin * t.stride);
  for (int row = begin; row < s.num_rows; ++row) {
    t.lower[row] = state_.lower[row] = s.lower[row];
    t.upper[row] = state_.upper[row] = s.upper[row];
    t.scale[row] = state_.scale[row] = s.scale[row];
    t.base_value[row] = state_.value[row] = s.base_value[row];
  }
  constraints_.clear();
  free_.clear();
  for (int row = begin; row < s.num_rows; ++row) free_.push_back(row);
  std::copy(s.level_begin, s.level_begin + s.num_levels + 1, t.level_begin);
  std::fill(side_.begin(), side_.end(), static_cast<signed char>(0));
  num_levels_ = s.num_levels;
  num_steps_ = 0;
}

bool Descent::minimise(int level) {
  const Sweep& t = memory_.sweep;
  state_.level_begin = t.level_begin[level];
  state_.num_rows = t.level_begin[level + 1];
  held_.clear();
  const int cap = num_steps_ + 20 + 2 * static_cast<int>(state_.num_rows);
  while (num_steps_ < cap) {
    ++num_steps_;
    rows_.update(state_);
    const Move move = descend();
    if (move == Move::blocked || move == Move::piece_changed) continue;
    rows_.update(state_);
    if (!drop_worst()) return true;
  }
  return false;
}

// Rows held at a bound are the first level of the small sweep, rows that count the second.
void Descent::list_rows() {
  Sweep& t = memory_.sweep;
  t.num_taking_part = 0;
  t.order_begin[0] = 0;
  for (const int row : held_) t.order[t.num_taking_part++] = row;
  t.order_begin[1] = t.num_taking_part;
  for (Eigen::Index i = 0; i < rows_.num_counting(); ++i) {
    const int row = static_cast<int>(rows_.counting(i));
    const Side side = rows_.side(row - state_.level_begin);
    t.side[row] = side == Side::equality ? 2 : static_cast<signed char>(side);
    t.order[t.num_taking_part++] = row;
  }
  t.order_begin[2] = t.num_taking_part;
  kernels_->restart(t);
}

Descent::Move Descent::descend() {
  Sweep& t = memory_.sweep;
  has_swept_ = rows_.num_counting() > 0;
  if (!has_swept_) return Move::negligible;
  list_rows();
  kernels_->run(t, 0, 2);
  kernels_->recover(t);
  const int num_rows = static_cast<int>(state_.num_rows);
  double square = 0.0;
  for (int j = 0; j < t.columns; ++j) square += t.y[j] * t.y[j];
  const double size = std::sqrt(square);
  const auto end = std::lower_bound(free_.begin(), free_.end(), num_rows);
  kernels_->multiply(t, free_.data(), static_cast<int>(end - free_.begin()));
  for (auto row = free_.begin(); row != end; ++row) {
    const double motion = t.value[*row];
    const double rounding = t.keep_tolerance * size * t.scale[*row];
    state_.motion[*row] = std::abs(motion) > rounding ? motion : 0.0;
  }
  for (const int row : held_) state_.motion[row] = 0.0;
  if (is_negligible()) return Move::negligible;

  const Block block = first_block();
  const double length = rows_.minimum_along(state_, block.length);
  for (auto row = free_.begin(); row != end; ++row) {
    t.base_value[*row] = state_.value[*row] += length * state_.motion[*row];
  }
  // Rows of later levels follow.
  kernels_->multiply(t, free_.data() + (end - free_.begin()), static_cast<int>(free_.end() - end));
  for (auto row = end; row != free_.end(); ++row) {
    t.base_value[*row] = state_.value[*row] += length * t.value[*row];
  }
  state_.x_size += length * size;
  if (block.row >= 0 && length >= block.length) {
    const bool is_upper = block.side > 0;
    t.base_value[block.row] = state_.value[block.row] =
        is_upper ? state_.upper[block.row] : state_.lower[block.row];
    t.side[block.row] = block.side;
    held_.push_back(block.row);
    return Move::blocked;
  }
  if (!(length * size > kEpsilon * state_.x_size)) return Move::stationary;
  return rows_.is_stationary(state_, length) ? Move::stationary : Move::piece_changed;
}

bool Descent::is_negligible() const {
  for (Eigen::Index i = 0; i < rows_.num_counting(); ++i) {
    const Eigen::Index row = rows_.counting(i);
    if (std::abs(state_.motion[row]) > state_.noise(row)) return false;
  }
  return true;
}

Descent::Block Descent::first_block() const {
  Block block{kInfinity, -1, 0};
  double best_rate = 0.0;
  for (const int row : constraints_) {
    const double rate = state_.motion[row];
    if (rate == 0.0) continue;
    const double bound = rate > 0.0 ? state_.upper[row] : state_.lower[row];
    const double length = std::max(0.0, (bound - state_.value[row]) / rate);
    const double relative_rate = std::abs(rate) / state_.scale[row];
    if (length < block.length || (length == block.length && relative_rate > best_rate)) {
      block = {length, row, static_cast<signed char>(rate > 0.0 ? 1 : -1)};
      best_rate = relative_rate;
    }
  }
  return block;
}

// Forces of the held rows at the present point; lets the worst go that pulls the wrong way.
bool Descent::drop_worst() {
  Sweep& t = memory_.sweep;
  force_scale_ = force_noise_ = 0.0;
  for (Eigen::Index i = 0; i < rows_.num_counting(); ++i) {
    const Eigen::Index row = rows_.counting(i);
    force_scale_ += state_.scale[row] * std::abs(rows_.counting_residuals()[i]);
    force_noise_ += state_.scale[row] * state_.noise(row);
  }
  if (held_.empty() || !has_swept_) return false;
  list_rows();
  kernels_->run(t, 0, 2);
  kernels_->balance(t, 1, 0);
  const double wrong = -(kWrongSign * force_scale_ + force_noise_);
  double worst = wrong;
  int worst_row = -1;
  for (int column = 0; column < t.first_column[1]; ++column) {
    const int row = t.pivot[column];
    if (row < 0) continue;
    t.force[row] *= t.side[row] * t.scale[row];
    if (t.force[row] >= worst) continue;
    worst = t.force[row];
    worst_row = row;
  }
  if (worst_row < 0) return false;
  held_.erase(std::find(held_.begin(), held_.end(), worst_row));
  return true;
}

// Rows that all optima of the level have at the same value leave: with them goes their direction.
void Descent::retire(int level) {
  Sweep& t = memory_.sweep;
  const int end = t.level_begin[level + 1];
  const bool has_all = collect_fixed(level);
  if (!has_all) {
    t.num_taking_part = static_cast<int>(fixed_.size());
    std::copy(fixed_.begin(), fixed_.end(), t.order);
    kernels_->restart(t);
    kernels_->fix(t, 0, t.num_taking_part);
  }
  std::erase_if(free_,
                [&](int row) { return row < end && side_[static_cast<std::size_t>(row)] != 0; });
  if (t.fixed > 0) kernels_->turn(t, free_.data(), static_cast<int>(free_.size()));
  constraints_.clear();
  for (const int row : free_) {
    if (row < end) constraints_.push_back(row);
  }
}

// Lists held rows that push back, and rows of the level whose residual is the same at all of its
// optima. True if these are the rows of the last sweep, so that its factorization can be used.
bool Descent::collect_fixed(int level) {
  const Sweep& t = memory_.sweep;
  const double strict = kStrict * force_scale_ + 100.0 * force_noise_;
  fixed_.clear();
  const int num_held = has_swept_ ? t.first_column[1] : 0;
  for (int column = 0; column < num_held; ++column) {
    const int row = t.pivot[column];
    if (row >= 0 && t.force[row] > strict) fix(row, t.side[row]);
  }
  const int begin = t.level_begin[level];
  for (int row = begin; row < t.level_begin[level + 1]; ++row) {
    const Side side = rows_.side(row - begin);
    const bool is_violated =
        std::abs(rows_.residuals()[row - begin]) > kViolated * state_.scale[row] * state_.x_size;
    if (side == Side::equality || is_violated) fix(row, static_cast<signed char>(side));
  }
  return has_swept_ && static_cast<int>(fixed_.size()) == t.num_taking_part;
}

void Descent::fix(int row, signed char side) {
  side_[static_cast<std::size_t>(row)] = side;
  fixed_.push_back(row);
}

}  // namespace surefoot
