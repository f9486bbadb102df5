#include "surefoot/solver/level_rows.hpp"

#include "surefoot/math/numbers.hpp"
#include "surefoot/solver/index.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::solver {
namespace {

using Side = LevelRows::Side;

Side side_of(const RowValues& values, Index row) {
  const double lower = values.lower[row];
  const double upper = values.upper[row];
  const double noise = values.noise(row);
  if (lower == upper) return Side::equality;
  if (values.value[row] > upper + noise) return Side::above;
  if (values.value[row] < lower - noise) return Side::below;
  return Side::inside;
}

}  // namespace

LevelRows::LevelRows(Index max_rows)
    : side_(at(max_rows), Side::inside),
      moved_side_(at(max_rows), Side::inside),
      counting_(at(max_rows), 0),
      rate_(Eigen::VectorXd::Zero(max_rows)),
      residual_(Eigen::VectorXd::Zero(max_rows)),
      counting_residual_(Eigen::VectorXd::Zero(max_rows)) {}

void LevelRows::enter(const RowValues& values) {
  std::fill_n(moved_side_.begin(), values.num_rows - values.level_begin, Side::inside);
  changes_in_place_ = 0;
}

// At a bound, where two pieces meet, the piece of the last search's end: its next step would lead
// there at once.
Side LevelRows::present_side(const RowValues& values, Index i) const {
  const Index row = values.level_begin + i;
  const Side side = side_of(values, row), last = moved_side_[at(i)];
  if (side != Side::inside || last == Side::inside || last == Side::equality) return side;
  const double bound = last == Side::above ? values.upper[row] : values.lower[row];
  return std::abs(values.value[row] - bound) <= values.noise(row) ? last : side;
}

void LevelRows::update(const RowValues& values) {
  num_rows_ = values.num_rows - values.level_begin;
  num_counting_ = 0;
  has_inequalities_ = false;
  for (Index i = 0; i < num_rows_; ++i) {
    const Index row = values.level_begin + i;
    const Side side = present_side(values, i);
    side_[at(i)] = side;
    residual_[i] = residual(values, i, side, 0.0);
    has_inequalities_ = has_inequalities_ || side != Side::equality;
    if (side == Side::inside) continue;
    counting_[at(num_counting_)] = row;
    counting_residual_[num_counting_] = residual_[i];
    ++num_counting_;
  }
}

double LevelRows::residual(const RowValues& values, Index i, Side side, double step) const {
  const Index row = values.level_begin + i;
  const double value = values.value[row] + step * values.motion[row];
  switch (side) {
    case Side::inside:
      return 0.0;
    case Side::below:
      return value - values.lower[row];
    case Side::above:
    case Side::equality:
      break;
  }
  return value - values.upper[row];
}

// Step at which row i changes its side, at least `step`.
double LevelRows::break_point(const RowValues& values, Index i, double step) const {
  const Index row = values.level_begin + i;
  const double rate = rate_[i];
  const Side side = moved_side_[at(i)];
  if (side == Side::equality || rate == 0.0) return kInfinity;
  const bool rising = rate > 0.0;
  if ((side == Side::above && rising) || (side == Side::below && !rising)) return kInfinity;
  const bool meets_upper = side == Side::above || (side == Side::inside && rising);
  const double bound = meets_upper ? values.upper[row] : values.lower[row];
  return std::max(step, (bound - values.value[row]) / rate);
}

void LevelRows::cross(Index i) {
  const bool rising = rate_[i] > 0.0;
  Side& side = moved_side_[at(i)];
  if (side == Side::inside) {
    side = rising ? Side::above : Side::below;
  } else {
    side = Side::inside;
  }
}

// Minimum of the current piece's quadratic along the line.
double LevelRows::newton_step(const RowValues& values, double step) const {
  double slope = 0.0;
  double curvature = 0.0;
  for (Index i = 0; i < num_rows_; ++i) {
    if (moved_side_[at(i)] == Side::inside) continue;
    const double rate = rate_[i];
    slope += residual(values, i, moved_side_[at(i)], step) * rate;
    curvature += rate * rate;
  }
  return slope < 0.0 && curvature > 0.0 ? step - slope / curvature : step;
}

double LevelRows::minimum_along(const RowValues& values, double limit) {
  std::copy_n(side_.begin(), num_rows_, moved_side_.begin());
  double target = 1.0;  // the full step of the first piece
  if (!has_inequalities_) return std::min(target, limit);
  for (Index i = 0; i < num_rows_; ++i) rate_[i] = values.rate(values.level_begin + i);
  double step = 0.0;
  for (Index crossings = 0; crossings <= 2 * num_rows_; ++crossings) {
    Index next = -1;
    double next_step = std::min(target, limit);
    for (Index i = 0; i < num_rows_; ++i) {
      const double candidate = break_point(values, i, step);
      if (candidate < next_step) {
        next_step = candidate;
        next = i;
      }
    }
    step = next_step;
    if (next < 0) break;
    cross(next);
    target = newton_step(values, step);
  }
  return step;
}

void LevelRows::note_step(bool has_moved) {
  has_moved_ = has_moved;
  if (has_moved) {
    changes_in_place_ = 0;
  } else if (has_crossed()) {
    ++changes_in_place_;
  }
}

// Did the last search end in another piece?
bool LevelRows::has_crossed() const {
  return !std::equal(side_.begin(), side_.begin() + num_rows_, moved_side_.begin());
}

// φ is smooth: a descent direction without descent has met the next piece, or rounding.
bool LevelRows::is_stationary(const RowValues& values, double length) const {
  constexpr double kFullStep = 1e-12;
  if (!has_moved_) return !has_crossed() || changes_in_place_ > kMaxChangesInPlace;
  if (std::abs(length - 1.0) > kFullStep) return false;
  for (Index i = 0; i < num_rows_; ++i) {
    const Index row = values.level_begin + i;
    if (side_[at(i)] == moved_side_[at(i)]) continue;
    const double low = values.lower[row] - values.value[row];
    const double high = values.value[row] - values.upper[row];
    if (std::min(std::abs(low), std::abs(high)) > 10.0 * values.noise(row)) return false;
  }
  return true;
}

}  // namespace surefoot::solver
