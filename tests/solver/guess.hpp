#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <string>

namespace surefoot::test {

/// A level for each of `levels`, called "level 0" and so on, whose rows have the ids 0, 1, ….
inline solver::Hierarchy named(Eigen::Index unknowns, const HierarchyData& levels) {
  solver::Hierarchy hierarchy(unknowns);
  for (const LevelData& data : levels) {
    const std::size_t k =
        hierarchy.add_level("level " + std::to_string(hierarchy.num_levels()), data.lower.size());
    solver::Rows rows = hierarchy.level(k).add(data.lower.size(), 0);
    if (data.lower.size() > 0) rows.A = data.A;
    rows.lower = data.lower;
    rows.upper = data.upper;
  }
  return hierarchy;
}

/// Rows of zeros whose bounds are violated on the wanted side: solving it leaves exactly this
/// guess. 1 above, −1 below, 0 inactive.
template <typename Choice>
HierarchyData guess(const HierarchyData& levels, Choice&& side_of) {
  HierarchyData result = levels;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    result[k].A.setZero();
    for (Eigen::Index i = 0; i < levels[k].lower.size(); ++i) {
      const int side = side_of(k, i);
      result[k].lower[i] = side < 0 ? 1.0 : -2.0;
      result[k].upper[i] = side > 0 ? -1.0 : 2.0;
    }
  }
  return result;
}

inline int sign(int a) { return (a > 0) - (a < 0); }

}  // namespace surefoot::test
