#include "surefoot/solver/even_units.hpp"

#include "surefoot/solver/index.hpp"
#include "surefoot/solver/tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace surefoot::solver {
namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kPasses = 20;
/// Smallest useful change of units, as a power of two.
constexpr double kMinChange = 12.0;
/// Largest useful ratio of the spreads of elements after and before.
constexpr double kMaxSpreadRatio = 0.25;
/// Largest unit, as a power of two: products of rows must not overflow.
constexpr double kMaxPower = 100.0;
/// An element may be rounding below this power of two, relative to its row's largest.
constexpr int kMinElementPower = -50;
/// A larger independent part of a row is clear, a smaller one rounding; `RankTolerance::solve` lies
/// between them.
constexpr double kClear = 1e-5;

bool is_finite(const Hierarchy& hierarchy) {
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    if (!hierarchy.level(k).A().allFinite()) return false;
  }
  return true;
}

/// The non-zero rows of some levels.
MatrixXd rows_of(const Hierarchy& hierarchy, std::size_t begin, std::size_t end) {
  Index count = 0;
  for (std::size_t k = begin; k < end; ++k) count += hierarchy.level(k).num_rows();
  MatrixXd rows(count, hierarchy.unknowns());
  count = 0;
  for (std::size_t k = begin; k < end; ++k) {
    const auto A = hierarchy.level(k).A();
    for (Index i = 0; i < A.rows(); ++i) {
      if (A.row(i).any()) rows.row(count++) = A.row(i);
    }
  }
  return rows.topRows(count);
}

/// Groups of unknowns that move together, each named by its first.
std::vector<Index> each_alone(Index unknowns) {
  std::vector<Index> groups(at(unknowns));
  std::iota(groups.begin(), groups.end(), Index{0});
  return groups;
}

/// Joins the groups of unknowns that appear in the same row. Elements that may be rounding count,
/// too, as in other units they may not be.
void join(std::vector<Index>& groups, const MatrixXd& rows) {
  for (Index i = 0; i < rows.rows(); ++i) {
    Index first = 0;
    while (rows(i, first) == 0.0) ++first;
    for (Index j = first + 1; j < rows.cols(); ++j) {
      const Index a = groups[at(first)], b = groups[at(j)];
      if (rows(i, j) != 0.0 && a != b) std::ranges::replace(groups, std::max(a, b), std::min(a, b));
    }
  }
}

/// Mean binary logarithm of the elements in each row and group, and their count.
struct Elements {
  ArrayXXd mean, count;

  Elements(const MatrixXd& rows, const ArrayXd& powers, const std::vector<Index>& groups)
      : mean(ArrayXXd::Zero(rows.rows(), rows.cols())), count(mean) {
    for (Index i = 0; i < rows.rows(); ++i) {
      const double least = std::ldexp(rows.row(i).cwiseAbs().maxCoeff(), kMinElementPower);
      for (Index j = 0; j < rows.cols(); ++j) {
        const double size = std::abs(rows(i, j));
        if (size == 0.0 || size < least) continue;
        mean(i, groups[at(j)]) += std::log2(size) + powers[j];
        count(i, groups[at(j)]) += 1.0;
      }
    }
    mean /= count.max(1.0);
  }

  [[nodiscard]] ArrayXd mean_of_rows(const ArrayXd& groups) const {
    const ArrayXXd moved = (mean.rowwise() + groups.transpose()) * count;
    return moved.rowwise().sum() / count.rowwise().sum().max(1.0);
  }
  [[nodiscard]] ArrayXd mean_of_groups(const ArrayXd& rows) const {
    const ArrayXXd moved = (mean.colwise() - rows) * count;
    return (moved.colwise().sum() / count.colwise().sum().max(1.0)).transpose();
  }
  [[nodiscard]] double spread(const ArrayXd& groups) const {
    const ArrayXd rows = mean_of_rows(groups);
    const ArrayXXd moved = (mean.rowwise() + groups.transpose()).colwise() - rows;
    return std::sqrt((moved.square() * count).sum());
  }
  /// Powers of two for the groups that minimise the spread, if useful; otherwise 0.
  [[nodiscard]] ArrayXd even() const {
    const ArrayXd zero = ArrayXd::Zero(mean.cols());
    const ArrayXd is_used = (count.colwise().sum().transpose() > 0.0).cast<double>();
    ArrayXd groups = zero;
    for (int pass = 0; pass < kPasses; ++pass) groups = -mean_of_groups(mean_of_rows(groups));
    const double after = spread(groups), middle = (groups * is_used).sum() / is_used.sum();
    groups = ((groups - middle) * is_used).round().eval();
    const bool are_needed = groups.maxCoeff() - groups.minCoeff() >= kMinChange &&
                            groups.abs().maxCoeff() <= kMaxPower &&
                            after <= kMaxSpreadRatio * spread(zero);
    return are_needed ? groups : zero;
  }
};

/// Class of a rank decision by the independent part of a row.
int kind_of(double left) {
  const RankTolerance rank;
  return (left > kClear ? 1 : 0) + (left > rank.solve ? 1 : 0) + (left > rank.keep ? 1 : 0);
}

/// For rows of length 1: classes of each against those before it, and of any two.
std::vector<int> kinds_of_rows(const MatrixXd& rows) {
  std::vector<int> kinds;
  MatrixXd basis(rows.cols(), std::min(rows.rows(), rows.cols()));
  Index rank = 0;
  for (Index i = 0; i < rows.rows(); ++i) {
    const VectorXd along = rows.topRows(i) * rows.row(i).transpose();
    VectorXd left = rows.row(i).transpose();
    for (int twice = 0; twice < 2; ++twice)
      left -= basis.leftCols(rank) * (basis.leftCols(rank).transpose() * left);
    kinds.push_back(kind_of(left.norm()));
    if (left.norm() > RankTolerance{}.keep && rank < basis.cols())
      basis.col(rank++) = left.normalized();
    for (Index j = 0; j < i; ++j) {
      const bool is_clear = 1.0 - along[j] * along[j] > 10.0 * kClear * kClear;  // beyond rounding
      const double of_pair = is_clear ? 1.0 : (rows.row(i) - along[j] * rows.row(j)).norm();
      kinds.push_back(kind_of(of_pair));
    }
  }
  return kinds;
}

MatrixXd in_powers(const MatrixXd& rows, const ArrayXd& powers) {
  MatrixXd result = rows;
  for (Index j = 0; j < rows.cols(); ++j)
    result.col(j) *= std::ldexp(1.0, static_cast<int>(powers[j]));
  // A power of two first: the square of a row may overflow.
  for (Index i = 0; i < rows.rows(); ++i) result.row(i) /= result.row(i).cwiseAbs().maxCoeff();
  result.rowwise().normalize();
  return result;
}

/// Are the ranks of these rows equal in both units?
bool are_ranks_alike(const MatrixXd& rows, const ArrayXd& one, const ArrayXd& other) {
  return kinds_of_rows(in_powers(rows, one)) == kinds_of_rows(in_powers(rows, other));
}

}  // namespace

// Level by level: the best units for the rows of all levels so far, if no rank of the levels before
// depends on them; otherwise the relative units of unknowns that appear together there stay.
VectorXd even_units(const Hierarchy& hierarchy) {
  const Index n = hierarchy.unknowns();
  ArrayXd powers = ArrayXd::Zero(n);
  const std::vector<Index> alone = each_alone(n);
  std::vector<Index> joined = alone;
  if (n < 2 || !is_finite(hierarchy)) return VectorXd::Ones(n);
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const MatrixXd before = rows_of(hierarchy, 0, k), level = rows_of(hierarchy, k, k + 1);
    if (level.rows() == 0) continue;
    MatrixXd all(before.rows() + level.rows(), n);
    all << before, level;
    const ArrayXd best = Elements(all, ArrayXd::Zero(n), alone).even();
    if ((best != powers).any()) {
      if (are_ranks_alike(before, powers, best)) {
        powers = best;
      } else {
        const ArrayXd moved = Elements(level, powers, joined).even();
        ArrayXd sum = powers;
        for (Index j = 0; j < n; ++j) sum[j] += moved[joined[at(j)]];
        if (sum.abs().maxCoeff() <= kMaxPower) powers = sum;
      }
    }
    join(joined, level);
  }
  return powers.unaryExpr([](double power) { return std::ldexp(1.0, static_cast<int>(power)); });
}

Hierarchy in_units(const Hierarchy& hierarchy, const VectorXd& units) {
  Hierarchy result(hierarchy.unknowns());
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const Level& from = hierarchy.level(k);
    Level& to = result.level(result.add_level(from.name(), from.num_rows()));
    Rows rows = to.add(from);
    rows.A.array().rowwise() *= units.transpose().array();
  }
  return result;
}

Hierarchy with_shortest_in_units(const Hierarchy& hierarchy, const VectorXd& units) {
  Hierarchy result = in_units(hierarchy, units);
  Rows rows = result.level(result.add_level("shortest", units.size())).add(units.size(), 0);
  rows.A.diagonal() = units;
  rows.lower.setZero();
  rows.upper.setZero();
  return result;
}

}  // namespace surefoot::solver
