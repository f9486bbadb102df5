#include "surefoot/solver/active_set_search.hpp"

#include "surefoot/solver/capacity.hpp"
#include "surefoot/solver/index.hpp"
#include "surefoot/solver/tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace surefoot::solver {
namespace {

/// Up to so many wrong rows, changing them all at once is likely to succeed.
constexpr std::size_t kFewRows = 4;

}  // namespace

ActiveSetSearch::ActiveSetSearch(const Hierarchy& capacity) {
  const std::size_t rows = static_cast<std::size_t>(max_rows(capacity));
  undecided_.reserve(rows);
  wrong_.reserve(rows);
  violated_.reserve(rows);
  fixed_by_.assign(rows, 0);
}

bool ActiveSetSearch::is_optimal(Sweep& s, const SweepKernels& kernels, int first,
                                 LevelTimer& timer) {
  undecided_.clear();
  wrong_.clear();
  size_ = 0.0;
  weakest_force_ = 1.0;
  for (int i = 0; i < s.unknowns; ++i) size_ += s.x[i] * s.x[i];
  way_ = size_ = std::sqrt(size_);
  timer.start();
  for (int k = first; k < s.num_levels; ++k) {
    if (!undecided_.empty()) judge_forces(s, kernels, k);
    judge_own_rows(s, k);
    timer.lap(k);
  }
  has_judged_norm_ = !undecided_.empty();
  if (has_judged_norm_) {
    kernels.factorize_last(s);
    judge_norm(s, kernels);
  }
  violated_.clear();
  if (kernels.has_violated(s, s.level_begin[first], tolerance::kSatisfied * size_)) {
    find_violated(s, first);
  }
  return wrong_.empty() && violated_.empty();
}

void ActiveSetSearch::judge_own_rows(const Sweep& s, int level) {
  const int begin = s.order_begin[level];
  const int num_columns = s.first_column[level + 1] - s.first_column[level];
  // Where rows contradict each other x is small, but their rounding is not.
  for (int i = begin; i < s.order_begin[level + 1]; ++i) {
    const int row = s.order[i];
    const double residual = std::abs(s.residual[row]);
    if (residual > way_ * s.scale[row] && s.scale[row] > 0.0) way_ = residual / s.scale[row];
  }
  for (int i = begin; i < s.order_begin[level + 1]; ++i) {
    const int row = s.order[i];
    fixed_by_[at(row)] = level;
    if (s.side[row] == 2) continue;
    const double pull = s.side[row] * s.residual[row];
    const double unit = s.scale[row] * way_;
    if (pull > tolerance::kViolated * unit) continue;
    fixed_by_[at(row)] = s.num_levels;
    if (pull < -tolerance::kSatisfied * unit) {
      wrong_.push_back(row);
      continue;
    }
    const int column = s.first_column[level] + i - begin;
    const bool has_column = i - begin < num_columns && s.pivot[column] == row;
    undecided_.push_back({row, has_column ? column : -1});
  }
}

int ActiveSetSearch::lowest_column() const {
  int lowest = -1;
  for (const Undecided& u : undecided_) {
    if (u.column >= 0 && (lowest < 0 || u.column < lowest)) lowest = u.column;
  }
  return lowest;
}

void ActiveSetSearch::judge_forces(Sweep& s, const SweepKernels& kernels, int level) {
  double scale = 0.0;
  double noise = 0.0;
  for (int i = s.order_begin[level]; i < s.order_begin[level + 1]; ++i) {
    const int row = s.order[i];
    scale += s.scale[row] * std::abs(s.residual[row]);
    noise += s.scale[row] * s.scale[row] * tolerance::kRounding * size_;
  }
  const int lowest = lowest_column();
  if (scale <= noise || lowest < 0 || lowest >= s.first_column[level]) return;
  kernels.balance(s, level, lowest);
  judge_undecided(s, level, scale, noise);
}

void ActiveSetSearch::judge_norm(Sweep& s, const SweepKernels& kernels) {
  const int lowest = lowest_column();
  if (lowest < 0) return;
  kernels.balance_norm(s, lowest);
  judge_undecided(s, s.num_levels, size_, tolerance::kRounding * size_);
}

void ActiveSetSearch::judge_undecided(const Sweep& s, int level, double scale, double noise) {
  const double wrong = -(tolerance::kWrongSign * scale + tolerance::kWrongSignOfNoise * noise);
  const double strict = tolerance::kStrict * scale + tolerance::kStrictOfNoise * noise;
  const int num_columns = level < s.num_levels ? s.first_column[level] : s.fixed;
  std::size_t kept = 0;
  for (const Undecided& u : undecided_) {
    const bool is_pulled = u.column >= 0 && u.column < num_columns;
    const double force = is_pulled ? s.side[u.row] * s.force[u.row] * s.scale[u.row] : 0.0;
    if (force < wrong) {
      wrong_.push_back(u.row);
    } else if (force > strict) {
      fixed_by_[at(u.row)] = level;
      weakest_force_ = std::min(weakest_force_, force / scale);
    } else {
      undecided_[kept++] = u;
    }
  }
  undecided_.resize(kept);
}

bool ActiveSetSearch::is_frozen(const Sweep& s, int level) const {
  if (s.first_column[level] < s.columns) return false;
  for (int column = 0; column < s.columns; ++column) {
    const int row = s.pivot[column];
    if (row >= 0 && fixed_by_[at(row)] >= level) return false;
  }
  return true;
}

void ActiveSetSearch::find_violated(const Sweep& s, int first) {
  for (int k = first; k < s.num_levels; ++k) {
    if (is_frozen(s, k)) break;  // nothing can move these rows
    for (int row = s.level_begin[k]; row < s.level_begin[k + 1]; ++row) {
      if (s.side[row] != 0) continue;
      const double above = s.value[row] - s.upper[row];
      const double below = s.lower[row] - s.value[row];
      if (!(std::max(above, below) > tolerance::kSatisfied * s.scale[row] * size_)) continue;
      violated_.push_back({row, k, static_cast<signed char>(above > below ? 1 : -1)});
    }
  }
}

bool ActiveSetSearch::is_nearly_optimal() const {
  return wrong_.size() + violated_.size() <= kFewRows;
}

void ActiveSetSearch::improve(Sweep& s) const {
  for (const int row : wrong_) s.side[row] = 0;
  for (const Violated& row : violated_) {
    if (row.level == violated_.front().level) s.side[row.row] = row.side;
  }
}

void ActiveSetSearch::exchange(Sweep& s) const {
  for (const int row : wrong_) s.side[row] = 0;
  const auto beyond = [&s](const Violated& v) {
    return std::max(s.value[v.row] - s.upper[v.row], s.lower[v.row] - s.value[v.row]) /
           s.scale[v.row];
  };
  const auto worst = std::ranges::max_element(violated_, {}, beyond);
  if (worst != violated_.end()) s.side[worst->row] = worst->side;
}

bool ActiveSetSearch::release_idle(Sweep& s) {
  for (const Undecided& u : undecided_) s.side[u.row] = 0;
  return !undecided_.empty();
}

}  // namespace surefoot::solver
