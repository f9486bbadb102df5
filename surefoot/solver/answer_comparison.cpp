#include "surefoot/solver/answer_comparison.hpp"

#include "surefoot/solver/tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::solver {
namespace {

// Relative to a residual plus the level's longest row.
constexpr double kSameAnswer = 1e-10;   // smaller differences are rounding
constexpr double kSameResidual = 1e-7;  // smaller differences are negligible

double longest_row(const Level& level) {
  double square = 0.0;
  for (Eigen::Index i = 0; i < level.num_rows(); ++i)
    square = std::max(square, level.A().row(i).squaredNorm());
  return std::sqrt(square);
}

}  // namespace

AnswerComparison compare(const Hierarchy& hierarchy, const Solution& one, const Solution& other) {
  const double x_size = std::max(one.x.norm(), other.x.norm());
  AnswerComparison result;
  bool is_decided = false;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const double less = one.levels[k].residual - other.levels[k].residual;
    const double longest = longest_row(hierarchy.level(k));
    const double unit = longest + std::min(one.levels[k].residual, other.levels[k].residual);
    const double rounding = tolerance::kRounding * longest * x_size;
    if (!is_decided && std::abs(less) > kSameAnswer * unit + rounding) {
      is_decided = true;
      result.is_better = less > 0.0;
    }
    result.differs = result.differs || std::abs(less) > kSameResidual * unit + rounding;
  }
  return result;
}

}  // namespace surefoot::solver
