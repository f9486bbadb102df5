#include "surefoot/solver/distinct_rows.hpp"

#include "surefoot/solver/certificate.hpp"
#include "surefoot/solver/index.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace surefoot::solver {
namespace {

using Eigen::VectorXd;

constexpr CertificateOptions kTolerances;
/// Difference of equal directions of length 1, from rounding.
constexpr double kSame = 1e-12;

DistinctRows distinct(const RowSet& all, const std::function<bool(Index, Index)>& are_same) {
  DistinctRows result{.rows = RowSet(all.rows.cols()), .same = {}};
  std::vector<Index> kept;
  for (Index i = 0; i < all.rows.rows(); ++i) {
    const RowIndex at = all.origin[static_cast<std::size_t>(i)];
    const auto first = std::ranges::find_if(kept, [&](Index j) { return are_same(i, j); });
    if (first != kept.end()) {
      result.same[static_cast<std::size_t>(first - kept.begin())].push_back(at);
      continue;
    }
    kept.push_back(i);
    result.rows.add(all.rows.row(i).transpose(), at);
    result.same.emplace_back();
  }
  return result;
}

}  // namespace

Index DistinctRows::place_of(RowIndex at) const {
  std::size_t i = 0;
  while (i < same.size() && rows.origin[i] != at && std::ranges::find(same[i], at) == same[i].end())
    ++i;
  return static_cast<Index>(i);
}

double missed(const RowSet& set, Index i, const Hierarchy& hierarchy, const VectorXd& x) {
  const RowIndex at = set.origin[static_cast<std::size_t>(i)];
  const Level& level = hierarchy.level(at.level);
  const double value = level.A().row(at.row).dot(x);
  const double by = value - std::clamp(value, level.lower()[at.row], level.upper()[at.row]);
  const double along = level.A().row(at.row).dot(set.rows.row(i)) < 0.0 ? -1.0 : 1.0;
  return along * by / level.A().row(at.row).norm();
}

DistinctRows distinct_fixed(const RowSet& fixed, const Hierarchy& hierarchy, const VectorXd& x) {
  return distinct(fixed, [&](Index i, Index j) {
    const double along = fixed.rows.row(i).dot(fixed.rows.row(j)) < 0.0 ? -1.0 : 1.0;
    const double apart = missed(fixed, i, hierarchy, x) - along * missed(fixed, j, hierarchy, x);
    return (fixed.rows.row(i) - along * fixed.rows.row(j)).norm() <= kSame &&
           std::abs(apart) <= kTolerances.tight * (1.0 + x.norm());
  });
}

DistinctRows distinct_touching(const RowSet& touching, const Hierarchy& hierarchy,
                               const VectorXd& x) {
  return distinct(touching, [&](Index i, Index j) {
    const double apart = missed(touching, i, hierarchy, x) - missed(touching, j, hierarchy, x);
    return (touching.rows.row(i) - touching.rows.row(j)).norm() <= kSame &&
           std::abs(apart) <= kTolerances.tight * (1.0 + x.norm());
  });
}

DistinctRows held_rows(const RowSet& fixed, const RowSet& touching, const Hierarchy& hierarchy,
                       const VectorXd& x) {
  DistinctRows result = distinct_fixed(fixed, hierarchy, x);
  const DistinctRows at_bound = distinct_touching(touching, hierarchy, x);
  result.rows.add(at_bound.rows);
  result.same.insert(result.same.end(), at_bound.same.begin(), at_bound.same.end());
  return result;
}

}  // namespace surefoot::solver
