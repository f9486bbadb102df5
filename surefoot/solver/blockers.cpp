#include "surefoot/solver/blockers.hpp"

#include "surefoot/solver/capacity.hpp"
#include "surefoot/solver/index.hpp"
#include "surefoot/solver/row_states.hpp"
#include "surefoot/solver/tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace surefoot::solver {
namespace {

using Eigen::Index;

/// Smallest multiplier beyond rounding, relative to Σ ‖aᵢ‖ |vᵢ|.
constexpr double kMinMultiplier = 1e-9;
/// Relative difference of equal costs.
constexpr double kSameCost = 1e-6;
/// Relative rounding of a direction.
constexpr double kRank = 1e-8;

double violation(const Sweep& s, int row) {
  return signed_violation(s.value[row], s.lower[row], s.upper[row]);
}

double dot(const double* a, const Eigen::VectorXd& b, Index first, Index end) {
  double sum = 0.0;
  for (Index j = first; j < end; ++j) sum += a[j] * b[j];
  return sum;
}

/// Were columns before this one taken at once, by rows without a triangle? So is a level of
/// equalities that leaves no freedom, if only inequalities follow.
bool has_square_level(const Sweep& s, int num_columns) {
  for (int column = 0; column < num_columns; ++column) {
    if (s.pivot[column] < 0 && s.beta[column] == 0.0) return true;
  }
  return false;
}

struct LevelRange {
  int begin, end;
};

/// Does an inactive row of these levels at its bound, parallel to this one, forbid moving it
/// further to this side?
bool has_twin(const Sweep& s, int row, int side, LevelRange levels) {
  const Eigen::Map<const Eigen::VectorXd> a(s.a[row], s.unknowns);
  for (int i = s.level_begin[levels.begin]; i < s.level_begin[levels.end]; ++i) {
    if (s.side[i] != 0 || std::abs(s.state[i]) != 1) continue;
    const Eigen::Map<const Eigen::VectorXd> other(s.a[i], s.unknowns);
    const double ratio = a.dot(other) / (s.scale[row] * s.scale[row]);
    if (s.state[i] * side * ratio <= 0.0) continue;
    if ((other - ratio * a).norm() <= kRank * s.scale[i]) return true;
  }
  return false;
}

}  // namespace

BlockerSearch::BlockerSearch(const Hierarchy& capacity)
    : levels_(capacity.num_levels()),
      violation_(max_rows_of_a_level(capacity)),
      gradient_(capacity.unknowns()),
      force_(capacity.unknowns()),
      direction_(capacity.unknowns()),
      motion_(max_rows_of_a_level(capacity)),
      basis_(max_rows_of_a_level(capacity),
             std::min(max_rows_of_a_level(capacity), capacity.unknowns())) {
  rows_.reserve(at(max_rows_of_a_level(capacity)));
}

void BlockerSearch::forget() {
  for (LevelBlockers& level : levels_) {
    level.is_known = false;
    level.count = 0;
  }
}

void BlockerSearch::find(Sweep& s, const SweepKernels& kernels, int first,
                         const ActiveSetSearch& search) {
  s_ = &s;
  kernels_ = &kernels;
  search_ = &search;
  size_ = search.x_size();
  first_ = first;
  forget();
  turn_missed_rows();
  for (int k = 0; k < s.num_levels; ++k) {
    collect(k);
    const bool can_tell = k >= first && !has_square_level(s, s.first_column[k]);
    levels_[at(k)].is_known = can_tell || !is_missed_;
    if (can_tell && is_missed_) explain(k);
  }
}

// Violated rows that nothing can move are not part of the sweep, so they are not turned yet.
void BlockerSearch::turn_missed_rows() {
  Sweep& s = *s_;
  for (int row = s.level_begin[first_]; row < s.num_rows; ++row) {
    if (s.side[row] != 0 || !is_violated(row)) continue;
    if (s.is_identity() || s.base_value[row] == std::numeric_limits<double>::infinity()) {
      kernels_->project(s, &row, 1);
    }
    double* to = s.rows + static_cast<std::ptrdiff_t>(row) * s.stride;
    std::copy_n(s.base + static_cast<std::ptrdiff_t>(row) * s.stride, s.stride, to);
    turn(to);
  }
}

bool BlockerSearch::is_violated(int row) const {
  return std::abs(violation(*s_, row)) > tolerance::kViolated * s_->scale[row] * size_;
}

// row ← row Q.
void BlockerSearch::turn(double* row) const {
  const Sweep& s = *s_;
  for (int column = 0; column < s.fixed; ++column) {
    if (s.beta[column] == 0.0) continue;
    const double* v = s.reflectors + static_cast<std::ptrdiff_t>(column) * s.stride;
    double along = 0.0;
    for (int j = column; j < s.columns; ++j) along += row[j] * v[j];
    for (int j = column; j < s.columns; ++j) row[j] -= s.beta[column] * along * v[j];
  }
}

void BlockerSearch::collect(int level) {
  const Sweep& s = *s_;
  level_ = level;
  rows_.clear();
  is_missed_ = false;
  row_size_ = force_noise_ = 0.0;
  for (int row = s.level_begin[level]; row < s.level_begin[level + 1]; ++row) {
    if (is_violated(row) || s.lower[row] == s.upper[row]) add_row(row, violation(s, row));
    is_missed_ = is_missed_ || is_violated(row);
  }
}

void BlockerSearch::add_row(int row, double by) {
  const double size = s_->scale[row];
  violation_[static_cast<Index>(rows_.size())] = by;
  rows_.push_back(row);
  row_size_ = std::max(row_size_, size);
  force_noise_ +=
      kMinMultiplier * size * std::abs(by) + 5.0 * tolerance::kRounding * size * size * size_;
}

void BlockerSearch::explain(int level) {
  const Sweep& s = *s_;
  const int num_columns = s.first_column[level];
  set_forces(num_columns);
  set_free_directions(num_columns);
  for (int column = 0; column < num_columns; ++column) {
    const int row = s.pivot[column];
    if (row < 0 || !is_fixed(row)) continue;
    if (std::abs(force_[column]) * s.scale[row] <= force_noise_) continue;
    const int* next_level = std::upper_bound(s.level_begin, s.level_begin + s.num_levels, row);
    const auto by = static_cast<std::size_t>(next_level - s.level_begin - 1);
    Blocker blocker{{by, row - s.level_begin[by]}, std::abs(force_[column]), 0.0};
    const int side = force_[column] > 0.0 ? 1 : -1;
    if (set_direction(column, num_columns) && !has_twin(s, row, side, {first_, level})) {
      project_motion();
      if (can_move()) blocker.cost = cost();
    }
    insert(blocker, levels_[at(level)]);
  }
}

// Lᵀ λ = −Wᵀ v by back substitution.
void BlockerSearch::set_forces(int num_columns) {
  const Sweep& s = *s_;
  gradient_.head(num_columns).setZero();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double* row = turned(rows_[i]);
    const double by = violation_[static_cast<Index>(i)];
    for (int j = 0; j < num_columns; ++j) gradient_[j] += by * row[j];
  }
  for (int column = num_columns - 1; column >= 0; --column) {
    force_[column] = 0.0;
    if (s.pivot[column] < 0) continue;
    const double* row = turned(s.pivot[column]);
    const double force = -gradient_[column] * s.inverse_pivot[column];
    force_[column] = force;
    for (int j = 0; j < column; ++j) gradient_[j] += force * row[j];
  }
}

// What the level reaches alone: by free columns, and by giving way of rows that are held only for
// lower levels.
void BlockerSearch::set_free_directions(int num_columns) {
  const Sweep& s = *s_;
  num_basis_ = 0;
  for (int column = num_columns; column < s.columns; ++column) {
    direction_.head(s.columns).setZero();
    direction_[column] = 1.0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      motion_[static_cast<Index>(i)] = turned(rows_[i])[column];
    }
    extend_basis();
  }
  for (int column = 0; column < num_columns; ++column) {
    const int row = s.pivot[column];
    if (row >= 0 && !is_fixed(row) && set_direction(column, num_columns)) extend_basis();
  }
}

bool BlockerSearch::is_fixed(int row) const { return search_->fixed_by(row) <= level_; }

// L d = e by forward substitution, and the motion W d. False if a row without a column forbids it.
bool BlockerSearch::set_direction(int column, int num_columns) {
  const Sweep& s = *s_;
  direction_.head(s.columns).setZero();
  direction_[column] = s.inverse_pivot[column];
  for (int j = column + 1; j < num_columns; ++j) {
    if (s.pivot[j] < 0) continue;
    direction_[j] = -dot(turned(s.pivot[j]), direction_, column, j) * s.inverse_pivot[j];
  }
  if (is_held_by_others(num_columns)) return false;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    motion_[static_cast<Index>(i)] = dot(turned(rows_[i]), direction_, column, num_columns);
  }
  return true;
}

bool BlockerSearch::is_held_by_others(int num_columns) const {
  const Sweep& s = *s_;
  const double small = kRank * direction_.head(num_columns).norm();
  const auto holds = [&](int row) {
    return std::abs(dot(turned(row), direction_, 0, num_columns)) > small * s.scale[row];
  };
  for (int k = first_; k < level_; ++k) {
    const int used = s.first_column[k + 1] - s.first_column[k];
    for (int i = s.order_begin[k]; i < s.order_begin[k + 1]; ++i) {
      const int place = i - s.order_begin[k];
      const bool has_column = place < used && s.pivot[s.first_column[k] + place] == s.order[i];
      if (!has_column && is_fixed(s.order[i]) && holds(s.order[i])) return true;
    }
    for (int row = s.level_begin[k]; row < s.level_begin[k + 1]; ++row) {
      if (s.side[row] == 0 && is_violated(row) && holds(row)) return true;
    }
  }
  return false;
}

// Gram-Schmidt, twice.
void BlockerSearch::project_motion() {
  const auto rows = static_cast<Index>(rows_.size());
  for (Index i = 0; i < 2 * num_basis_; ++i) {
    const auto column = basis_.col(i % num_basis_).head(rows);
    motion_.head(rows) -= column.dot(motion_.head(rows)) * column;
  }
}

// Is the motion more than rounding?
bool BlockerSearch::can_move() const {
  const auto rows = static_cast<Index>(rows_.size());
  return motion_.head(rows).norm() > kRank * row_size_ * direction_.head(s_->columns).norm();
}

void BlockerSearch::extend_basis() {
  const auto rows = static_cast<Index>(rows_.size());
  if (num_basis_ == std::min(rows, basis_.cols())) return;
  project_motion();
  if (!can_move()) return;
  basis_.col(num_basis_++).head(rows) = motion_.head(rows) / motion_.head(rows).norm();
}

// ‖v‖ − ‖v − u (vᵀ u) / ‖u‖²‖ without cancellation.
double BlockerSearch::cost() {
  const auto rows = static_cast<Index>(rows_.size());
  const auto v = violation_.head(rows);
  auto u = motion_.head(rows);
  const double share = v.dot(u) / u.squaredNorm();
  const double fall = share * share * u.squaredNorm();
  u = v - share * u;
  return fall / (v.norm() + u.norm());
}

void BlockerSearch::insert(const Blocker& blocker, LevelBlockers& level) const {
  const auto is_limit = [&](const Blocker& one) {
    const auto row = s_->level_begin[one.at.level] + one.at.row;
    return s_->lower[row] != s_->upper[row];
  };
  const auto is_dearer = [&](const Blocker& a, const Blocker& b) {
    if (std::abs(a.cost - b.cost) > kSameCost * std::max(a.cost, b.cost)) return a.cost > b.cost;
    const bool limits_first = a.cost > 0.0 && is_limit(a) != is_limit(b);
    return limits_first ? is_limit(a) : a.multiplier > b.multiplier;
  };
  std::size_t place = level.count;
  while (place > 0 && is_dearer(blocker, level.dearest[place - 1])) --place;
  if (place == LevelBlockers::kCapacity) return;
  level.count = std::min(level.count + 1, LevelBlockers::kCapacity);
  for (std::size_t i = level.count - 1; i > place; --i) level.dearest[i] = level.dearest[i - 1];
  level.dearest[place] = blocker;
}

}  // namespace surefoot::solver
