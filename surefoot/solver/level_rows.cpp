#include "surefoot/solver/level_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot {
namespace {

using Index = Eigen::Index;
using Side = LevelRows::Side;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Side side_of(const Tableau& tableau, Index row) {
  const double lower = tableau.lower[row];
  const double upper = tableau.upper[row];
  const double noise = tableau.noise(row);
  if (lower == upper) return Side::equality;
  if (tableau.value[row] > upper + noise) return Side::above;
  if (tableau.value[row] < lower - noise) return Side::below;
  return Side::inside;
}

}  // namespace

LevelRows::LevelRows(Index max_rows)
    : side_(at(max_rows), Side::inside),
      moved_side_(at(max_rows), Side::inside),
      counting_(at(max_rows), 0),
      residual_(Eigen::VectorXd::Zero(max_rows)),
      counting_residual_(Eigen::VectorXd::Zero(max_rows)) {}

void LevelRows::update(const Tableau& tableau) {
  num_rows_ = tableau.num_rows - tableau.level_begin;
  num_counting_ = 0;
  has_inequalities_ = false;
  for (Index i = 0; i < num_rows_; ++i) {
    const Index row = tableau.level_begin + i;
    const Side side = side_of(tableau, row);
    side_[at(i)] = side;
    residual_[i] = residual(tableau, i, side, 0.0);
    has_inequalities_ = has_inequalities_ || side != Side::equality;
    if (side == Side::inside) continue;
    counting_[at(num_counting_)] = row;
    counting_residual_[num_counting_] = residual_[i];
    ++num_counting_;
  }
}

double LevelRows::residual(const Tableau& tableau, Index i, Side side, double step) const {
  const Index row = tableau.level_begin + i;
  const double value = tableau.value[row] + step * tableau.motion[row];
  switch (side) {
    case Side::inside:
      return 0.0;
    case Side::below:
      return value - tableau.lower[row];
    case Side::above:
    case Side::equality:
      break;
  }
  return value - tableau.upper[row];
}

// Where row i changes its side, not before `step`.
double LevelRows::break_point(const Tableau& tableau, Index i, double step) const {
  const Index row = tableau.level_begin + i;
  const double rate = tableau.motion[row];
  const Side side = moved_side_[at(i)];
  if (side == Side::equality || rate == 0.0) return kInfinity;
  const bool rising = rate > 0.0;
  if ((side == Side::above && rising) || (side == Side::below && !rising)) return kInfinity;
  const bool meets_upper = side == Side::above || (side == Side::inside && rising);
  const double bound = meets_upper ? tableau.upper[row] : tableau.lower[row];
  return std::max(step, (bound - tableau.value[row]) / rate);
}

void LevelRows::cross(const Tableau& tableau, Index i) {
  const bool rising = tableau.motion[tableau.level_begin + i] > 0.0;
  Side& side = moved_side_[at(i)];
  if (side == Side::inside) {
    side = rising ? Side::above : Side::below;
  } else {
    side = Side::inside;
  }
}

// Minimum of the quadratic of the present piece along the line.
double LevelRows::newton_step(const Tableau& tableau, double step) const {
  double slope = 0.0;
  double curvature = 0.0;
  for (Index i = 0; i < num_rows_; ++i) {
    if (moved_side_[at(i)] == Side::inside) continue;
    const double rate = tableau.motion[tableau.level_begin + i];
    slope += residual(tableau, i, moved_side_[at(i)], step) * rate;
    curvature += rate * rate;
  }
  return slope < 0.0 && curvature > 0.0 ? step - slope / curvature : step;
}

double LevelRows::minimum_along(const Tableau& tableau, double limit) {
  std::copy_n(side_.begin(), num_rows_, moved_side_.begin());
  double target = 1.0;  // the direction is the full step of the first piece
  if (!has_inequalities_) return std::min(target, limit);
  double step = 0.0;
  for (Index crossings = 0; crossings <= 2 * num_rows_; ++crossings) {
    Index next = -1;
    double next_step = std::min(target, limit);
    for (Index i = 0; i < num_rows_; ++i) {
      const double candidate = break_point(tableau, i, step);
      if (candidate < next_step) {
        next_step = candidate;
        next = i;
      }
    }
    step = next_step;
    if (next < 0) break;
    cross(tableau, next);
    target = newton_step(tableau, step);
  }
  return step;
}

bool LevelRows::is_stationary(const Tableau& tableau, double length) const {
  constexpr double kFullStep = 1e-12;
  if (std::abs(length - 1.0) > kFullStep) return false;
  for (Index i = 0; i < num_rows_; ++i) {
    const Index row = tableau.level_begin + i;
    if (side_[at(i)] == moved_side_[at(i)]) continue;
    const double low = tableau.lower[row] - tableau.value[row];
    const double high = tableau.value[row] - tableau.upper[row];
    if (std::min(std::abs(low), std::abs(high)) > 10.0 * tableau.noise(row)) return false;
  }
  return true;
}

}  // namespace surefoot
