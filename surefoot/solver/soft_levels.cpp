#include "surefoot/solver/soft_levels.hpp"

#include <algorithm>

namespace surefoot {
namespace {

using Index = Eigen::Index;

double between(double value, double bound, double share) {
  return (1.0 - share) * value + share * bound;
}

void relax(Rows rows, const Eigen::VectorXd& x, double share) {
  for (Index i = 0; i < rows.A.rows(); ++i) {
    const double value = rows.A.row(i).dot(x);
    double& lower = rows.lower[i];
    double& upper = rows.upper[i];
    if (lower == upper) {
      lower = upper = between(value, upper, share);
    } else if (value < lower) {
      lower = between(value, lower, share);
    } else if (value > upper) {
      upper = between(value, upper, share);
    }
  }
}

bool contains(std::span<const std::size_t> list, std::size_t k) {
  return std::ranges::find(list, k) != list.end();
}

}  // namespace

SoftLevels::SoftLevels(const Hierarchy& capacity, const LexicographicOptions& options)
    : result_(capacity), solver_(capacity, options) {}

const Hierarchy& SoftLevels::update(const Hierarchy& hierarchy, std::span<const std::size_t> soft,
                                    double share) noexcept {
  if (share >= 1.0 || !fits(hierarchy)) return hierarchy;
  copy_without(hierarchy, soft);
  if (!(share > 0.0)) return result_;
  const Eigen::VectorXd& x = solver_.solve(result_).x;
  for (const std::size_t k : soft) {
    if (k >= hierarchy.num_levels() || result_.level(k).num_rows() > 0) continue;
    result_.level(k).add(hierarchy.level(k));
    relax(result_.level(k).rows(), x, share);
  }
  return result_;
}

bool SoftLevels::fits(const Hierarchy& hierarchy) const {
  if (hierarchy.unknowns() != result_.unknowns()) return false;
  if (hierarchy.num_levels() != result_.num_levels()) return false;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    if (hierarchy.level(k).num_rows() > result_.level(k).max_rows()) return false;
  }
  return true;
}

void SoftLevels::copy_without(const Hierarchy& hierarchy, std::span<const std::size_t> soft) {
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    result_.level(k).clear();
    if (!contains(soft, k)) result_.level(k).add(hierarchy.level(k));
  }
}

}  // namespace surefoot
