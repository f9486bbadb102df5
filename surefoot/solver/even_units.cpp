#include "surefoot/solver/even_units.hpp"

#include <cmath>

namespace surefoot {
namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::VectorXd;

constexpr int kPasses = 20;
/// Units that differ by less need not be changed.
constexpr double kNeeded = 12.0;
/// Nor where that explains less of how elements differ.
constexpr double kHelps = 0.25;
/// Units beyond 2 to this are none: products of rows could overflow.
constexpr double kMost = 100.0;
/// An element that is smaller beside its row's largest may be rounding.
constexpr int kNoElement = -50;

/// Binary logarithms of the elements, and which of them there are.
struct Logarithms {
  ArrayXXd of;
  ArrayXXd counts;  ///< 1, or 0 of elements that are zero

  [[nodiscard]] ArrayXd mean_of_rows(const ArrayXd& columns) const {
    const ArrayXXd moved = (of.rowwise() + columns.transpose()) * counts;
    return moved.rowwise().sum() / counts.rowwise().sum().max(1.0);
  }
  [[nodiscard]] ArrayXd mean_of_columns(const ArrayXd& rows) const {
    const ArrayXXd moved = (of.colwise() - rows) * counts;
    return (moved.colwise().sum() / counts.colwise().sum().max(1.0)).transpose();
  }
  [[nodiscard]] double spread(const ArrayXd& rows, const ArrayXd& columns) const {
    const ArrayXXd moved = ((of.rowwise() + columns.transpose()).colwise() - rows) * counts;
    return std::sqrt(moved.square().sum());
  }
};

Index num_rows(const Hierarchy& hierarchy) {
  Index rows = 0;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) rows += hierarchy.level(k).num_rows();
  return rows;
}

Logarithms logarithms(const Hierarchy& hierarchy) {
  const Index rows = num_rows(hierarchy), n = hierarchy.unknowns();
  Logarithms result{ArrayXXd::Zero(rows, n), ArrayXXd::Zero(rows, n)};
  Index at = 0;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const Level& level = hierarchy.level(k);
    for (Index i = 0; i < level.num_rows(); ++i, ++at) {
      const double least = std::ldexp(level.A().row(i).cwiseAbs().maxCoeff(), kNoElement);
      for (Index j = 0; j < n; ++j) {
        const double size = std::abs(level.A()(i, j));
        if (size == 0.0 || size < least) continue;
        result.of(at, j) = std::log2(size);
        result.counts(at, j) = 1.0;
      }
    }
  }
  return result;
}

bool is_finite(const Hierarchy& hierarchy) {
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    if (!hierarchy.level(k).A().allFinite()) return false;
  }
  return true;
}

}  // namespace

VectorXd even_units(const Hierarchy& hierarchy) {
  const Index n = hierarchy.unknowns();
  const VectorXd ones = VectorXd::Ones(n);
  if (n < 2 || num_rows(hierarchy) == 0 || !is_finite(hierarchy)) return ones;
  const Logarithms elements = logarithms(hierarchy);
  const ArrayXd is_used = elements.counts.colwise().maxCoeff().transpose();
  if (is_used.sum() == 0.0) return ones;
  ArrayXd columns = ArrayXd::Zero(n);
  ArrayXd rows = elements.mean_of_rows(columns);
  const double before = elements.spread(rows, columns);
  for (int pass = 0; pass < kPasses; ++pass) {
    columns = -elements.mean_of_columns(rows);
    rows = elements.mean_of_rows(columns);
  }
  const double after = elements.spread(rows, columns);
  columns = ((columns - (columns * is_used).sum() / is_used.sum()) * is_used).round();
  const bool are_needed = columns.maxCoeff() - columns.minCoeff() >= kNeeded &&
                          columns.abs().maxCoeff() <= kMost && after <= kHelps * before;
  if (!are_needed) return ones;
  return columns.unaryExpr([](double power) { return std::ldexp(1.0, static_cast<int>(power)); });
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

}  // namespace surefoot
