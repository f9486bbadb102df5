#include "surefoot/solver/soft_levels.hpp"

#include "surefoot/solver/capacity.hpp"
#include "surefoot/solver/index.hpp"
#include "surefoot/solver/row_states.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::solver {
namespace {

/// Relative distance of a row at its bound.
constexpr double kTouching = 1e-9;

}  // namespace

SoftLevels::SoftLevels(const Hierarchy& capacity)
    : selected_(capacity),
      solution_(empty_solution(capacity)),
      value_(Eigen::VectorXd::Zero(max_rows_of_a_level(capacity))) {}

const Hierarchy& SoftLevels::select(const Hierarchy& hierarchy, const LevelSet& present) noexcept {
  if (hierarchy.unknowns() != selected_.unknowns()) return hierarchy;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    selected_.level(k).clear();
    if (k >= present.size() || present[k]) selected_.level(k).add(hierarchy.level(k));
  }
  for (std::size_t k = hierarchy.num_levels(); k < selected_.num_levels(); ++k) {
    selected_.level(k).clear();
  }
  return selected_;
}

const Solution& SoftLevels::between(const Hierarchy& hierarchy, const Solution& before,
                                    const Solution& after, double share) noexcept {
  const double s = share > 0.0 ? std::min(share, 1.0) : 0.0;
  solution_.x = (1.0 - s) * before.x + s * after.x;
  judge(before, after);
  const bool is_invalid = solution_.status == SolveStatus::invalid_input;
  if (is_invalid) solution_.x.setZero();
  if (!is_invalid) describe(hierarchy);
  clear_levels(solution_, is_invalid ? 0 : hierarchy.num_levels());
  return solution_;
}

void SoftLevels::describe(const Hierarchy& hierarchy) {
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const Level& level = hierarchy.level(k);
    LevelResult& result = solution_.levels[k];
    auto value = value_.head(level.num_rows());
    value.noalias() = level.A() * solution_.x;
    double sum = 0.0;
    for (Index i = 0; i < level.num_rows(); ++i) {
      const double lower = level.lower()[i], upper = level.upper()[i];
      const double beyond = signed_violation(value[i], lower, upper);
      sum += beyond * beyond;
      result.rows[static_cast<std::size_t>(i)] =
          state_of(value[i], lower, upper, kTouching * (1.0 + std::abs(value[i])));
    }
    result.num_rows = level.num_rows();
    result.residual = std::sqrt(sum);
  }
}

void SoftLevels::judge(const Solution& before, const Solution& after) {
  const bool is_before = before.status > after.status;
  solution_.status = is_before ? before.status : after.status;
  solution_.borderline = before.borderline || after.borderline;
  solution_.failed_level = std::max(before.failed_level, after.failed_level);
  if (before.failed_level >= 0 && after.failed_level >= 0)
    solution_.failed_level = std::min(before.failed_level, after.failed_level);
  for (std::size_t k = 0; k < solution_.levels.size(); ++k) {
    const LevelResult &a = before.levels[k], &b = after.levels[k];
    solution_.levels[k].degrees_of_freedom_left =
        std::min(a.degrees_of_freedom_left, b.degrees_of_freedom_left);
    solution_.levels[k].iterations = a.iterations + b.iterations;
    solution_.levels[k].time = a.time + b.time;
  }
}

}  // namespace surefoot::solver
